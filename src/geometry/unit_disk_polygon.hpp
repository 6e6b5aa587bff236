#pragma once

/// @file
/// The area that a convex polygon and the unit disk have in common.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "packstone/core/vec.hpp"

namespace packstone {

/// A convex polygon, counterclockwise, of a few corners: a rectangle cut by up to two lines. Twelve
/// are enough even where rounding makes every side cross both.
struct SmallPolygon {
  std::array<Vec2, 12> corners;
  std::size_t count = 0;

  void add(const Vec2& corner) { corners[count++] = corner; }
};

inline SmallPolygon rectangle(const Vec2& lo, const Vec2& hi) {
  SmallPolygon polygon;
  for (const Vec2& corner : {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}) polygon.add(corner);
  return polygon;
}

/// The part with normal.p <= offset.
inline SmallPolygon clipped(const SmallPolygon& polygon, const Vec2& normal, double offset) {
  SmallPolygon result;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec2& p = polygon.corners[i];
    const Vec2& q = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double above_p = dot(normal, p) - offset, above_q = dot(normal, q) - offset;
    if (above_p <= 0.0) result.add(p);
    if ((above_p < 0.0 && above_q > 0.0) || (above_p > 0.0 && above_q < 0.0)) {
      result.add(p + above_p / (above_p - above_q) * (q - p));
    }
  }
  return result;
}

constexpr double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Signed area of the sector of the unit disk between the rays through p and q.
inline double sector_area(const Vec2& p, const Vec2& q) {
  return 0.5 * std::atan2(cross(p, q), dot(p, q));
}

/// Signed area that the triangle (0, p, q) has in the unit disk.
inline double side_area(const Vec2& p, const Vec2& q) {
  const Vec2 e = q - p;
  const double a = norm_sq(e), b = dot(p, e), c = norm_sq(p) - 1.0;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0.0 || a == 0.0) return sector_area(p, q);
  const double root = std::sqrt(discriminant);
  const double enters = std::clamp((-b - root) / a, 0.0, 1.0);
  const double leaves = std::clamp((root - b) / a, 0.0, 1.0);
  if (enters >= leaves) return sector_area(p, q);
  const Vec2 u = p + enters * e, v = p + leaves * e;
  return (enters > 0.0 ? sector_area(p, u) : 0.0) + 0.5 * cross(u, v) +
         (leaves < 1.0 ? sector_area(v, q) : 0.0);
}

/// Area of the polygon within the unit disk, to rounding of pi.
inline double area_in_unit_disk(const SmallPolygon& polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    area += side_area(polygon.corners[i], polygon.corners[i + 1 < polygon.count ? i + 1 : 0]);
  }
  return std::max(area, 0.0);
}

}  // namespace packstone
