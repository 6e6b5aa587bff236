#include "recipe/overrides.hpp"

#include <charconv>
#include <optional>
#include <variant>
#include <vector>

namespace packstone::recipe {
namespace {

using Step =
    std::variant<std::string, std::size_t>;  // a key or group name, or the index of an item

/// The TOML tree on the way down to the place that an override names.
struct Place {
  toml::node* parent = nullptr;
  Step step;
};

constexpr std::size_t kMaxSteps = 64;  // far more than any recipe has levels

std::size_t end_of_key(const std::string& path, std::size_t begin) {
  return std::min(path.find_first_of(".[", begin), path.size());
}

/// The steps of "inclusions[0].fraction" or "inclusions.\"long fibers\".count"; empty when the path
/// is not one.
std::vector<Step> steps_of(const std::string& path) {
  std::vector<Step> steps;
  std::size_t i = 0;
  while (i < path.size()) {
    if (path[i] == '[') {
      std::size_t index = 0;
      const char* const last = path.data() + path.size();
      const auto [end, error] = std::from_chars(path.data() + i + 1, last, index);
      if (error != std::errc{} || end == last || *end != ']') return {};
      steps.emplace_back(index);
      i = static_cast<std::size_t>(end - path.data()) + 1;
    } else if (path[i] == '"') {
      const std::size_t close = path.find('"', i + 1);
      if (close == std::string::npos) return {};
      steps.emplace_back(path.substr(i + 1, close - i - 1));
      i = close + 1;
    } else {
      const std::size_t end = end_of_key(path, i);
      if (end == i) return {};
      steps.emplace_back(path.substr(i, end - i));
      i = end;
    }
    if (i < path.size() && path[i] == '.' && ++i == path.size()) return {};
    if (steps.size() > kMaxSteps) return {};
  }
  return steps;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// `{ v = value }`; every node in it says that it came from `origin`.
std::optional<toml::table> parsed_value(const std::string& value, const std::string& origin,
                                        std::string& problem) {
  if (line_of_endless_key(value)) {
    problem = "a key of too many parts";
    return std::nullopt;
  }
  // A shell takes the quotes off a string, so a word or phrase stands for one.
  const bool phrase =
      !value.empty() && value.find_first_of("[]{}\"'\\\n\r=#,") == std::string::npos;
  std::vector<std::string> readings{"v = " + value};
  if (phrase) readings.push_back("v = \"" + value + "\"");
  for (const std::string& reading : readings) {
    try {
      toml::table table = toml::parse(reading, origin);
      if (table.size() == 1) return table;
      problem = "more than one value";
    } catch (const toml::parse_error& error) {
      problem = std::string(error.description());
    }
  }
  return std::nullopt;
}

std::string group_names(const toml::array& groups) {
  std::string names;
  for (const toml::node& group : groups) {
    const toml::table* const table = group.as_table();
    const auto name = table == nullptr ? std::nullopt : (*table)["name"].value<std::string>();
    if (name) names += (names.empty() ? "\"" : ", \"") + *name + "\"";
  }
  return names.empty() ? "none has a name; use inclusions[0]" : names;
}

std::optional<std::size_t> index_of_group(const toml::array& groups, const std::string& name) {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const toml::table* const table = groups.get_as<toml::table>(i);
    if (table != nullptr && (*table)["name"].value<std::string>() == name) return i;
  }
  return std::nullopt;
}

/// The child that `step` names; a table is made where a key is absent. Nothing, and a reason in
/// `problem`, where there is no such child.
toml::node* child(toml::node& parent, const Step& step, const std::string& origin,
                  std::string& problem) {
  if (toml::array* const array = parent.as_array()) {
    std::optional<std::size_t> index;
    if (const auto* const name = std::get_if<std::string>(&step)) {
      index = index_of_group(*array, *name);
      if (!index) problem = "no group \"" + *name + "\"; groups: " + group_names(*array);
    } else {
      index = std::get<std::size_t>(step);
      if (*index >= array->size()) {
        problem = "no item [" + std::to_string(*index) + "]; the list has " +
                  std::to_string(array->size());
        index.reset();
      }
    }
    return index ? array->get(*index) : nullptr;
  }
  toml::table* const table = parent.as_table();
  const auto* const key = std::get_if<std::string>(&step);
  if (table == nullptr || key == nullptr) {
    problem = key == nullptr ? "[...] stands where there is no list"
                             : "\"" + *key + "\" stands where there is no table";
    return nullptr;
  }
  if (!table->contains(*key)) {
    toml::table made = toml::parse("v = {}", origin);  // knows where it came from
    table->insert(*key, std::move(*made["v"].as_table()));
  }
  return table->get(*key);
}

/// Puts the only value of `value` where `place` says. False, and a reason, where that is nowhere.
bool put(const Place& place, toml::table&& value, const std::string& origin, std::string& problem) {
  toml::table* const table = place.parent->as_table();
  const auto* const key = std::get_if<std::string>(&place.step);
  if (table != nullptr && key != nullptr) {
    // Moved, not copied: a copy forgets where it came from.
    value.get("v")->visit([&](auto& node) { table->insert_or_assign(*key, std::move(node)); });
    return true;
  }
  if (child(*place.parent, place.step, origin, problem) == nullptr) return false;
  toml::array& array = *place.parent->as_array();
  if (key != nullptr) {
    problem = "a group is changed key by key: inclusions." + *key + ".count = ...";
    return false;
  }
  const auto at = array.cbegin() + static_cast<std::ptrdiff_t>(std::get<std::size_t>(place.step));
  value.get("v")->visit([&](auto& node) { array.replace(at, std::move(node)); });
  return true;
}

std::optional<Place> place_of(toml::table& root, const std::vector<Step>& steps,
                              const std::string& origin, std::string& problem) {
  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    parent = child(*parent, steps[i], origin, problem);
    if (parent == nullptr) return std::nullopt;
  }
  return Place{parent, steps.back()};
}

}  // namespace

void apply_override(toml::table& root, const std::string& text, Complaints& complaints) {
  const std::string origin = "--set " + text;
  const auto refuse = [&](const std::string& why) {
    toml::table place = toml::parse("v = 0", origin);
    complaints.add(place.get("v"), why);
  };
  const std::size_t equals = text.find('=');
  const std::vector<Step> steps = steps_of(trimmed(text.substr(0, equals)));
  if (equals == std::string::npos || steps.empty()) {
    return refuse("not of the form key=value, such as packing.seed=7 or inclusions[0].count=20");
  }
  std::string problem;
  auto value = parsed_value(trimmed(text.substr(equals + 1)), origin, problem);
  if (!value) return refuse("the value is not TOML: " + problem);
  const auto place = place_of(root, steps, origin, problem);
  if (!place || !put(*place, std::move(*value), origin, problem)) refuse(problem);
}

}  // namespace packstone::recipe
