#include "io/json_fields.hpp"

#include <algorithm>
#include <limits>

#include "packstone/core/error.hpp"

namespace packstone {
namespace {

constexpr std::size_t kMaxDepth = 64;

bool is_int64(const Json& value) {
  constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return value.is_number_integer() &&
         (!value.is_number_unsigned() || value.get<std::uint64_t>() <= kMax);
}

}  // namespace

void JsonTreeBuilder::key(std::string name) {
  auto& keys = open_.back().keys;
  const auto place = std::lower_bound(keys.begin(), keys.end(), name);
  if (place != keys.end() && *place == name) {
    throw InvalidArgument("field '" + name + "' stands twice");
  }
  keys.insert(place, name);
  key_ = std::move(name);
}

Json& JsonTreeBuilder::place(Json value) {
  if (open_.empty()) return root_ = std::move(value);
  Json& parent = *open_.back().container;
  if (parent.is_array()) {
    parent.push_back(std::move(value));
    return parent.back();
  }
  // key() has seen to it that the name is new; a search for it here would make long objects slow.
  auto& members = parent.get_ref<Json::object_t&>();
  members.emplace_back(key_, std::move(value));
  return members.back().second;
}

void JsonTreeBuilder::scalar(Json value) { place(std::move(value)); }

void JsonTreeBuilder::open(Json container) {
  if (open_.size() >= kMaxDepth) {
    throw InvalidArgument("nested deeper than " + std::to_string(kMaxDepth) + " levels");
  }
  Json& placed = place(std::move(container));
  open_.push_back({&placed, {}});
}

void JsonTreeBuilder::close() { open_.pop_back(); }

JsonFields::JsonFields(const Json& object, std::string where)
    : object_(object), where_(std::move(where)) {
  if (!object.is_object()) throw InvalidArgument(where_ + ": must be an object");
}

const Json& JsonFields::member(const char* field) {
  const auto found = object_.find(field);
  if (found == object_.end()) {
    throw InvalidArgument(where_ + ": field '" + field + "' is missing");
  }
  asked_.push_back(field);
  return *found;
}

double JsonFields::number(const char* field) {
  return as_number(member(field), where_ + "." + field);
}

double JsonFields::number_or_infinity(const char* field) {
  const Json& value = member(field);
  if (value.is_null()) return std::numeric_limits<double>::infinity();
  return as_number(value, where_ + "." + field);
}

std::int64_t JsonFields::integer(const char* field) {
  return as_integer(member(field), where_ + "." + field);
}

std::uint64_t JsonFields::unsigned_integer(const char* field) {
  const Json& value = member(field);
  if (!value.is_number_unsigned()) refuse(field, "an integer, 0 to 2^64 - 1");
  return value.get<std::uint64_t>();
}

std::string JsonFields::text(const char* field) {
  return as_text(member(field), where_ + "." + field);
}

const Json& JsonFields::array(const char* field) {
  const Json& value = member(field);
  if (!value.is_array()) refuse(field, "an array");
  return value;
}

const Json& JsonFields::object(const char* field) {
  const Json& value = member(field);
  if (!value.is_object()) refuse(field, "an object");
  return value;
}

void JsonFields::finish() const {
  for (const auto& [key, value] : object_.items()) {
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    throw InvalidArgument(where_ + ": unknown field '" + key + "'");
  }
}

void JsonFields::refuse(const char* field, const char* expected) const {
  throw InvalidArgument(where_ + "." + field + ": must be " + expected);
}

double as_number(const Json& value, const std::string& where) {
  if (!value.is_number()) throw InvalidArgument(where + ": must be a number");
  return value.get<double>();
}

bool as_flag(const Json& value, const std::string& where) {
  if (!value.is_boolean()) throw InvalidArgument(where + ": must be true or false");
  return value.get<bool>();
}

std::int64_t as_integer(const Json& value, const std::string& where) {
  if (!is_int64(value)) throw InvalidArgument(where + ": must be an integer");
  return value.get<std::int64_t>();
}

std::string as_text(const Json& value, const std::string& where) {
  if (!value.is_string()) throw InvalidArgument(where + ": must be text");
  return value.get<std::string>();
}

}  // namespace packstone
