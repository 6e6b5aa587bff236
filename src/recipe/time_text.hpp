#pragma once

/// @file
/// Times as people write them: "10 min", "30 s", "1.5 h".

#include <optional>

#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// A number of seconds, or a text for seconds_in().
[[nodiscard]] std::optional<double> read_time(const Entry& entry, Complaints& complaints);

}  // namespace packstone::recipe
