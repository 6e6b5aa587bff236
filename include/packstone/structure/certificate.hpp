#pragma once

/// @file
/// Certificate: the verdict of check_packing(), stored with a packing.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace packstone {

/// What stands in one group.
struct GroupCensus {
  std::string name;
  std::int64_t count = 0;  ///< Inclusions of the group.
  double fraction = 0.0;   ///< Their volume over that of the cell [-].

  friend bool operator==(const GroupCensus&, const GroupCensus&) = default;
};

/// The verdict on a packing: is it free of overlap, for all periodic images?
struct Certificate {
  std::int64_t count = 0;  ///< Inclusions.
  double fraction = 0.0;   ///< Sum of their volumes over that of the cell [-].
  std::vector<GroupCensus> groups;
  double min_gap = 0.0;       ///< The least gap that was asked for [L].
  double smallest_gap = 0.0;  ///< Over all pairs and images, own images included [L]; infinite
                              ///< when there is no pair (one body, no period).
  double smallest_gap_error = 0.0;  ///< Proven bound on the error of smallest_gap [L].
  std::array<std::int64_t, 2> worst_pair{-1, -1};  ///< The pair it belongs to; i = j: own image.
  std::array<int, 3> worst_image{0, 0, 0};         ///< Periods by which the second one is shifted.
  std::int64_t overlaps = 0;                       ///< Pairs (with image) not proven to be apart.
  std::int64_t gaps_below = 0;     ///< Pairs proven apart, but not proven to keep min_gap.
  std::int64_t outside_walls = 0;  ///< Inclusions that are not proven to stay inside the walls.
  std::int64_t pairs_checked = 0;  ///< Pairs (with image) that came to the exact test.

  friend bool operator==(const Certificate&, const Certificate&) = default;

  /// No overlap, no gap below min_gap, nothing outside the walls.
  [[nodiscard]] bool passed() const noexcept {
    return overlaps == 0 && gaps_below == 0 && outside_walls == 0;
  }
};

}  // namespace packstone
