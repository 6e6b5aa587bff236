#include "packstone/geometry/cylinder_contact.hpp"

#include <cmath>

#include "geometry/axis_segments.hpp"
#include "geometry/convex_contact.hpp"
#include "geometry/proof.hpp"

namespace packstone {
namespace {

// The factor that scales the surface of the cylinder through x.
double gauge(const Cylinder& body, const Vec3& x) {
  const double along = dot(body.axis, x);
  return std::fmax(std::abs(along) / body.half_length, norm(x - along * body.axis) / body.radius);
}

// A bound from above is all that is needed: the cylinder inside the spherocylinder.
double gauge(const Spherocylinder& body, const Vec3& x) {
  const double along = dot(body.axis, x);
  return std::fmax(std::abs(along) / (body.half_length + body.radius),
                   norm(x - along * body.axis) / body.radius);
}

// Stage 1, accept: the common point on the line of centers, if there is one.
template <class A, class B>
bool share_point_of_line(const A& a, const B& b, const Vec3& r, Decision& decision) {
  const double gauge_a = gauge(a, r), gauge_b = gauge(b, r);
  if (!(gauge_a * gauge_b < gauge_a + gauge_b)) return false;
  decision.witness = (gauge_b / (gauge_a + gauge_b)) * r;
  return in_both(a, b, r, decision.witness);
}

template <class A, class B>
Decision decide_rods(const A& a, const B& b, const Vec3& r, double min_gap) {
  const double slack = gap_roundoff(a, b, r) + min_gap;
  Decision decision;
  const auto separates = [&](const Vec3& d) {
    decision.witness = d;
    return gap_along(a, b, r, d) > slack;
  };
  const double distance_sq = norm_sq(r);
  if (distance_sq == 0.0) return {Verdict::overlapping, Vec3{}};
  if (separates(r / std::sqrt(distance_sq))) return {Verdict::separated, decision.witness};
  if (min_gap == 0.0 && share_point_of_line(a, b, r, decision)) {
    return {Verdict::overlapping, decision.witness};
  }
  const NearestPoints axes = nearest_points({a.half_length, a.axis}, {b.half_length, b.axis}, r);
  const double apart = norm(axes.between);
  if (apart > 0.0 && separates(axes.between / apart)) {
    return {Verdict::separated, decision.witness};
  }
  if (min_gap == 0.0 && apart < a.radius + b.radius) {
    const Vec3 x = axes.on_a + middle_of_overlap(a.radius, b.radius, apart) * axes.between;
    if (in_both(a, b, r, x)) return {Verdict::overlapping, x};
    // The nearest points of nearly parallel axes are ends of them, where x has no room.
    if (std::abs(dot(a.axis, b.axis)) > 1.0 - 1e-12) {
      const double along = dot(a.axis, r);
      const double low = std::fmax(-a.half_length, along - b.half_length);
      const double high = std::fmin(a.half_length, along + b.half_length);
      const Vec3 inward = x + 1e-3 * (0.5 * (low + high) - dot(a.axis, x)) * a.axis;
      if (in_both(a, b, r, inward)) return {Verdict::overlapping, inward};
    }
  }
  if (separates(dot(a.axis, r) < 0.0 ? -a.axis : a.axis) ||
      separates(dot(b.axis, r) < 0.0 ? -b.axis : b.axis)) {
    return {Verdict::separated, decision.witness};
  }
  return convex::decide(a, b, r, min_gap);
}

template <class A, class B>
double quick_bound_rods(const A& a, const B& b, const Vec3& r) {
  const double distance = norm(r);
  const double centers = distance > 0.0 ? gap_along(a, b, r, r / distance)
                                        : gap_along(a, b, r, any_perpendicular(a.axis));
  const NearestPoints axes = nearest_points({a.half_length, a.axis}, {b.half_length, b.axis}, r);
  const double apart = norm(axes.between);
  const double along_axes = apart > 0.0 ? gap_along(a, b, r, axes.between / apart) : centers;
  return std::fmax(centers, along_axes) - gap_roundoff(a, b, r);
}

}  // namespace

Decision decide(const Cylinder& a, const Cylinder& b, const Vec3& r_ab, double min_gap) noexcept {
  return decide_rods(a, b, r_ab, min_gap);
}

Decision decide(const Cylinder& a, const Spherocylinder& b, const Vec3& r_ab,
                double min_gap) noexcept {
  return decide_rods(a, b, r_ab, min_gap);
}

double quick_gap_bound(const Cylinder& a, const Cylinder& b, const Vec3& r_ab) noexcept {
  return quick_bound_rods(a, b, r_ab);
}

double quick_gap_bound(const Cylinder& a, const Spherocylinder& b, const Vec3& r_ab) noexcept {
  return quick_bound_rods(a, b, r_ab);
}

}  // namespace packstone
