#pragma once

/// @file
/// Where two bodies that touch meet.
///
/// The contact of rods is often more than a point: a stretch of two parallel sides, the part of a
/// side that lies across a flat end, the lens that two flat ends share. Their gap closes as fast as
/// the fastest of these points; how two bodies collide depends on which one they meet at.

#include "geometry/posed_body.hpp"

namespace packstone {

/// The points of both bodies across from each other.
struct TouchingPoints {
  Vec3 of_a;  ///< From the center of a [L].
  Vec3 of_b;  ///< From the center of b [L].
};

/// Where a and b come nearest along the unit vector n, which points from a to b; r from center to
/// center. Of a side that they share: what lies farthest along `toward`, or for 0 its middle.
[[nodiscard]] TouchingPoints touching_points(const PosedBody& a, const PosedBody& b, const Vec3& r,
                                             const Vec3& n, const Vec3& toward);

/// The same for a body and a wall.
[[nodiscard]] Vec3 touching_point(const PosedBody& body, const Vec3& n, const Vec3& toward);

}  // namespace packstone
