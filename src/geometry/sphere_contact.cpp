#include "packstone/geometry/sphere_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/axis_segments.hpp"
#include "geometry/proof.hpp"

namespace packstone {
namespace {

NearestPoints core_points(const Sphere&, const Sphere&, const Vec3& r) { return {{}, {}, r}; }

NearestPoints core_points(const Sphere&, const Spherocylinder& b, const Vec3& r) {
  const Vec3 on_b = nearest_point({b.half_length, b.axis}, -r);
  return {{}, on_b, r + on_b};
}

NearestPoints core_points(const Spherocylinder& a, const Spherocylinder& b, const Vec3& r) {
  return nearest_points({a.half_length, a.axis}, {b.half_length, b.axis}, r);
}

// The best of a few directions, by g(d) as evaluated.
template <class A, class B>
class BestDirection {
 public:
  BestDirection(const A& a, const B& b, const Vec3& r) : a_(a), b_(b), r_(r) {}

  void offer(const Vec3& d) {
    const double length = norm(d);
    if (!(length > 0.0)) return;
    const Vec3 unit = d / length;
    const double value = gap_along(a_, b_, r_, unit);
    if (!(value > value_)) return;
    direction_ = unit;
    value_ = value;
  }
  void offer_both(const Vec3& d) {
    offer(d);
    offer(-d);
  }

  double value() const { return value_; }
  const Vec3& direction() const { return direction_; }

 private:
  const A& a_;
  const B& b_;
  const Vec3& r_;
  double value_ = -std::numeric_limits<double>::infinity();
  Vec3 direction_;
};

// Directions in which (1) may be attained when the cores all but touch: there the vector between
// the nearest points is rounding, and the direction comes from the axes.
void offer_across(BestDirection<Sphere, Sphere>& best, const Sphere&, const Sphere&, const Vec3&) {
  best.offer({1, 0, 0});
}
void offer_across(BestDirection<Sphere, Spherocylinder>& best, const Sphere&,
                  const Spherocylinder& b, const Vec3& between) {
  best.offer(part_across(b.axis, between));
  best.offer(any_perpendicular(b.axis));
}
void offer_across(BestDirection<Spherocylinder, Spherocylinder>& best, const Spherocylinder& a,
                  const Spherocylinder& b, const Vec3& between) {
  best.offer(part_across(a.axis, between));
  best.offer(part_across(b.axis, between));
  best.offer(any_perpendicular(a.axis));
  // The difference is exact where the axes are nearly parallel.
  const Vec3 towards = dot(a.axis, b.axis) < 0.0 ? -b.axis - a.axis : b.axis - a.axis;
  best.offer_both(cross(a.axis, towards));
}

// Decision of two grown cores, equation (1).
template <class A, class B>
Decision decide_grown(const A& a, const B& b, const Vec3& r, double min_gap) {
  const NearestPoints points = core_points(a, b, r);
  const double distance = norm(points.between);
  const double radii = a.radius + b.radius;
  if (distance > radii + min_gap) {
    const Vec3 d = points.between / distance;
    if (proven_gap_along(a, b, r, d) > min_gap) return {Verdict::separated, d};
    BestDirection<A, B> best(a, b, r);
    best.offer(d);
    offer_across(best, a, b, points.between);
    const bool proven = best.value() - gap_roundoff(a, b, r) > min_gap;
    return {proven ? Verdict::separated : Verdict::undecided, best.direction()};
  }
  const Vec3 common =
      points.on_a + middle_of_overlap(a.radius, b.radius, distance) * points.between;
  if (min_gap == 0.0) {
    if (in_both(a, b, r, common)) return {Verdict::overlapping, common};
  }
  const bool near = min_gap > 0.0 && distance + gap_roundoff(a, b, r) <= radii + min_gap;
  const Vec3 d = distance > 0.0 ? points.between / distance : Vec3{1, 0, 0};
  return {near ? Verdict::overlapping : Verdict::undecided, d};
}

// Gap from its value by closed form, an upper bound up to rounding, and the direction that attains
// it.
template <class A, class B>
Gap closed_gap(const A& a, const B& b, const Vec3& r, double upper, const Vec3& normal,
               const Vec3& point_a) {
  const double value = gap_along(a, b, r, normal);
  return {value, std::fmax(upper - value, 0.0) + 2 * gap_roundoff(a, b, r), normal, point_a,
          point_a + value * normal};
}

template <class A, class B>
Gap gap_grown(const A& a, const B& b, const Vec3& r) {
  const NearestPoints points = core_points(a, b, r);
  BestDirection<A, B> best(a, b, r);
  best.offer(points.between);
  const double distance = norm(points.between);
  if (distance < 1e-3 * (norm(r) + reach(a) + reach(b))) offer_across(best, a, b, points.between);
  const Vec3& d = best.direction();
  return closed_gap(a, b, r, distance - (a.radius + b.radius), d, points.on_a + a.radius * d);
}

template <class A, class B>
double quick_bound_grown(const A& a, const B& b, const Vec3& r) {
  const Gap full = gap_grown(a, b, r);
  return full.value - gap_roundoff(a, b, r);
}

// Where the center of the sphere stands, seen from the cylinder.
struct CylinderPlace {
  Vec3 center;   // relative to the center of the cylinder
  double along;  // coordinate along the axis
  Vec3 across;   // part across the axis
  double rho;    // its length
  Vec3 nearest;  // point of the cylinder next to the center
  Vec3 outward;  // center - nearest, built from its parts along and across
};

CylinderPlace place(const Cylinder& body, const Vec3& center) {
  CylinderPlace p;
  p.center = center;
  p.along = dot(body.axis, center);
  p.across = part_across(body.axis, center);
  p.rho = norm(p.across);
  const double over_end = std::fmax(std::abs(p.along) - body.half_length, 0.0);
  const double over_side = std::fmax(p.rho - body.radius, 0.0);
  const Vec3 side = p.rho > 0.0 ? p.across / p.rho : Vec3{};
  p.outward = std::copysign(over_end, p.along) * body.axis + over_side * side;
  p.nearest = std::clamp(p.along, -body.half_length, body.half_length) * body.axis +
              std::fmin(p.rho, body.radius) * side;
  return p;
}

}  // namespace

Decision decide(const Sphere& a, const Sphere& b, const Vec3& r_ab, double min_gap) noexcept {
  return decide_grown(a, b, r_ab, min_gap);
}

Decision decide(const Sphere& a, const Spherocylinder& b, const Vec3& r_ab,
                double min_gap) noexcept {
  return decide_grown(a, b, r_ab, min_gap);
}

Decision decide(const Spherocylinder& a, const Spherocylinder& b, const Vec3& r_ab,
                double min_gap) noexcept {
  return decide_grown(a, b, r_ab, min_gap);
}

Decision decide(const Sphere& a, const Cylinder& b, const Vec3& r_ab, double min_gap) noexcept {
  const CylinderPlace p = place(b, -r_ab);
  const double distance = norm(p.outward);
  const Vec3 d = distance > 0.0 ? -p.outward / distance : b.axis;
  if (distance > a.radius + min_gap) {
    const bool proven = proven_gap_along(a, b, r_ab, d) > min_gap;
    return {proven ? Verdict::separated : Verdict::undecided, d};
  }
  if (min_gap > 0.0) {
    const bool near = distance + gap_roundoff(a, b, r_ab) <= a.radius + min_gap;
    return {near ? Verdict::overlapping : Verdict::undecided, d};
  }
  // The nearest point, drawn towards the center of the cylinder by half of what the sphere leaves.
  const double length = norm(p.nearest);
  const double draw = length > 0.0 ? std::fmin(0.5 * (a.radius - distance) / length, 1.0) : 0.0;
  const Vec3 common = (1.0 - draw) * p.nearest - p.center;
  if (in_both(a, b, r_ab, common)) return {Verdict::overlapping, common};
  return {Verdict::undecided, d};
}

Gap gap(const Sphere& a, const Sphere& b, const Vec3& r_ab) noexcept {
  return gap_grown(a, b, r_ab);
}

Gap gap(const Sphere& a, const Spherocylinder& b, const Vec3& r_ab) noexcept {
  return gap_grown(a, b, r_ab);
}

Gap gap(const Spherocylinder& a, const Spherocylinder& b, const Vec3& r_ab) noexcept {
  return gap_grown(a, b, r_ab);
}

Gap gap(const Sphere& a, const Cylinder& b, const Vec3& r_ab) noexcept {
  const CylinderPlace p = place(b, -r_ab);
  const double distance = norm(p.outward);
  const double to_end = b.half_length - std::abs(p.along), to_side = b.radius - p.rho;
  const double upper = distance > 0.0 ? distance : -std::fmin(to_end, to_side);
  BestDirection<Sphere, Cylinder> best(a, b, r_ab);
  best.offer(-p.outward);
  best.offer(p.along > 0.0 ? -b.axis : b.axis);
  best.offer(p.rho > 0.0 ? -p.across : any_perpendicular(b.axis));
  const Vec3& d = best.direction();
  return closed_gap(a, b, r_ab, upper - a.radius, d, a.radius * d);
}

ContactScale contact_scale(const Sphere& a, const Sphere& b, const Vec3& r_ab) noexcept {
  const double scale = norm(r_ab) / (a.radius + b.radius);
  return {scale * (1.0 - 8 * kUnitRoundoff), scale * (1.0 + 8 * kUnitRoundoff)};
}

double quick_gap_bound(const Sphere& a, const Sphere& b, const Vec3& r_ab) noexcept {
  return norm(r_ab) - (a.radius + b.radius) - gap_roundoff(a, b, r_ab);
}

double quick_gap_bound(const Sphere& a, const Spherocylinder& b, const Vec3& r_ab) noexcept {
  return quick_bound_grown(a, b, r_ab);
}

double quick_gap_bound(const Spherocylinder& a, const Spherocylinder& b,
                       const Vec3& r_ab) noexcept {
  return quick_bound_grown(a, b, r_ab);
}

double quick_gap_bound(const Sphere& a, const Cylinder& b, const Vec3& r_ab) noexcept {
  const Gap full = gap(a, b, r_ab);
  return full.value - gap_roundoff(a, b, r_ab);
}

}  // namespace packstone
