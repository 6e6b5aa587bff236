#pragma once

/// @file
/// Reading of `[packing]` with the tables of its methods.

#include "packstone/recipe/recipe.hpp"
#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// Reads the table `packing` of the recipe `root` into `order`; absent keys keep their defaults.
void read_packing_table(const TableView& root, Recipe& order, Complaints& complaints);

}  // namespace packstone::recipe
