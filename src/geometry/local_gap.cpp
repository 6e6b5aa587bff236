#include "geometry/local_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/axis_segments.hpp"
#include "geometry/gap_ascent.hpp"
#include "geometry/touching_points.hpp"

namespace packstone {
namespace {

bool is_ball_or_capsule(const PosedBody& body) {
  return body.form == Form::ball || body.form == Form::spherocylinder;
}

Segment segment_of(const PosedBody& body) {
  return {is_ellipsoid(body.form) ? 0.0 : body.axial, body.pose.axis};
}

double gap_along(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& unit) {
  return dot(unit, r) - support(a, unit) - support(b, unit);
}

// Where axes meet any direction across both is as good as another; `hint` keeps to one.
Vec3 direction_between(const Vec3& between, double distance, double radii, const PosedBody& a,
                       const PosedBody& b, const Vec3& hint) {
  constexpr double kMeeting = 1e-9;
  if (distance > kMeeting * radii) return between / distance;
  Vec3 across = cross(a.pose.axis, b.pose.axis);
  const double length = norm(across);
  across = length > kMeeting ? across / length : any_perpendicular(a.pose.axis);
  return dot(across, hint) < 0.0 ? -across : across;
}

// Where bodies meet whose axes come nearest at `axes`, `distance` apart.
void set_contact(const NearestPoints& axes, double distance, const PosedBody& a, const PosedBody& b,
                 const Vec3& hint, LocalGap& found) {
  found.normal = direction_between(axes.between, distance, a.lateral + b.lateral, a, b, hint);
  found.point_a = axes.on_a + a.lateral * found.normal;
  found.point_b = axes.on_b - b.lateral * found.normal;
}

bool gap_of_capsules(const PosedBody& a, const PosedBody& b, const Vec3& r, double limit,
                     Vec3& hint, LocalGap& found) {
  NearestPoints axes{{}, {}, r};
  if (a.form != Form::ball || b.form != Form::ball) {
    axes = nearest_points(segment_of(a), segment_of(b), r);
  }
  const double distance = norm(axes.between);
  found.value = distance - (a.lateral + b.lateral);
  if (found.value >= limit) return false;
  set_contact(axes, distance, a, b, hint, found);
  hint = found.normal;
  return true;
}

// Rods whose axes come nearest within both: nothing next to the direction across the two has a
// larger gap. Whether that is so, and nothing better is known or to be looked for: an end that is
// nearer than they are deep may be.
bool sides_cross(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& hint,
                 LocalGap& found) {
  constexpr double kInside = 1e-12;
  if (is_ellipsoid(a.form) || is_ellipsoid(b.form)) return false;
  const NearestPoints axes = nearest_points(segment_of(a), segment_of(b), r);
  const double beyond = std::min(a.axial - std::abs(dot(axes.on_a, a.pose.axis)),
                                 b.axial - std::abs(dot(axes.on_b, b.pose.axis)));
  if (!(beyond > kInside * (a.axial + b.axial))) return false;
  const double distance = norm(axes.between);
  found.value = distance - (a.lateral + b.lateral);
  if (-found.value > beyond) return false;
  if (hint != Vec3{} && gap_along(a, b, r, hint) > found.value) return false;
  set_contact(axes, distance, a, b, hint, found);
  return true;
}

// Across the axis; in the plane, where the axis is.
Vec3 level_perpendicular(const Vec3& axis) {
  const Vec3 level{-axis.y, axis.x, 0.0};
  const double length = norm(level);
  return length > 0.1 ? level / length : any_perpendicular(axis);
}

// The best of a few directions, for a pair that is looked at for the first time.
class FirstLook {
 public:
  FirstLook(const PosedBody& a, const PosedBody& b, const Vec3& r) : a_(a), b_(b), r_(r) {
    look(norm_sq(r) > 0.0 ? r : level_perpendicular(a.pose.axis));
    const Segment of_a = segment_of(a), of_b = segment_of(b);
    look(nearest_points(of_a, of_b, r).between);
    look_along_sides();
    look_along_end(a);
    look_along_end(b);
  }

  [[nodiscard]] const Vec3& direction() const { return best_; }

 private:
  void look(const Vec3& direction) {
    const double length = norm(direction);
    if (!(length > 0.0)) return;
    const Vec3 unit = direction / length;
    const double gap = gap_along(a_, b_, r_, unit);
    if (!(gap > gap_)) return;
    gap_ = gap;
    best_ = unit;
  }
  static bool is_rod(const PosedBody& body) { return !is_ellipsoid(body.form); }

  void look_along_sides() {
    if (is_rod(a_) && is_rod(b_)) {
      const Vec3 across = a_.lateral * cross(a_.pose.axis, b_.pose.axis);
      look(across);
      look(-across);
    }
    if (is_rod(a_)) look(part_across(a_.pose.axis, r_));
    if (is_rod(b_)) look(part_across(b_.pose.axis, r_));
  }
  void look_along_end(const PosedBody& body) {
    if (body.form != Form::cylinder) return;
    look(std::copysign(body.lateral, dot(body.pose.axis, r_)) * body.pose.axis);
  }

  const PosedBody& a_;
  const PosedBody& b_;
  Vec3 r_;
  Vec3 best_;
  double gap_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

bool local_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, double limit, Vec3& hint,
               LocalGap& found) {
  constexpr double kAccuracy = 1e-7;
  constexpr int kMostClimbs = 4;
  if (is_ball_or_capsule(a) && is_ball_or_capsule(b)) {
    return gap_of_capsules(a, b, r, limit, hint, found);
  }
  if (sides_cross(a, b, r, hint, found)) {
    hint = found.normal;
    return found.value < limit;
  }
  if (hint == Vec3{}) hint = FirstLook(a, b, r).direction();
  found.value = gap_along(a, b, r, hint);
  if (found.value >= limit) return false;
  for (int climb = 0; climb < kMostClimbs; ++climb) {
    if (climb_gap(a, b, r, hint, kAccuracy)) break;
  }
  found.value = gap_along(a, b, r, hint);
  if (found.value >= limit) return false;
  found.normal = hint;
  const TouchingPoints points = touching_points(a, b, r, hint, {});
  found.point_a = points.of_a;
  found.point_b = points.of_b;
  return true;
}

}  // namespace packstone
