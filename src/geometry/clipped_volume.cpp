#include "packstone/geometry/clipped_volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/sections.hpp"
#include "geometry/unit_disk_polygon.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

constexpr double kHalfBall = 2.0 / 3.0 * pi;

Vec3 unit(std::size_t axis) {
  Vec3 e;
  e[axis] = 1.0;
  return e;
}

// Equation (1), of the ball: the share at or below tau.
double ball_share(double tau) {
  if (tau <= -1.0) return 0.0;
  if (tau >= 1.0) return 1.0;
  return 0.25 * (1.0 + tau) * (1.0 + tau) * (2.0 - tau);
}

// Area of the part of the unit disk at or below tau; equation (2) is pi times the share.
double disk_part(double tau) {
  if (tau <= -1.0) return 0.0;
  if (tau >= 1.0) return pi;
  const double half_chord = std::sqrt((1.0 - tau) * (1.0 + tau));
  return std::atan2(tau, half_chord) + tau * half_chord + 0.5 * pi;
}

// F of equation (3) for the unit disk.
double disk_integral(double m) {
  if (m <= -1.0) return 0.0;
  if (m >= 1.0) return pi * m;
  const double half_chord_sq = (1.0 - m) * (1.0 + m);
  return m * disk_part(m) + 2.0 / 3.0 * half_chord_sq * std::sqrt(half_chord_sq);
}

// Mean of disk_part between m - half and m + half, by Gauss' rule of five points: what is left of
// the difference in (3) where it would lose its digits.
double mean_disk_part(double m, double half) {
  constexpr double x_1 = 0.538469310105683091, w_1 = 0.239314335249683234;
  constexpr double x_2 = 0.906179845938663993, w_2 = 0.118463442528094544;
  constexpr double w_0 = 0.284444444444444444;
  const auto both = [&](double x) { return disk_part(m - half * x) + disk_part(m + half * x); };
  return w_0 * disk_part(m) + w_1 * both(x_1) + w_2 * both(x_2);
}

// Equation (3).
double cylinder_below(const Cylinder& body, std::size_t axis, double height) {
  const double r = body.radius, h = body.half_length;
  const double c = std::abs(body.axis[axis]);
  const double s = std::sqrt(std::max(0.0, (1.0 - c) * (1.0 + c)));
  constexpr double kUpright = 1e-12;
  if (s < kUpright) return pi * r * r * std::clamp(height + h, 0.0, 2.0 * h);
  const double m = height / (r * s), half = h * c / (r * s);
  constexpr double kThin = 1e-5;
  if (half < kThin) return 2.0 * h * r * r * mean_disk_part(m, half);
  return r * r * r * s / c * (disk_integral(m + half) - disk_integral(m - half));
}

// Where the section at tau lies on one side of the plane x.u = 0: all of the cap or none of it,
// around its pole or the other one.
double one_sided_half_ball_above(double tau, double c) {
  const double cap = 2.0 * kHalfBall * ball_share(-std::abs(tau));
  if (tau >= 0.0) return c > 0.0 ? cap : 0.0;
  return c > 0.0 ? kHalfBall : kHalfBall - cap;
}

// Of the half of the unit ball where x.u >= 0 the part with x.e >= tau, c = u.e; equation (4).
double half_ball_above(double tau, double c) {
  if (tau >= 1.0) return 0.0;
  if (tau <= -1.0) return kHalfBall;
  const double rim = std::sqrt((1.0 - tau) * (1.0 + tau));
  const double s = std::sqrt(std::max(0.0, (1.0 - c) * (1.0 + c)));
  if (rim <= std::abs(c) || s == 0.0) return one_sided_half_ball_above(tau, c);
  const double cut = std::clamp(-c * tau / (s * rim), -1.0, 1.0);
  const double alpha = 2.0 * std::acos(cut);
  const double beta = pi - std::acos(std::clamp(c / rim, -1.0, 1.0));
  const double section = rim * rim * disk_part(-cut);
  return (2.0 * beta - tau * alpha - tau * section) / 3.0;
}

double half_ball_below(double tau, double c) { return kHalfBall - half_ball_above(tau, c); }

double spherocylinder_below(const Spherocylinder& body, std::size_t axis, double height) {
  const double r = body.radius, c = body.axis[axis];
  const double lift = body.half_length * c;
  return cylinder_below({r, body.half_length, body.axis}, axis, height) +
         r * r * r *
             (half_ball_below((height - lift) / r, c) + half_ball_below((height + lift) / r, -c));
}

// The plane cuts the body.
double part_below(const Body& body, std::size_t axis, double height, double reach) {
  const double tau = height / reach;
  return std::visit(
      Overloaded{[&](const Cylinder& b) { return cylinder_below(b, axis, height); },
                 [&](const Spherocylinder& b) { return spherocylinder_below(b, axis, height); },
                 [&](const Disk& b) { return b.radius * b.radius * disk_part(tau); },
                 [&](const Ellipse& b) { return b.semi_axes.x * b.semi_axes.y * disk_part(tau); },
                 [&](const auto& b) { return volume(Body{b}) * ball_share(tau); }},
      body);
}

double area_in_rectangle(const Vec2& semi_axes, double angle, const Vec2& lo, const Vec2& hi) {
  const Vec2 u{std::cos(angle), std::sin(angle)};
  SmallPolygon polygon = rectangle(lo, hi);
  for (std::size_t i = 0; i < polygon.count; ++i) {
    Vec2& corner = polygon.corners[i];
    corner = {dot(u, corner) / semi_axes.x, cross(u, corner) / semi_axes.y};
  }
  return semi_axes.x * semi_axes.y * area_in_unit_disk(polygon);
}

SlicedBody sliced_ellipsoid(const Ellipsoid& body, const Vec3& half) {
  const Mat3 frame = to_matrix(body.orientation);
  SlicedBody sliced;
  for (std::size_t a = 0; a < 3; ++a) {
    sliced.rows[a] = scale({frame.col_x[a], frame.col_y[a], frame.col_z[a]}, body.semi_axes);
  }
  sliced.half_extents = half;
  return sliced;
}

// Where along its axis the part of a rod in a box is.
struct AxisRange {
  double from;
  double to;
};

// The sides that end the range still cut the rod, since it is thicker than its axis.
AxisRange range_along(const Vec3& axis, double half_length, const Vec3& lo, const Vec3& hi,
                      const Vec3& half) {
  constexpr double kFlat = 1e-9;
  AxisRange range{-half_length, half_length};
  for (std::size_t a = 0; a < 3; ++a) {
    if (std::abs(axis[a]) < kFlat) continue;
    const double width = half[a] - half_length * std::abs(axis[a]);
    const double low = (lo[a] - width) / axis[a], high = (hi[a] + width) / axis[a];
    range.from = std::max(range.from, std::min(low, high));
    range.to = std::min(range.to, std::max(low, high));
  }
  return range;
}

double cylinder_in_box(const Cylinder& body, const Vec3& lo, const Vec3& hi) {
  SlicedBody sliced;
  sliced.axis = body.axis;
  sliced.radius = body.radius;
  sliced.half_extents = half_extents(Body{body});
  const double h = body.half_length;
  const AxisRange range = range_along(body.axis, h, lo, hi, sliced.half_extents);
  if (range.from > range.to) return 0.0;
  if (range.to >= h) sliced.ends[sliced.end_count++] = {body.axis, h};
  if (range.from <= -h) sliced.ends[sliced.end_count++] = {-body.axis, h};
  return sliced_volume(sliced, lo, hi);
}

// The half of a ball where x.u >= 0.
double half_ball_in_box(double radius, const Vec3& u, const Vec3& lo, const Vec3& hi) {
  SlicedBody sliced = sliced_ellipsoid({{radius, radius, radius}, {}}, {radius, radius, radius});
  sliced.ends[0] = {-u, 0.0};
  sliced.end_count = 1;
  return sliced_volume(sliced, lo, hi);
}

double spherocylinder_in_box(const Spherocylinder& body, const Vec3& lo, const Vec3& hi) {
  const Vec3 end = body.half_length * body.axis;
  return cylinder_in_box({body.radius, body.half_length, body.axis}, lo, hi) +
         half_ball_in_box(body.radius, body.axis, lo - end, hi - end) +
         half_ball_in_box(body.radius, -body.axis, lo + end, hi + end);
}

struct Box {
  Vec3 lo;
  Vec3 hi;
};

// Box about the part of the body in another one.
Box box_along(const Vec3& axis, double half_length, const Vec3& lo, const Vec3& hi,
              const Vec3& half) {
  const AxisRange range = range_along(axis, half_length, lo, hi, half);
  if (range.from > range.to) return {half, -half};
  const Vec3 begin = range.from * axis, end = range.to * axis;
  Box box;
  for (std::size_t a = 0; a < 3; ++a) {
    const double width = half[a] - half_length * std::abs(axis[a]);
    box.lo[a] = std::min(begin[a], end[a]) - width;
    box.hi[a] = std::max(begin[a], end[a]) + width;
  }
  return box;
}

// A box that holds the part of the body in the box from `lo` to `hi`.
Box box_of_part(const Body& body, const Vec3& lo, const Vec3& hi, const Vec3& half) {
  if (const auto* rod = std::get_if<Cylinder>(&body)) {
    return box_along(rod->axis, rod->half_length, lo, hi, half);
  }
  if (const auto* rod = std::get_if<Spherocylinder>(&body)) {
    return box_along(rod->axis, rod->half_length, lo, hi, half);
  }
  return {-half, half};
}

double part_in_box(const Body& body, const Vec3& lo, const Vec3& hi, const Vec3& half) {
  const auto in_rectangle = [&](const Vec2& semi_axes, double angle) {
    return area_in_rectangle(semi_axes, angle, flatten(lo), flatten(hi));
  };
  return std::visit(
      Overloaded{
          [&](const Sphere& b) {
            return sliced_volume(sliced_ellipsoid({{b.radius, b.radius, b.radius}, {}}, half), lo,
                                 hi);
          },
          [&](const Ellipsoid& b) { return sliced_volume(sliced_ellipsoid(b, half), lo, hi); },
          [&](const Cylinder& b) { return cylinder_in_box(b, lo, hi); },
          [&](const Spherocylinder& b) { return spherocylinder_in_box(b, lo, hi); },
          [&](const Disk& b) {
            return in_rectangle({b.radius, b.radius}, 0.0);
          },
          [&](const Ellipse& b) { return in_rectangle(b.semi_axes, b.angle); }},
      body);
}

}  // namespace

double volume_below(const Body& body, std::size_t axis, double height) noexcept {
  const double reach = support(body, unit(axis));
  if (height <= -reach) return 0.0;
  if (height >= reach) return volume(body);
  return std::clamp(part_below(body, axis, height, reach), 0.0, volume(body));
}

double volume_in_box(const Body& body, const Vec3& lo, const Vec3& hi) noexcept {
  const auto axes = static_cast<std::size_t>(dimension(kind(body)));
  const Vec3 half = half_extents(body);
  const Box held = box_of_part(body, lo, hi, half);
  Box box{-half, half};
  std::size_t cuts = 0, cut_axis = 0;
  for (std::size_t a = 0; a < axes; ++a) {
    if (lo[a] >= hi[a] || lo[a] >= held.hi[a] || hi[a] <= held.lo[a]) return 0.0;
    if (lo[a] <= held.lo[a] && hi[a] >= held.hi[a]) continue;
    box.lo[a] = std::max(lo[a], -half[a]);
    box.hi[a] = std::min(hi[a], half[a]);
    ++cuts;
    cut_axis = a;
  }
  if (cuts == 0) return volume(body);
  if (cuts == 1) {
    return volume_below(body, cut_axis, hi[cut_axis]) - volume_below(body, cut_axis, lo[cut_axis]);
  }
  return std::clamp(part_in_box(body, box.lo, box.hi, half), 0.0, volume(body));
}

}  // namespace packstone
