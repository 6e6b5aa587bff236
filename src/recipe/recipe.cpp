#include "packstone/recipe/recipe.hpp"

#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/io/packing_file.hpp"
#include "recipe/overrides.hpp"
#include "recipe/packing_words.hpp"
#include "recipe/read_inclusions.hpp"
#include "recipe/read_packing.hpp"
#include "recipe/recipe_table.hpp"

namespace packstone {
namespace {

using recipe::Complaints;
using recipe::Entry;
using recipe::TableView;

// Far more levels than any recipe has; what goes down a tree calls itself once per level.
constexpr int kMaxJsonDepth = 64;

// Reads the size of the cell into `cell`; returns its dimension, 0 when it could not be read.
int read_cell_size(const TableView& table, Cell& cell, Complaints& complaints) {
  const Entry size = table["size"];
  if (!size) {
    complaints.missing(&table.node(), "cell.size", "a list of 2 or 3 numbers, each a number > 0");
    return 0;
  }
  const auto edges = recipe::read_numbers(size, {2, 3}, recipe::positive_number(), complaints);
  if (!edges) {
    const toml::array* const array = size.node->as_array();
    const std::size_t count = array == nullptr ? 0 : array->size();
    return count == 2 || count == 3 ? static_cast<int>(count) : 0;
  }
  cell.dimension = static_cast<int>(edges->size());
  cell.size = {(*edges)[0], (*edges)[1], edges->size() == 3 ? (*edges)[2] : 0.0};
  return cell.dimension;
}

void read_periodic(const Entry& periodic, int dimension, Cell& cell, Complaints& complaints) {
  if (const auto flag = periodic.node->value_exact<bool>()) {
    cell.periodic = {*flag, *flag, *flag && dimension == 3};
    return;
  }
  const toml::array* const flags = periodic.node->as_array();
  const std::size_t axes = static_cast<std::size_t>(dimension);
  if (flags == nullptr || (dimension != 0 && flags->size() != axes)) {
    const std::string count =
        dimension == 0 ? "one flag" : std::to_string(dimension) + " flags, one";
    complaints.not_allowed(periodic, "true, false, or a list of " + count + " per axis");
    return;
  }
  for (std::size_t i = 0; i < flags->size() && i < 3; ++i) {
    cell.periodic[i] = recipe::read_flag(recipe::item(periodic, i), complaints).value_or(true);
  }
}

int read_cell(const TableView& root, Cell& cell, Complaints& complaints) {
  if (!root["cell"]) complaints.missing(nullptr, "[cell]", "a table with size and periodic");
  const toml::table* const node = recipe::read_table(root, "cell", complaints);
  if (node == nullptr) return 0;
  const TableView table(*node, "cell", {"size", "periodic"}, complaints);
  const int dimension = read_cell_size(table, cell, complaints);
  if (dimension == 2) cell.periodic[2] = false;
  if (const Entry periodic = table["periodic"]) {
    read_periodic(periodic, dimension, cell, complaints);
  }
  return dimension;
}

// Gives groups without a name that of their shape, and refuses a name that stands twice.
void settle_names(std::vector<InclusionGroup>& groups, const Entry& list, Complaints& complaints) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].name.empty() || taken.insert(groups[i].name).second) continue;
    const Entry name{(*recipe::item(list, i).node->as_table()).get("name"),
                     recipe::item(list, i).name + ".name"};
    complaints.not_allowed(name, "a name that no other group has");
  }
  for (InclusionGroup& group : groups) {
    if (!group.name.empty()) continue;
    const std::string word(name(group.shape));
    group.name = word;
    for (int k = 2; !taken.insert(group.name).second; ++k) {
      group.name = word + "_" + std::to_string(k);
    }
  }
}

// Orders of all groups together that no packing can meet.
void check_sums(const Recipe& order, const Entry& list, Complaints& complaints) {
  double sum = 0.0;
  int open = 0;
  for (std::size_t i = 0; i < order.groups.size(); ++i) {
    const InclusionGroup& group = order.groups[i];
    const double before = sum;
    sum += group.fraction.value_or(0.0);
    if (before < 1.0 && sum >= 1.0) {
      complaints.add(recipe::item(list, i).node, recipe::item(list, i).name +
                                                     ".fraction makes the fractions sum to " +
                                                     number_text(sum) + "; allowed is a sum < 1");
    }
    if (group.count || group.fraction || ++open == 1) continue;
    complaints.add(recipe::item(list, i).node,
                   recipe::item(list, i).name +
                       " is the second group with a size alone; only one group can fill what "
                       "the others leave: give it a count or a fraction too");
  }
}

void read_groups(const TableView& root, int dimension, Recipe& order, Complaints& complaints) {
  const Entry list = root["inclusions"];
  if (!list) {
    return complaints.missing(nullptr, "[[inclusions]]", "one table or more, one per group");
  }
  const toml::array* const tables = list.node->as_array();
  if (tables == nullptr || tables->empty()) {
    return complaints.add(list.node, "inclusions; allowed is one table [[inclusions]] or more");
  }
  const std::size_t before = complaints.count();
  for (std::size_t i = 0; i < tables->size(); ++i) {
    auto group = recipe::read_inclusions(recipe::item(list, i), dimension, complaints);
    if (group) order.groups.push_back(std::move(*group));
  }
  if (complaints.count() != before) return;
  for (std::size_t i = 0; i < tables->size(); ++i) {
    recipe::note_places(recipe::item(list, i), complaints, order.places);
  }
  settle_names(order.groups, list, complaints);
  check_sums(order, list, complaints);
}

Recipe recipe_from_tree(toml::table& tree, const std::string& origin,
                        const std::vector<Override>& overrides) {
  Complaints complaints(origin);
  for (const Override& text : overrides) recipe::apply_override(tree, text, complaints);
  const TableView root(tree, "", {"cell", "inclusions", "packing"}, complaints);
  Recipe order;
  order.origin = origin;
  const int dimension = read_cell(root, order.cell, complaints);
  read_groups(root, dimension, order, complaints);
  recipe::read_packing_table(root, order, complaints);
  complaints.throw_if_any();
  return order;
}

toml::table table_of(const nlohmann::json& value);
toml::array array_of(const nlohmann::json& value);

bool fits_toml_integer(const nlohmann::json& value) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (!value.is_number_integer()) return false;
  return !value.is_number_unsigned() || value.get<std::uint64_t>() <= kMost;
}

// Hands the TOML form of a JSON value to `put`. TOML has no null; such a value is left out.
template <class Put>
void with_toml(const nlohmann::json& value, const Put& put) {
  if (value.is_object()) put(table_of(value));
  if (value.is_array()) put(array_of(value));
  if (value.is_string()) put(value.get<std::string>());
  if (value.is_boolean()) put(value.get<bool>());
  if (!value.is_number()) return;
  if (fits_toml_integer(value)) {
    put(value.get<std::int64_t>());
  } else {
    put(value.get<double>());
  }
}

toml::table table_of(const nlohmann::json& value) {
  toml::table table;
  for (const auto& [key, child] : value.items()) {
    with_toml(child, [&table, &name = key](auto node) { table.insert(name, std::move(node)); });
  }
  return table;
}

toml::array array_of(const nlohmann::json& value) {
  toml::array array;
  for (const auto& child : value) {
    with_toml(child, [&array](auto node) { array.push_back(std::move(node)); });
  }
  return array;
}

nlohmann::json parsed_json(std::string_view text, const std::string& origin) {
  const auto watch = [&origin](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth <= kMaxJsonDepth) return true;
    throw InvalidArgument(origin + ": nested deeper than " + std::to_string(kMaxJsonDepth) +
                          " levels");
  };
  return nlohmann::json::parse(text, watch, false);
}

std::string text_of(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw FileError("cannot read " + path.string() + ": it is a folder, not a recipe");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    const bool there = std::filesystem::exists(path);
    throw FileError("cannot read " + path.string() +
                    (there ? ": no permission" : ": there is no such file"));
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string_view name(PackMethod method) noexcept {
  return recipe::word_for(recipe::kMethods, method);
}

Recipe recipe_from_toml(std::string_view text, const std::string& origin,
                        const std::vector<Override>& overrides) {
  if (const auto line = recipe::line_of_endless_key(text)) {
    throw InvalidArgument(origin + ":" + std::to_string(*line) + ": a key of too many parts");
  }
  toml::table tree;
  try {
    tree = toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    const std::string place =
        at.line == 0 ? "" : ":" + std::to_string(at.line) + ": column " + std::to_string(at.column);
    throw InvalidArgument(origin + place + ": not TOML: " + std::string(error.description()));
  }
  return recipe_from_tree(tree, origin, overrides);
}

Recipe recipe_from_json(std::string_view text, const std::string& origin,
                        const std::vector<Override>& overrides) {
  const auto value = parsed_json(text, origin);
  if (!value.is_object()) throw InvalidArgument(origin + ": not a JSON object");
  toml::table tree = table_of(value);
  return recipe_from_tree(tree, origin, overrides);
}

Recipe recipe_of_packing(const Packing& packing, const std::string& origin,
                         const std::vector<Override>& overrides) {
  if (!packing.provenance || packing.provenance->recipe_json.empty()) {
    throw InvalidArgument(origin + ": it does not hold the recipe it came from");
  }
  return recipe_from_json(packing.provenance->recipe_json, origin, overrides);
}

Recipe read_recipe(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  const std::string ending = path.extension().string();
  const auto of_packing = [&] {
    return recipe_of_packing(read_packing(path), path.string(), overrides);
  };
  if (ending == ".h5") return of_packing();
  const std::string text = text_of(path);
  if (ending != ".json") return recipe_from_toml(text, path.string(), overrides);
  const auto value = nlohmann::json::parse(text, nullptr, false);
  const bool is_packing = value.is_object() && value.contains("format");
  return is_packing ? of_packing() : recipe_from_json(text, path.string(), overrides);
}

}  // namespace packstone
