#include "recipe/time_text.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "packstone/recipe/recipe.hpp"

namespace packstone {

std::optional<double> seconds_in(std::string_view text) {
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc{} || !std::isfinite(value) || value <= 0.0) return std::nullopt;
  std::string_view unit(end, static_cast<std::size_t>(last - end));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"", 1.0},        {"s", 1.0},       {"sec", 1.0},     {"second", 1.0},
      {"seconds", 1.0}, {"min", 60.0},    {"minute", 60.0}, {"minutes", 60.0},
      {"h", 3600.0},    {"hour", 3600.0}, {"hours", 3600.0}};
  for (const auto& [word, seconds] : kUnits) {
    if (unit == word) return value * seconds;
  }
  return std::nullopt;
}

namespace recipe {

std::optional<double> read_time(const Entry& entry, Complaints& complaints) {
  std::optional<double> seconds;
  if (const auto text = entry.node->value_exact<std::string>()) seconds = seconds_in(*text);
  if (entry.node->is_number()) seconds = entry.node->value<double>();
  if (seconds && std::isfinite(*seconds) && *seconds > 0.0) return seconds;
  complaints.not_allowed(entry,
                         "a time > 0: a number of seconds, or \"30 s\", \"10 min\", \"1.5 h\"");
  return std::nullopt;
}

}  // namespace recipe
}  // namespace packstone
