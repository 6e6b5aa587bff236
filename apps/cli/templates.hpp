#pragma once

/// @file
/// Example recipes built into the program; their texts are the files of examples/.

#include <string_view>
#include <vector>

namespace packstone::cli {

/// An example recipe.
struct Template {
  std::string_view name;
  std::string_view text;
};

[[nodiscard]] const std::vector<Template>& templates();

}  // namespace packstone::cli
