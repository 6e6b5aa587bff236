#pragma once

/// @file
/// Which pairs overlap although no collision was found; by the proven kernel, over all images.

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/generate/published_event_driven.hpp"

namespace packstone::published {

/// Counts pairs that begin to overlap.
class Audit {
 public:
  /// Pairs that overlap now by more than a millionth of their size, and did not when last asked.
  std::int64_t new_overlaps(const Cell& cell, const std::vector<MovingEllipsoid>& bodies);

 private:
  std::set<std::pair<std::size_t, std::size_t>> overlapping_;
};

}  // namespace packstone::published
