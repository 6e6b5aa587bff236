#pragma once

/// @file
/// Smaller bodies that random sequential adsorption places, for methods that go on from there.

#include <optional>
#include <vector>

#include "packstone/generate/rsa.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// The factor by which the bodies are made smaller: down to the volume fraction `ordered`; without
/// one to `most`, or further, until random sequential adsorption places them with little work.
[[nodiscard]] double start_factor(const Recipe& recipe, const std::vector<OrderedBody>& bodies,
                                  const std::optional<double>& ordered, double most);

/// Places the bodies, `factor` as large, turned as they are.
[[nodiscard]] RsaResult place_smaller(const Recipe& recipe, std::vector<OrderedBody> bodies,
                                      double factor, std::uint64_t seed, const RunContext& run);

}  // namespace packstone::recipe
