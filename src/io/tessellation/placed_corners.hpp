#pragma once

/// @file
/// Numbers for the corners that stand in one place.

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// Where the corners stand [L].
[[nodiscard]] inline std::vector<Vec3> positions(const Tessellation& tessellation,
                                                 const std::vector<FacetCorner>& corners) {
  std::vector<Vec3> at;
  at.reserve(corners.size());
  for (const FacetCorner& corner : corners) at.push_back(position(tessellation, corner));
  return at;
}

/// Corners as they come, each vertex and image once.
class PlacedCorners {
 public:
  /// The number of a corner, from 0; a new one when it has not come yet.
  std::size_t number(const FacetCorner& corner) {
    const auto [entry, added] = numbers_.try_emplace(corner, corners_.size());
    if (added) corners_.push_back(corner);
    return entry->second;
  }

  [[nodiscard]] const std::vector<FacetCorner>& corners() const { return corners_; }
  [[nodiscard]] std::vector<Vec3> positions(const Tessellation& tessellation) const {
    return packstone::positions(tessellation, corners_);
  }

 private:
  struct Hash {
    std::size_t operator()(const FacetCorner& c) const noexcept {
      auto hash = static_cast<std::size_t>(c.vertex);
      for (const int shift : c.image) hash = hash * 31 + static_cast<std::size_t>(shift + 8);
      return hash;
    }
  };
  std::unordered_map<FacetCorner, std::size_t, Hash> numbers_;
  std::vector<FacetCorner> corners_;
};

}  // namespace packstone
