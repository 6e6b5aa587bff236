#include "recipe/recipe_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "packstone/core/error.hpp"
#include "recipe/nearest_key.hpp"

namespace packstone::recipe {
namespace {

constexpr std::size_t kLongestShown = 60;

// Every key that stands in a table of its own, for words that are right but in the wrong place.
const std::vector<std::pair<std::string_view, std::string_view>>& homes() {
  static const std::vector<std::pair<std::string_view, std::string_view>> list{
      {"periodic", "[cell]"},
      {"method", "[packing]"},
      {"min_gap", "[packing]"},
      {"seed", "[packing]"},
      {"time_limit", "[packing]"},
      {"order", "[packing.rsa]"},
      {"redraw_orientations", "[packing.rsa]"},
      {"max_trials", "[packing.rsa]"},
      {"max_restarts", "[packing.rsa]"},
      {"goal", "[packing.event-driven]"},
      {"growth_rate", "[packing.event-driven]"},
      {"slowest_growth", "[packing.event-driven]"},
      {"rotate", "[packing.event-driven]"},
      {"collisions_per_body", "[packing.event-driven]"},
      {"published_stagnation", "[packing.event-driven]"},
      {"check_every_event", "[packing.event-driven]"},
      {"start", "[packing.event-driven]"},
      {"start_fraction", "[packing.event-driven]"},
      {"shape", "[[inclusions]]"},
      {"count", "[[inclusions]]"},
      {"fraction", "[[inclusions]]"},
      {"aspect", "[[inclusions]]"},
      {"orientation", "[[inclusions]]"}};
  return list;
}

std::string advice(std::string_view key, const std::vector<std::string_view>& known) {
  if (const auto near = nearest_key(key, known)) {
    return "did you mean \"" + std::string(*near) + "\"?";
  }
  for (const auto& [word, table] : homes()) {
    if (word == key) return "it belongs in " + std::string(table);
  }
  return "known here: " + list_of(known);
}

std::string number_text(double x) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, x);
  std::string text(buffer, end);
  if (text.find_first_of(".enf") == std::string::npos) text += ".0";
  return text;
}

std::string whole_text(const toml::node& node);

std::string items_text(const toml::node& node) {
  std::string text;
  const auto comma = [&text] { return text.empty() ? "" : ", "; };
  if (const toml::array* const array = node.as_array()) {
    for (const toml::node& child : *array) text += comma() + whole_text(child);
    return "[" + text + "]";
  }
  for (const auto& [key, child] : *node.as_table()) {
    text += comma() + std::string(key.str()) + " = " + whole_text(child);
  }
  return text.empty() ? "{}" : "{ " + text + " }";
}

std::string whole_text(const toml::node& node) {
  if (node.is_array() || node.is_table()) return items_text(node);
  if (const auto* const number = node.as_floating_point()) return number_text(number->get());
  if (const auto* const word = node.as_string()) return "\"" + word->get() + "\"";
  std::ostringstream stream;
  node.visit([&stream](const auto& value) { stream << value; });
  return stream.str();
}

}  // namespace

std::string Complaints::place(const toml::node* at) const {
  if (at == nullptr || !at->source().path) return origin_;
  const std::string& path = *at->source().path;
  // The name of an override is the whole of its place; a file has lines.
  const auto line = at->source().begin.line;
  return path == origin_ && line > 0 ? path + ":" + std::to_string(line) : path;
}

void Complaints::add(const toml::node* at, const std::string& text) {
  lines_.push_back(place(at) + ": " + text);
}

void Complaints::not_allowed(const Entry& entry, const std::string& allowed) {
  add(entry.node, quoted(entry) + "; allowed is " + allowed);
}

void Complaints::missing(const toml::node* table, const std::string& key,
                         const std::string& allowed) {
  add(table, key + " is missing; allowed is " + allowed);
}

void Complaints::throw_if_any() const {
  if (lines_.empty()) return;
  std::string text;
  for (const std::string& line : lines_) text += (text.empty() ? "" : "\n") + line;
  throw InvalidArgument(text);
}

bool Range::holds(double x) const {
  return std::isfinite(x) && (lo_excluded ? x > lo : x >= lo) && (hi_excluded ? x < hi : x <= hi);
}

Range any_number() { return {.text = "a finite number"}; }
Range positive_number() { return {.text = "a number > 0", .lo = 0.0, .lo_excluded = true}; }
Range not_negative_number() { return {.text = "a number >= 0", .lo = 0.0}; }
Range fraction_number() { return {"a number > 0 and < 1", 0.0, 1.0, true, true}; }

std::string quoted(const Entry& entry) { return entry.name + " = " + shown(*entry.node); }

TableView::TableView(const toml::table& table, std::string name,
                     std::vector<std::string_view> known, Complaints& complaints)
    : table_(table), name_(std::move(name)) {
  for (const auto& [key, value] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    has_unknown_keys_ = true;
    complaints.add(&value,
                   "unknown key \"" + joined(name_, key.str()) + "\"; " + advice(key.str(), known));
  }
}

Entry TableView::operator[](std::string_view key) const {
  return {table_.get(key), joined(name_, key)};
}

Entry item(const Entry& array, std::size_t index) {
  return {array.node->as_array()->get(index), array.name + "[" + std::to_string(index) + "]"};
}

std::string joined(const std::string& name, std::string_view key) {
  return name.empty() ? std::string(key) : name + "." + std::string(key);
}

std::string list_of(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

std::string shown(const toml::node& node) {
  std::string text = whole_text(node);
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() > kLongestShown) text = text.substr(0, kLongestShown - 3) + "...";
  return text;
}

std::string hint(const std::string& word, const std::vector<std::string_view>& known) {
  std::string lower = word;
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  const auto near = nearest_key(lower, known);
  return near ? "; did you mean \"" + std::string(*near) + "\"?" : "";
}

std::optional<int> line_of_endless_key(std::string_view text) {
  constexpr int kMaxParts = 1000;
  int parts = 1;
  int line = 1;
  for (const char c : text) {
    if (std::string_view(",=[]{}\n").find(c) != std::string_view::npos) parts = 1;
    if (c == '\n') ++line;
    if (c == '.' && ++parts > kMaxParts) return line;
  }
  return std::nullopt;
}

std::optional<double> read_number(const Entry& entry, const Range& range, Complaints& complaints) {
  const bool numeric = entry.node->is_number();
  const auto value = numeric ? entry.node->value<double>() : std::nullopt;
  if (value && range.holds(*value)) return value;
  complaints.not_allowed(entry, range.text);
  return std::nullopt;
}

std::optional<std::int64_t> read_integer(const Entry& entry, std::int64_t least,
                                         Complaints& complaints) {
  const auto value = entry.node->value_exact<std::int64_t>();
  if (value && *value >= least) return value;
  // 10.0 and 1e3 are whole, but not integers of TOML.
  const auto number = entry.node->value_exact<double>();
  const bool whole = number && std::floor(*number) == *number;
  complaints.not_allowed(entry, "an integer >= " + std::to_string(least) +
                                    (whole ? ", without point or exponent" : ""));
  return std::nullopt;
}

std::optional<bool> read_flag(const Entry& entry, Complaints& complaints) {
  const auto value = entry.node->value_exact<bool>();
  if (!value) complaints.not_allowed(entry, "true or false");
  return value;
}

const toml::table* read_table(const TableView& parent, std::string_view key,
                              Complaints& complaints) {
  const Entry entry = parent[key];
  if (!entry) return nullptr;
  if (!entry.node->is_table()) complaints.not_allowed(entry, "a table [" + entry.name + "]");
  return entry.node->as_table();
}

std::optional<std::vector<double>> read_numbers(const Entry& entry, std::vector<std::size_t> counts,
                                                const Range& range, Complaints& complaints) {
  const toml::array* array = entry.node->as_array();
  const std::size_t size = array == nullptr ? 0 : array->size();
  if (std::find(counts.begin(), counts.end(), size) == counts.end()) {
    std::string text;
    for (const std::size_t count : counts) {
      text += (text.empty() ? "" : " or ") + std::to_string(count);
    }
    complaints.not_allowed(entry, "a list of " + text + " numbers, each " + range.text);
    return std::nullopt;
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < size; ++i) {
    if (const auto value = read_number(item(entry, i), range, complaints)) {
      values.push_back(*value);
    }
  }
  if (values.size() != size) return std::nullopt;
  return values;
}

}  // namespace packstone::recipe
