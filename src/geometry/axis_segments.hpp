#pragma once

/// @file
/// The points of two segments next to each other, accurate for parallel and nearly parallel ones.
///
/// With u, v the directions (u.v >= 0), p = s u and q = r + t v, and w the part of v across u,
///
///     s = u.r - (u.v) (w.r) / |w|^2                                                        (1)
///
/// minimizes |q - p| over both lines. w comes from v - u, which is exact to rounding of its own
/// length, so (1) holds to rounding over |w| and |q - p| to rounding, however small the angle.
///
/// Reference for the clamping order: C. Ericson, Real-Time Collision Detection (2005), 5.1.9.

#include <algorithm>
#include <cmath>

#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A segment about its center: half length and unit direction.
struct Segment {
  double half_length = 0.0;
  Vec3 axis;
};

/// The nearest points, each relative to the center of its own segment.
struct NearestPoints {
  Vec3 on_a;
  Vec3 on_b;
  Vec3 between;  ///< From the point of a to the point of b.
};

/// Part of v across the unit vector u, taken twice so that nothing along u is left.
inline Vec3 part_across(const Vec3& u, const Vec3& v) {
  const Vec3 once = v - dot(u, v) * u;
  return once - dot(u, once) * u;
}

/// The nearest points of two segments, r from the center of a to that of b.
inline NearestPoints nearest_points(const Segment& a, const Segment& b, const Vec3& r) {
  const Vec3& u = a.axis;
  const Vec3 v = dot(u, b.axis) < 0.0 ? -b.axis : b.axis;
  const double cosine = dot(u, v), along = dot(u, r);
  Vec3 w = v - u;
  w -= dot(u, w) * u;
  const double sine_sq = norm_sq(w);
  double s;
  if (sine_sq > kUnitRoundoff * kUnitRoundoff) {
    s = std::clamp(along - cosine * dot(w, r) / sine_sq, -a.half_length, a.half_length);
  } else {
    // Parallel: the middle of the stretch that both cover.
    const double low = std::clamp(along - b.half_length, -a.half_length, a.half_length);
    const double high = std::clamp(along + b.half_length, -a.half_length, a.half_length);
    s = 0.5 * (low + high);
  }
  const double t = std::clamp(cosine * s - dot(v, r), -b.half_length, b.half_length);
  s = std::clamp(along + cosine * t, -a.half_length, a.half_length);
  NearestPoints points{s * u, t * v, {}};
  points.between = r + points.on_b - points.on_a;
  return points;
}

/// The same for a point r and a segment about the origin.
inline Vec3 nearest_point(const Segment& a, const Vec3& r) {
  return std::clamp(dot(a.axis, r), -a.half_length, a.half_length) * a.axis;
}

/// Two balls with centers `distance` apart overlap: the part of the way from a to b that leads to
/// the middle of what they share, as deep in one as in the other. Dividing the way as the radii
/// would leave the smaller ball less room than rounding takes.
inline double middle_of_overlap(double radius_a, double radius_b, double distance) {
  if (!(distance > 0.0)) return 0.0;
  return std::clamp(0.5 * (1.0 + (radius_a - radius_b) / distance), 0.0, 1.0);
}

}  // namespace packstone
