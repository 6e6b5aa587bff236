#include "geometry/touching_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/axis_segments.hpp"

namespace packstone {
namespace {

// What of a body rests on a plane.
enum class Rest { point, line, flat };

// From the center of a, flattened onto the plane.
struct Side {
  Rest rest = Rest::point;
  Vec3 middle;
  Vec3 direction;       // Of lines, unit.
  double extent = 0.0;  // Half length of lines, radius of flats [L].
};

// A side that is tilted to the plane by no more than this rests on it.
Rest rest_of(const PosedBody& body, const Vec3& n) {
  constexpr double kOnSide = 1e-7;
  if (is_ellipsoid(body.form)) return Rest::point;
  const double along = dot(body.pose.axis, n);
  if (std::abs(along) < kOnSide) return Rest::line;
  const bool flat = body.form == Form::cylinder && norm(n - along * body.pose.axis) < kOnSide;
  return flat ? Rest::flat : Rest::point;
}

Vec3 flattened(const Vec3& v, const Vec3& n) { return v - dot(v, n) * n; }

// `out`, n or -n, points out of the body.
Side side_of(const PosedBody& body, const Vec3& center, const Vec3& n, const Vec3& out) {
  Side side;
  side.rest = rest_of(body, n);
  if (side.rest == Rest::point) {
    side.middle = flattened(center + support_point(body, out), n);
    return side;
  }
  side.middle = flattened(center, n);
  if (side.rest == Rest::line) {
    side.direction = normalized(flattened(body.pose.axis, n));
    side.extent = body.axial;
  } else {
    side.extent = body.lateral;
  }
  return side;
}

// Of the stretch from low to high along a line; where there is none, between both.
Vec3 of_stretch(const Side& line, double low, double high, const Vec3& toward) {
  const double slope = low < high ? dot(line.direction, toward) : 0.0;
  const double at = slope > 0.0 ? high : slope < 0.0 ? low : 0.5 * (low + high);
  return line.middle + std::clamp(at, -line.extent, line.extent) * line.direction;
}

// Lines less than kParallel apart keep so close to each other that all of what both cover touches.
Vec3 of_lines(const Side& a, const Side& b, const Vec3& toward) {
  constexpr double kParallel = 1e-5;
  const Vec3 r = b.middle - a.middle;
  if (norm(cross(a.direction, b.direction)) > kParallel) {
    const NearestPoints nearest =
        nearest_points({a.extent, a.direction}, {b.extent, b.direction}, r);
    return a.middle + nearest.on_a + 0.5 * nearest.between;
  }
  const double along = dot(a.direction, r);
  return of_stretch(a, std::max(-a.extent, along - b.extent), std::min(a.extent, along + b.extent),
                    toward);
}

Vec3 of_line_and_flat(const Side& line, const Side& flat, const Vec3& toward) {
  const Vec3 r = flat.middle - line.middle;
  const double along = dot(line.direction, r);
  const double across_sq = norm_sq(r - along * line.direction);
  const double half = std::sqrt(std::max(0.0, flat.extent * flat.extent - across_sq));
  return of_stretch(line, std::max(-line.extent, along - half), std::min(line.extent, along + half),
                    toward);
}

bool holds(const Side& flat, const Vec3& point) {
  return norm_sq(point - flat.middle) <= flat.extent * flat.extent;
}

// Of the two corners of the lens: `between` is the distance of the middles, e the unit vector
// along.
Vec3 corner_of_lens(const Side& a, const Side& b, const Vec3& e, double between,
                    const Vec3& toward) {
  const double at =
      (between * between + a.extent * a.extent - b.extent * b.extent) / (2.0 * between);
  const double height = std::sqrt(std::max(0.0, a.extent * a.extent - at * at));
  const Vec3 across = toward - dot(toward, e) * e;
  const double length = norm(across);
  return a.middle + at * e + (length > 0.0 ? height / length : 0.0) * across;
}

Vec3 of_flats(const Side& a, const Side& b, const Vec3& toward) {
  const Vec3 r = b.middle - a.middle;
  const double between = norm(r);
  const Vec3 e = between > 0.0 ? r / between : Vec3{};
  const double length = norm(toward);
  if (!(length > 0.0)) {
    const double low = std::max(-a.extent, between - b.extent);
    const double high = std::min(a.extent, between + b.extent);
    return a.middle + (0.5 * (low + high)) * e;
  }
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Vec3 rim = one->middle + (one->extent / length) * toward;
    if (holds(*other, rim)) return rim;
  }
  return corner_of_lens(a, b, e, between, toward);
}

Vec3 shared_point(const Side& a, const Side& b, const Vec3& toward) {
  if (a.rest == Rest::point && b.rest == Rest::point) return 0.5 * (a.middle + b.middle);
  if (a.rest == Rest::point) return a.middle;
  if (b.rest == Rest::point) return b.middle;
  if (a.rest == Rest::flat && b.rest == Rest::flat) return of_flats(a, b, toward);
  if (a.rest == Rest::flat) return of_line_and_flat(b, a, toward);
  if (b.rest == Rest::flat) return of_line_and_flat(a, b, toward);
  return of_lines(a, b, toward);
}

}  // namespace

TouchingPoints touching_points(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& n,
                               const Vec3& toward) {
  const Side side_a = side_of(a, {}, n, n), side_b = side_of(b, r, n, -n);
  if (side_a.rest == Rest::point && side_b.rest == Rest::point) {
    return {support_point(a, n), support_point(b, -n)};
  }
  const Vec3 shared = shared_point(side_a, side_b, flattened(toward, n));
  return {shared + support(a, n) * n, shared + (dot(r, n) - support(b, n)) * n - r};
}

Vec3 touching_point(const PosedBody& body, const Vec3& n, const Vec3& toward) {
  const Side side = side_of(body, {}, n, n);
  if (side.rest == Rest::point) return support_point(body, n);
  const Side wall{Rest::flat, {}, {}, std::numeric_limits<double>::infinity()};
  return shared_point(side, wall, flattened(toward, n)) + support(body, n) * n;
}

}  // namespace packstone
