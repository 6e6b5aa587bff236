#pragma once

/// @file
/// A recipe's TOML seen as entries with names and places, and the complaints about them.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "recipe/toml.hpp"

namespace packstone::recipe {

/// A value of the recipe and the name by which messages call it; without node when it is absent.
struct Entry {
  const toml::node* node = nullptr;
  std::string name;  ///< "inclusions[0].size.lognormal.mean"

  explicit operator bool() const { return node != nullptr; }
};

/// All complaints about one recipe, so that all are told at once.
class Complaints {
 public:
  explicit Complaints(std::string origin) : origin_(std::move(origin)) {}

  /// "file:line: text"
  void add(const toml::node* at, const std::string& text);
  /// "file:line: key = value; allowed is `allowed`"
  void not_allowed(const Entry& entry, const std::string& allowed);
  /// "file:line: key is missing; allowed is `allowed`", at the table that lacks it.
  void missing(const toml::node* table, const std::string& key, const std::string& allowed);

  /// "file:line", the file alone where the node has no place.
  [[nodiscard]] std::string place(const toml::node* at) const;
  [[nodiscard]] std::size_t count() const { return lines_.size(); }
  [[nodiscard]] const std::string& origin() const { return origin_; }
  /// Throws InvalidArgument with all lines, if there is any.
  void throw_if_any() const;

 private:
  std::string origin_;
  std::vector<std::string> lines_;
};

/// Numbers that are allowed; `text` says it in words.
struct Range {
  std::string text;
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_excluded = false;
  bool hi_excluded = false;

  [[nodiscard]] bool holds(double x) const;
};

[[nodiscard]] Range any_number();
[[nodiscard]] Range positive_number();
[[nodiscard]] Range not_negative_number();
[[nodiscard]] Range fraction_number();  ///< > 0 and < 1.

/// "key = value"
[[nodiscard]] std::string quoted(const Entry& entry);

/// The keys of one TOML table. Keys outside `known` are complained about on construction.
class TableView {
 public:
  TableView(const toml::table& table, std::string name, std::vector<std::string_view> known,
            Complaints& complaints);

  /// The entry of `key`, absent or not.
  [[nodiscard]] Entry operator[](std::string_view key) const;
  [[nodiscard]] const toml::table& node() const { return table_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool has_unknown_keys() const { return has_unknown_keys_; }

 private:
  const toml::table& table_;
  std::string name_;
  bool has_unknown_keys_ = false;
};

/// The item `index` of an array entry.
[[nodiscard]] Entry item(const Entry& array, std::size_t index);

/// "name.key", or the key alone at the top.
[[nodiscard]] std::string joined(const std::string& name, std::string_view key);

/// "a, b, c"
[[nodiscard]] std::string list_of(const std::vector<std::string_view>& words);

/// The value as TOML text on one line, numbers as short as they round-trip, cut when long.
[[nodiscard]] std::string shown(const toml::node& node);

/// The line of a key a.b.c of more than 1000 parts. The parser bounds the nesting of brackets but
/// not that of such keys, and what goes down a tree calls itself once per level. Dots count until
/// one of ",=[]{}" or the end of the line, wherever they stand: strings and notes too.
[[nodiscard]] std::optional<int> line_of_endless_key(std::string_view text);

/// "; did you mean \"sphere\"?" where a known word is near to `word`, letter case apart; else "".
[[nodiscard]] std::string hint(const std::string& word, const std::vector<std::string_view>& known);

// Readers of one present entry: the value, or a complaint and nothing.
[[nodiscard]] std::optional<double> read_number(const Entry& entry, const Range& range,
                                                Complaints& complaints);
[[nodiscard]] std::optional<std::int64_t> read_integer(const Entry& entry, std::int64_t least,
                                                       Complaints& complaints);
[[nodiscard]] std::optional<bool> read_flag(const Entry& entry, Complaints& complaints);
[[nodiscard]] std::optional<std::vector<double>> read_numbers(const Entry& entry,
                                                              std::vector<std::size_t> counts,
                                                              const Range& range,
                                                              Complaints& complaints);

/// The table `key` of `parent`, if it is one; complains when it is something else.
[[nodiscard]] const toml::table* read_table(const TableView& parent, std::string_view key,
                                            Complaints& complaints);

/// One word of a list, as the value that stands beside it.
template <class T>
std::optional<T> read_choice(const Entry& entry,
                             const std::vector<std::pair<std::string_view, T>>& choices,
                             Complaints& complaints) {
  const auto word = entry.node->value_exact<std::string>();
  std::string listed;
  for (const auto& [text, value] : choices) {
    if (word == text) return value;
    listed += (listed.empty() ? "\"" : ", \"") + std::string(text) + "\"";
  }
  std::vector<std::string_view> words;
  words.reserve(choices.size());
  for (const auto& [text, value] : choices) words.push_back(text);
  complaints.not_allowed(entry, (choices.size() == 1 ? listed : "one of " + listed) +
                                    (word ? hint(*word, words) : ""));
  return std::nullopt;
}

}  // namespace packstone::recipe
