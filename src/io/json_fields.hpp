#pragma once

/// @file
/// Strict reading of a small JSON tree: every member asked for must be there, of the right type,
/// and no other may be.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace packstone {

/// Keeps the order of members, so that an embedded recipe comes back as it went in.
using Json = nlohmann::ordered_json;

/// Builds a tree from parser events. Unlike the library's own builder it refuses a member that
/// stands twice (InvalidArgument), and nesting so deep that later recursion could exhaust the
/// stack.
class JsonTreeBuilder {
 public:
  void key(std::string name);
  void scalar(Json value);
  void open(Json container);
  void close();

  [[nodiscard]] const Json& root() const { return root_; }
  [[nodiscard]] std::size_t depth() const { return open_.size(); }
  /// The member now being read.
  [[nodiscard]] const std::string& current_key() const { return key_; }

 private:
  struct Level {
    Json* container;
    std::vector<std::string> keys;  ///< Sorted.
  };
  Json& place(Json value);

  Json root_;
  std::vector<Level> open_;
  std::string key_;
};

/// The members of one object. Every error is InvalidArgument "where.field: ...".
class JsonFields {
 public:
  JsonFields(const Json& object, std::string where);

  [[nodiscard]] bool has(const char* field) const { return object_.contains(field); }
  double number(const char* field);
  double number_or_infinity(const char* field);  ///< null stands for +infinity.
  std::int64_t integer(const char* field);
  std::uint64_t unsigned_integer(const char* field);
  std::string text(const char* field);
  const Json& array(const char* field);
  const Json& object(const char* field);

  /// Refuses members that were not asked for.
  void finish() const;

 private:
  const Json& member(const char* field);
  [[noreturn]] void refuse(const char* field, const char* expected) const;

  const Json& object_;
  std::string where_;
  std::vector<std::string_view> asked_;
};

/// `value` as a number, true or false, or an integer; InvalidArgument "where: must be ..." if it is
/// none.
double as_number(const Json& value, const std::string& where);
bool as_flag(const Json& value, const std::string& where);
std::int64_t as_integer(const Json& value, const std::string& where);
std::string as_text(const Json& value, const std::string& where);

}  // namespace packstone
