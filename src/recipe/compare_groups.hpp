#pragma once

/// @file
/// What was ordered of each group beside what stands.

#include <vector>

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Counts, fractions and orientations per group, of the bodies drawn and of those that stand.
[[nodiscard]] std::vector<GroupOutcome> compare_groups(const Recipe& recipe,
                                                       const InclusionMix& mix,
                                                       const Packing& packing);

}  // namespace packstone::recipe
