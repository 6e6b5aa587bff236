#pragma once

/// @file
/// Orientation laws in a recipe: "random", { axis = [..] }, { tensor = [[..],[..],[..]] }, ...

#include <optional>

#include "packstone/structure/orientation_law.hpp"
#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// The law of a group in a cell of `dimension`, or complaints and nothing.
[[nodiscard]] std::optional<OrientationLaw> read_orientation(const Entry& entry, int dimension,
                                                             Complaints& complaints);

}  // namespace packstone::recipe
