#include "recipe/nearest_key.hpp"

#include <algorithm>
#include <cstddef>

namespace packstone::recipe {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<int> table((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> int& { return table[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int exchange = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, exchange});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return at(a.size(), b.size());
}

std::optional<std::string_view> nearest_key(std::string_view word,
                                            const std::vector<std::string_view>& known) {
  std::optional<std::string_view> best;
  int best_distance = 1 << 20;
  for (const std::string_view candidate : known) {
    const bool prefix = word.size() >= 3 && candidate.size() >= 3 &&
                        (candidate.starts_with(word) || word.starts_with(candidate));
    const int distance = prefix ? 1 : edit_distance(word, candidate);
    const int allowed =
        std::max<int>(1, static_cast<int>(std::max(word.size(), candidate.size()) / 3));
    if (distance > allowed || distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

}  // namespace packstone::recipe
