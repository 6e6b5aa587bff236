#pragma once

/// @file
/// The known word that a misspelled one most likely stands for.

#include <optional>
#include <string_view>
#include <vector>

namespace packstone::recipe {

/// Least number of letters to insert, delete, exchange, or swap with their neighbor to turn `a`
/// into `b` (optimal string alignment: F. J. Damerau, Commun. ACM 7 (1964) 171-176).
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// The word of `known` nearest to `word`, if it is near: at most a third of the letters differ, or
/// one of them begins with the other.
[[nodiscard]] std::optional<std::string_view> nearest_key(
    std::string_view word, const std::vector<std::string_view>& known);

}  // namespace packstone::recipe
