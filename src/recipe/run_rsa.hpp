#pragma once

/// @file
/// A recipe by random sequential adsorption.

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// The options of rsa_pack() that the recipe orders.
[[nodiscard]] RsaOptions rsa_options(const Recipe& recipe);

/// Places the bodies, and fills the cell with those of a group of open count. What the outcome
/// lacks yet: method, time, certificate, provenance and the names of the groups.
[[nodiscard]] PackOutcome run_rsa(const Recipe& recipe, const InclusionMix& mix,
                                  const RunContext& run);

}  // namespace packstone::recipe
