#pragma once

/// @file
/// Changes to a recipe's TOML tree before it is read: "inclusions.fibers.count=20".

#include <string>
#include <vector>

#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// Sets the value at the path of `text` ("path=value") in `root`. Path: keys joined by dots, [i]
/// for item i of a list, the name of a group for its item of `inclusions`. Tables on the way are
/// made when absent. Messages about the new value name the override instead of a file.
void apply_override(toml::table& root, const std::string& text, Complaints& complaints);

}  // namespace packstone::recipe
