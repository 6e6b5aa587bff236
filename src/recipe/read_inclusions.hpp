#pragma once

/// @file
/// One `[[inclusions]]` table of a recipe.

#include <map>
#include <optional>
#include <string>

#include "packstone/structure/inclusion_mix.hpp"
#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// The group that `entry` orders, or complaints and nothing. `dimension` of the cell: 2, 3, or 0
/// when it could not be read.
[[nodiscard]] std::optional<InclusionGroup> read_inclusions(const Entry& entry, int dimension,
                                                            Complaints& complaints);

/// Fills Recipe::places with what `entry`, a group that was read, orders.
void note_places(const Entry& entry, const Complaints& complaints,
                 std::map<std::string, std::string>& places);

}  // namespace packstone::recipe
