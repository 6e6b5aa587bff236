#pragma once

/// @file
/// order(): a recipe from the text of its groups.

#include <string>

#include "packstone/recipe/recipe.hpp"

namespace packstone::test {

/// The recipe `test.toml` that orders `groups` (sections, from line 3 on) in a cell of `size`,
/// which further keys of the cell may follow.
[[nodiscard]] inline Recipe order(const std::string& groups,
                                  const std::string& size = "[1, 1, 1]") {
  return recipe_from_toml("[cell]\nsize = " + size + "\n" + groups, "test.toml");
}

}  // namespace packstone::test
