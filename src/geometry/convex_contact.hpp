#pragma once

/// @file
/// The general pair kernels: any two convex bodies of one dimension.

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

/// Is the portal a proof that the gap is at most min_gap?
template <class A, class B>
bool proves_overlap(const A& a, const B& b, const Vec3& r, double min_gap, const CommonPoint& x) {
  if (min_gap == 0.0) return in_both(a, b, r, x.in_a);
  const double slack = 8 * kUnitRoundoff * (norm(r) + reach(a) + reach(b));
  return contains(a, x.in_a) && contains(b, x.in_b) && norm(r + x.in_b - x.in_a) + slack <= min_gap;
}

/// decide() of contact.hpp.
template <class A, class B>
Decision decide(const A& a, const B& b, const Vec3& r, double min_gap) noexcept {
  if (norm_sq(r) == 0.0) return {Verdict::overlapping, Vec3{}};
  const MinkowskiSum<A, B> sum(a, b, min_gap);
  Decision decision;
  double best = -std::numeric_limits<double>::infinity();
  search<A>(sum, r, [&](const Portal& portal) {
    const double length = norm(portal.normal);
    const double gap = (portal.along - portal.outer) / length;
    if (gap > best) best = gap, decision.witness = portal.normal / length;
    if (gap > 0.0) {
      if (proven_gap_along(a, b, r, decision.witness) > min_gap) {
        decision.verdict = Verdict::separated;
        return true;
      }
    } else if (portal.inner > portal.along) {
      const CommonPoint x = common_point(portal, r);
      if (proves_overlap(a, b, r, min_gap, x)) {
        decision.verdict = Verdict::overlapping;
        if (min_gap == 0.0) decision.witness = x.in_a;
        return true;
      }
    }
    return false;
  });
  return decision;
}

/// contact_scale() of contact.hpp.
template <class A, class B>
ContactScale contact_scale(const A& a, const B& b, const Vec3& r) noexcept {
  if (norm_sq(r) == 0.0) return {0.0, 0.0};
  const MinkowskiSum<A, B> sum(a, b);
  ContactScale scale{0.0, std::numeric_limits<double>::infinity()};
  search<A>(sum, r, [&](const Portal& portal) {
    scale.lower = std::fmax(scale.lower, portal.along / portal.outer);
    if (portal.inner > 0.0) scale.upper = std::fmin(scale.upper, portal.along / portal.inner);
    return scale.upper - scale.lower <= 1e-13 * scale.lower;
  });
  const double slack = 16 * kProofRoundoff;
  return {scale.lower * (1.0 - slack), scale.upper * (1.0 + slack)};
}

/// gap() of contact.hpp. For bodies that overlap the depth is bracketed by 0 and the least depth
/// along the directions tried.
template <class A, class B>
Gap gap(const A& a, const B& b, const Vec3& r) noexcept {
  const double size = norm(r) + reach(a) + reach(b);
  const MinkowskiSum<A, B> sum(a, b);
  const Vec3 start = norm_sq(r) > 0.0 ? r : Vec3{1, 0, 0};
  const Distance found = search_distance(sum, r, start, 1e-14 * size);
  Gap result;
  result.normal = found.direction;
  const SumPoint tip = sum.support(result.normal);
  if (found.inside || found.lower <= 0.0) {
    result.value = gap_along(a, b, r, result.normal);
    result.error = std::abs(result.value) + gap_roundoff(a, b, r);
    result.point_a = tip.in_a;
    result.point_b = tip.in_a + result.value * result.normal;
    return result;
  }
  result.value = gap_along(a, b, r, result.normal);
  result.error = std::fmax(found.upper - result.value, 0.0) + 2 * gap_roundoff(a, b, r);
  result.point_a = found.in_a;
  result.point_b = found.in_a + result.value * result.normal;
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
