#pragma once

/// @file
/// The general pair kernels: any two convex bodies of one dimension.

#include <type_traits>

#include "geometry/axis_segments.hpp"
#include "geometry/chord_search.hpp"
#include "geometry/expanding_polygon.hpp"
#include "geometry/expanding_polytope.hpp"
#include "geometry/gjk.hpp"
#include "geometry/portal.hpp"
#include "geometry/proof.hpp"

namespace packstone::convex {

template <class A>
inline constexpr bool kPlanar = std::is_same_v<A, Disk> || std::is_same_v<A, Ellipse>;

template <class A, class Sum, class Visit>
void search(const Sum& sum, const Vec3& r, Visit&& visit) {
  if constexpr (kPlanar<A>) {
    search_portal_2d(sum, r, visit);
  } else {
    search_portal(sum, r, visit);
  }
}

/// Points of a and of b in the portal where the ray to r crosses it, scaled back to r.
struct CommonPoint {
  Vec3 in_a;  // relative to the center of a
  Vec3 in_b;  // relative to the center of b
};
inline CommonPoint common_point(const Portal& portal, const Vec3& r) {
  const Weights weights = crossing_weights(portal, r);
  CommonPoint x;
  Vec3 sum;
  for (int i = 0; i < portal.count; ++i) {
    x.in_a += weights.of[i] * portal.corner[i].in_a;
    x.in_b -= weights.of[i] * portal.corner[i].in_b;
    sum += weights.of[i] * portal.corner[i].sum;
  }
  const double shrink = norm_sq(r) / dot(sum, r);
  // Rounding leaves the two points a little apart: meet in the middle.
  const Vec3 miss = 0.5 * (r - shrink * sum);
  return {shrink * x.in_a + miss, shrink * x.in_b - miss};
}

/// Are the points a proof that the gap is at most min_gap? Moves them towards each other where that
/// makes room for rounding.
template <class A, class B>
bool proves_overlap(const A& a, const B& b, const Vec3& r, double min_gap, CommonPoint& x) {
  if (min_gap == 0.0) return in_both(a, b, r, x.in_a);
  const double slack = 8 * kUnitRoundoff * (norm(r) + reach(a) + reach(b));
  const Vec3 between = r + x.in_b - x.in_a;
  const double distance = norm(between);
  if (distance + slack > min_gap) {
    const double pull = std::fmin(0.5 * (distance + 2 * slack - min_gap), 0.5 * distance);
    if (!(pull <= 2 * slack) || distance == 0.0) return false;
    x.in_a += (pull / distance) * between;
    x.in_b -= (pull / distance) * between;
  }
  return contains(a, x.in_a) && contains(b, x.in_b) && norm(r + x.in_b - x.in_a) + slack <= min_gap;
}

/// decide() of contact.hpp.
template <class A, class B>
Decision decide(const A& a, const B& b, const Vec3& r, double min_gap) noexcept {
  if (norm_sq(r) == 0.0) return {Verdict::overlapping, Vec3{}};
  const MinkowskiSum<A, B> sum(a, b, min_gap);
  Decision decision;
  search<A>(sum, r, [&](const Portal& portal) {
    decision.witness = portal.normal;
    if (portal.along > portal.outer) {
      const Vec3 d = normalized(portal.normal);
      if (!(proven_gap_along(a, b, r, d) > min_gap)) return false;
      decision = {Verdict::separated, d};
      return true;
    }
    if (!(portal.inner > portal.along)) return false;
    CommonPoint x = common_point(portal, r);
    if (!proves_overlap(a, b, r, min_gap, x)) return false;
    decision.verdict = Verdict::overlapping;
    if (min_gap == 0.0) decision.witness = x.in_a;
    return true;
  });
  const bool is_point = decision.verdict == Verdict::overlapping && min_gap == 0.0;
  if (!is_point) decision.witness = normalized(decision.witness);
  return decision;
}

/// contact_scale() of contact.hpp. Below: equation (1) of portal.hpp with the rounding of n.r and
/// S. Above: with p the point of the portal where the ray crosses it, r = l p + m lies in l M grown
/// by |m|, and M holds a ball of radius e, so that mu <= l + |m| / e. The bound holds for any point
/// of the portal, and so does not ask whether rounding has left the ray inside.
template <class A, class B>
ContactScale contact_scale(const A& a, const B& b, const Vec3& r) noexcept {
  const double r_sq = norm_sq(r);
  if (r_sq == 0.0) return {0.0, 0.0};
  const MinkowskiSum<A, B> sum(a, b);
  const double support_slack = (kSupportRoundoff + 4 * kUnitRoundoff) * (reach(a) + reach(b));
  const double product_slack = 4 * kUnitRoundoff * std::sqrt(r_sq);
  const double ball = least_reach(a) + least_reach(b);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  ContactScale scale{0.0, kNone};
  search<A>(sum, r, [&](const Portal& portal) {
    const double length = norm(portal.normal);
    scale.lower = std::fmax(scale.lower, (portal.along - length * product_slack) /
                                             (portal.outer + length * support_slack));
    // A wide bracket is not worth the point, but for the first one.
    const double width = portal.outer - portal.inner;
    if (width > 1e-9 * portal.outer && scale.upper < kNone) return false;
    const Weights weights = crossing_weights(portal, r);
    Vec3 p;
    for (int i = 0; i < portal.count; ++i) p += weights.of[i] * portal.corner[i].sum;
    const double along = dot(p, r);
    if (along > 0.0) {
      const double l = r_sq / along;
      const double off = norm(r - l * p) + l * support_slack + product_slack;
      scale.upper = std::fmin(scale.upper, l + off / ball);
    }
    return width <= 1e-14 * portal.outer;
  });
  return scale;
}

/// The axis of revolution of a core; (0, 0, 0): none, or any.
inline Vec3 revolution_axis(const Cylinder& core) { return core.axis; }
inline Vec3 revolution_axis(const SegmentCore& core) { return core.axis; }
inline Vec3 revolution_axis(PointCore) { return {}; }
inline Vec3 revolution_axis(const Ellipsoid& core) {
  const Vec3& s = core.semi_axes;
  const Mat3 frame = to_matrix(core.orientation);
  if (s.x == s.y) return frame.col_z;
  if (s.y == s.z) return frame.col_x;
  return s.x == s.z ? frame.col_y : Vec3{};
}

/// Angle of axes below which two bodies of revolution are treated as nearly parallel [rad].
inline constexpr double kNearlyParallel = 1e-2;

/// Brackets the depth of r in the sum of two cores in space, both grown by `inflation` together.
/// Where both are bodies of revolution about axes that are parallel but for an angle, turning b to
/// the axis of a moves its points by no more than reach_b times the angle, and the problem is one
/// of the plane of axis and r.
template <class Sum, class CoreA, class CoreB>
Depth search_depth_of_cores(const Sum& sum, const CoreA& a, const CoreB& b, const Vec3& r,
                            double reach_b, double tolerance) {
  const Vec3 axis = revolution_axis(a), axis_b = revolution_axis(b);
  const double angle = 1.01 * norm(cross(axis, axis_b)) + 8 * kUnitRoundoff;
  const bool parallel = norm_sq(axis) > 0.0 && norm_sq(axis_b) > 0.0 && angle < kNearlyParallel;
  if (!parallel) return search_depth(sum, r, tolerance);
  Depth depth;
  if (angle > 1e-13) {
    depth = search_depth(sum, r, tolerance);
    if (depth.outer - depth.inner <= tolerance || depth.outer <= 0.0) return depth;
  }
  Vec3 out = r - dot(axis, r) * axis;
  out -= dot(axis, out) * axis;
  const double rho = norm(out);
  const PlaneFrame frame{
      axis, rho > kUnitRoundoff * norm(r) ? out / rho : any_perpendicular(normalized(axis))};
  const Depth flat = search_depth_in_plane(sum, r, frame, tolerance);
  const double inner = std::fmax(depth.inner, flat.inner - 2 * angle * reach_b);
  if (flat.outer < depth.outer) depth = flat;
  depth.inner = inner;
  return depth;
}

template <class A, class B>
Depth search_depth_of_bodies(const A& a, const B& b, const Vec3& r, double inflation,
                             double tolerance) {
  using Sum = MinkowskiSum<std::decay_t<decltype(core(a))>, std::decay_t<decltype(core(b))>>;
  const Sum sum(core(a), core(b), inflation);
  if constexpr (kPlanar<A>) {
    return search_depth_in_plane(sum, r, {{1, 0, 0}, {0, 1, 0}}, tolerance);
  } else {
    return search_depth_of_cores(sum, core(a), core(b), r, reach(b), tolerance);
  }
}

/// Bounds on the gap of the cores with the direction and the point that belong to the lower one.
struct CoreGap {
  double lower = -std::numeric_limits<double>::infinity();  // attained by `normal`
  double upper = std::numeric_limits<double>::infinity();
  Vec3 normal;
  Vec3 in_a;

  // Takes the direction of `depth` unless it is worse by more than `tolerance`.
  void add(const Depth& depth, double inflation, double tolerance) {
    if (depth.inner > 0.0) upper = std::fmin(upper, inflation - depth.inner);
    if (inflation == 0.0) upper = std::fmin(upper, depth.miss);
    if (inflation - depth.outer < lower - tolerance) return;
    lower = inflation - depth.outer;
    normal = depth.normal;
    in_a = depth.in_a;
  }
};

template <class Core>
inline constexpr bool kHasChords =
    std::is_same_v<Core, Ellipsoid> || std::is_same_v<Core, Cylinder> ||
    std::is_same_v<Core, SegmentCore>;

/// The best of the directions it is shown, for ChordSearch.
template <class A, class B>
class BestDirection {
 public:
  BestDirection(const SupportChords<A>& a, const SupportChords<B>& b, const Vec3& r)
      : a_(a), b_(b), r_(r) {}

  double g() const { return g_; }
  const Vec3& direction() const { return direction_; }
  void look(const Vec3& d) {
    if (!(norm_sq(d) > 0.0)) return;
    const Vec3 unit = normalized(d);
    const double g = dot(unit, r_) - a_.support(unit) - b_.support(unit);
    if (g > g_) g_ = g, direction_ = unit;
  }
  bool covers(const Vec3&, double) const { return false; }

 private:
  const SupportChords<A>& a_;
  const SupportChords<B>& b_;
  Vec3 r_;
  double g_ = -std::numeric_limits<double>::infinity();
  Vec3 direction_;
};

/// Two rods: the directions in which the nearly parallel ones leave each other.
template <class A, class B>
void look_along_rods(const A& a, const B& b, const Vec3& r, BestDirection<A, B>& best) {
  const Vec3 u = a.axis, v = dot(a.axis, b.axis) < 0.0 ? -b.axis : b.axis;
  const Vec3 between = nearest_points({a.half_length, a.axis}, {b.half_length, b.axis}, r).between;
  // The difference is exact where the axes are nearly parallel.
  const Vec3 normal = cross(u, v - u);
  for (const Vec3& d : {between, part_across(u, between), part_across(v, between), normal, u, v}) {
    best.look(d);
    best.look(-d);
  }
}

/// Where the polytope cannot end, since a curve of directions all but ties.
template <class A, class B>
void close_by_chords(const A& a, const B& b, const Vec3& r, double tolerance, CoreGap& gap) {
  const SupportChords<A> chords_a(a);
  const SupportChords<B> chords_b(b);
  BestDirection<A, B> best(chords_a, chords_b, r);
  best.look(gap.normal);
  ChordSearch<A, B> search(chords_a, chords_b, r);
  if constexpr (!std::is_same_v<A, Ellipsoid>) {
    look_along_rods(a, b, r, best);
    if (norm(cross(a.axis, b.axis)) < kNearlyParallel) {
      search.set_parallel_sides({chords_a, chords_b, r});
    }
  }
  gap.upper = std::fmin(gap.upper, search.upper_bound(best, tolerance));
  if (!(best.g() > gap.lower)) return;
  gap.lower = best.g();
  gap.normal = best.direction();
  gap.in_a = SupportMap<A>(a).point(gap.normal);
}

/// GJK while the cores are apart, their depth when they are not; where neither closes the bracket,
/// the depth of the cores grown by a ball, which has no thin and no flat places; and then chords.
template <class A, class B>
CoreGap search_core_gap(const A& a, const B& b, const Vec3& r, double tolerance) {
  using Sum = MinkowskiSum<std::decay_t<decltype(core(a))>, std::decay_t<decltype(core(b))>>;
  const Sum sum(core(a), core(b));
  const Vec3 start = norm_sq(r) > 0.0 ? r : Vec3{1, 0, 0};
  const Distance apart = search_distance(sum, r, start, tolerance, kPlanar<A>);
  CoreGap gap{apart.lower, apart.upper, apart.direction, apart.in_a};
  if (gap.upper - gap.lower <= tolerance) return gap;
  if (apart.inside || gap.lower <= 0.0) {
    gap.add(search_depth_of_bodies(a, b, r, 0.0, tolerance), 0.0, tolerance);
    if (gap.upper - gap.lower <= tolerance) return gap;
  }
  const double inflation = std::fmax(1.5 * gap.lower, 0.0) + 0.05 * sum.circum_radius();
  gap.add(search_depth_of_bodies(a, b, r, inflation, tolerance), inflation, tolerance);
  using CoreA = std::decay_t<decltype(core(a))>;
  using CoreB = std::decay_t<decltype(core(b))>;
  if constexpr (kHasChords<CoreA> && kHasChords<CoreB>) {
    if (gap.upper - gap.lower > tolerance) close_by_chords(core(a), core(b), r, tolerance, gap);
  }
  return gap;
}

/// gap() of contact.hpp. One of the bodies must have a core with interior: for two of point and
/// segment there are closed forms.
template <class A, class B>
Gap gap(const A& a, const B& b, const Vec3& r) noexcept {
  const double tolerance = 0.1 * kGapRoundoff * std::fmax(reach(a), reach(b));
  const CoreGap cores = search_core_gap(a, b, r, tolerance);
  Gap result;
  result.normal = cores.normal;
  result.value = gap_along(a, b, r, cores.normal);
  const double upper = cores.upper - (margin(a) + margin(b));
  result.error = std::fmax(upper - result.value, 0.0) + 2 * gap_roundoff(a, b, r);
  result.point_a = cores.in_a + margin(a) * result.normal;
  result.point_b = result.point_a + result.value * result.normal;
  return result;
}

/// quick_gap_bound() of contact.hpp: along the line of centers.
template <class A, class B>
double quick_gap_bound(const A& a, const B& b, const Vec3& r) noexcept {
  const double distance = norm(r);
  const Vec3 d = distance > 0.0 ? r / distance : Vec3{1, 0, 0};
  return proven_gap_along(a, b, r, d);
}

}  // namespace packstone::convex
