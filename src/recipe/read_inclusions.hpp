#pragma once

/// @file
/// One `[[inclusions]]` table of a recipe.

#include <optional>

#include "packstone/structure/inclusion_mix.hpp"
#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// The group that `entry` orders, or complaints and nothing. `dimension` of the cell: 2, 3, or 0
/// when it could not be read.
[[nodiscard]] std::optional<InclusionGroup> read_inclusions(const Entry& entry, int dimension,
                                                            Complaints& complaints);

}  // namespace packstone::recipe
