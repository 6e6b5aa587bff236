#pragma once

/// @file
/// What power cells in the plane and in space have in common.

#include <array>
#include <cstdint>
#include <span>

#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::laguerre {

/// What reaches beyond a plane by no more than this part of the radius of the cell does not count
/// as cut [-]: cells of sites on one circle do not get edges of the length of the rounding.
inline constexpr double kTouching = 1e-12;

/// Measure and moments about the site.
struct CellMoments {
  double measure = 0.0;
  Vec3 first;
  SymMat3 second;
};

inline constexpr std::int32_t kNoPlane = -1;

/// A corner of a facet, and the planes that meet there: two in 2D, three in 3D.
struct FacetPoint {
  Vec3 at;
  std::array<std::int32_t, 3> planes{kNoPlane, kNoPlane, kNoPlane};
};

/// Length of an edge, area of a plane polygon.
inline double facet_measure(std::span<const FacetPoint> points) {
  if (points.size() == 2) return norm(points[1].at - points[0].at);
  Vec3 twice;
  for (std::size_t k = 2; k < points.size(); ++k) {
    twice += cross(points[k - 1].at - points[0].at, points[k].at - points[0].at);
  }
  return 0.5 * norm(twice);
}

}  // namespace packstone::laguerre
