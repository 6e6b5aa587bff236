#pragma once

/// @file
/// Closed loops out of directed edges in the plane.

#include <cstddef>
#include <vector>

#include "packstone/core/vec.hpp"

namespace packstone {

/// A directed edge between two points, given by their numbers; what is outlined lies to its left.
struct DirectedEdge {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// The edges in loops, as indices in the order in which they are passed. Where several edges leave
/// a point the sharpest turn to the left is taken, so that areas that touch in a point only are
/// outlined apart.
///
/// @pre  Every point is the end of as many edges as it is the start of.
[[nodiscard]] std::vector<std::vector<std::size_t>> plane_loops(
    const std::vector<DirectedEdge>& edges, const std::vector<Vec3>& points);

/// Signed area of a polygon, > 0 counterclockwise [L^2].
[[nodiscard]] double signed_area(const std::vector<Vec3>& polygon);

/// Whether `p` lies in a polygon: an odd number of edges passes to its right.
[[nodiscard]] bool holds(const std::vector<Vec3>& polygon, const Vec3& p);

/// Whether the open segments ab and cd cross each other.
[[nodiscard]] bool cross_each_other(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace packstone
