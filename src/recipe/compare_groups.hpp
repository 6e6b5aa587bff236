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

/// Whether everything with a count stands and, if the count of a group is open, the cell was
/// filled: `is_full`, the run ended because no more was found to fit.
[[nodiscard]] bool everything_stands(const std::vector<GroupOutcome>& groups, bool is_full);

}  // namespace packstone::recipe
