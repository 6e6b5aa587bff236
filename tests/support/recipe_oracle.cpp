#include "support/recipe_oracle.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"

namespace packstone::test {
namespace {

constexpr std::string_view kMark = "#set ";

std::vector<Override> overrides_in(std::string_view text) {
  std::vector<Override> overrides;
  while (text.substr(0, kMark.size()) == kMark) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    overrides.emplace_back(text.substr(kMark.size(), end - kMark.size()));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return overrides;
}

std::optional<Recipe> accepted(std::string_view text) {
  try {
    if (text.substr(0, 1) == "{") return recipe_from_json(text, "any bytes");
    return recipe_from_toml(text, "any bytes", overrides_in(text));
  } catch (const InvalidArgument&) {
    return std::nullopt;
  }
}

}  // namespace

bool recipe_reader_holds(std::string_view text) {
  const std::optional<Recipe> recipe = accepted(text);
  if (!recipe) return false;
  const std::string written = recipe_to_json(*recipe);
  std::string again;
  try {
    again = recipe_to_json(recipe_from_json(written, "rewritten"));
  } catch (const InvalidArgument& error) {
    throw std::logic_error(std::string("an accepted recipe was refused as JSON: ") + error.what());
  }
  if (again != written) throw std::logic_error("a recipe changed: " + written + " became " + again);
  return true;
}

}  // namespace packstone::test
