#pragma once

/// @file
/// The corners of facets where they stand, and numbers for those in one place.

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

/// The corners of a facet where its inner cell stands or, if `outer`, its outer one; in the order
/// of the inner one.
[[nodiscard]] inline std::vector<FacetCorner> placed_facet(const Tessellation& tessellation,
                                                           const Facet& facet, bool outer) {
  const auto first = tessellation.corners.begin() + facet.first_corner;
  std::vector<FacetCorner> corners(first, first + facet.corner_count);
  for (FacetCorner& corner : corners) {
    for (std::size_t a = 0; outer && a < 3; ++a) corner.image[a] -= facet.image[a];
  }
  return corners;
}

/// Unit normal of a polygon in space, corners counterclockwise; 0 where it has no area.
[[nodiscard]] inline Vec3 polygon_normal(const std::vector<Vec3>& corners) {
  Vec3 normal;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    normal += cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  }
  return norm_sq(normal) > 0.0 ? normalized(normal) : Vec3{};
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
