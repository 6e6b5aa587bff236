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

/// Where smaller bodies stand.
struct SmallerPlaced {
  RsaResult rsa;
  double factor = 1.0;  ///< By which the bodies were made smaller.
};

/// Places the bodies, `factor` as large, turned as they are. Where the fraction was not `ordered`
/// and some of them do not find a place after some thousand trials, tries again with smaller ones.
[[nodiscard]] SmallerPlaced place_smaller(const Recipe& recipe,
                                          const std::vector<OrderedBody>& bodies, double factor,
                                          bool ordered, std::uint64_t seed, const RunContext& run);

}  // namespace packstone::recipe
