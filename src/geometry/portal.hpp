#pragma once

/// @file
/// Where does the ray from the center of M through r leave M? (M: minkowski_sum.hpp.)
///
/// A portal is a simplex of three points of M (two in the plane) that the ray passes through. With
/// n its outward normal and t r the point where the ray crosses its plane, t r lies in M, and M
/// lies below its support plane with normal n:
///
///     n.r / S_M(n)  <=  mu  <=  1 / t = n.r / n.v                                          (1)
///
/// Each step adds the support point of n and keeps the part of the portal that the ray meets, so
/// the bracket closes. Since the center of M lies deep inside M, no simplex degenerates when the
/// bodies come to touch, unlike the tetrahedra of GJK.
///
/// Reference: G. Snethen, "XenoCollide: complex collision made simple", Game Programming Gems 7
/// (2008) 165-178. Ours differs in bracketing (1) and in using that M is symmetric.

#include <algorithm>
#include <cmath>

#include "geometry/minkowski_sum.hpp"

namespace packstone {

/// A portal with its bracket.
struct Portal {
  SumPoint corner[3];
  int count = 3;       ///< Corners in use: 3, in the plane 2, 1 when the ray hits a corner.
  Vec3 normal;         ///< Outward, not unit.
  double along = 0.0;  ///< normal.r > 0.
  double inner = 0.0;  ///< normal.v of the portal's plane.
  double outer = 0.0;  ///< S_M(normal).
};

inline constexpr int kPortalSteps = 200;

namespace detail {

/// One step's worth of bracket. `outer` is the support along `normal`, whose point is returned.
template <class Sum>
SumPoint close_bracket(const Sum& sum, const Vec3& r, const Vec3& normal, Portal& portal) {
  const SumPoint tip = sum.support(normal);
  portal.normal = normal;
  portal.along = dot(normal, r);
  portal.inner = dot(normal, portal.corner[0].sum);
  portal.outer = dot(normal, tip.sum);
  return tip;
}

/// Numbers the corners so that the two shorter edges of the portal meet in the first. Their cross
/// product is the accurate one when the portal is a sliver.
struct BaseCorner {
  int base, next, last;  // in the order of the portal's turn
};
inline BaseCorner base_corner(const Portal& portal) {
  const auto& [a, b, c] = portal.corner;
  const double ab = norm_sq(b.sum - a.sum), bc = norm_sq(c.sum - b.sum);
  const double ca = norm_sq(a.sum - c.sum);
  if (bc >= ab && bc >= ca) return {0, 1, 2};
  return ca >= ab ? BaseCorner{1, 2, 0} : BaseCorner{2, 0, 1};
}
inline Vec3 normal_of(const Portal& portal) {
  const auto& [a, b, c] = portal.corner;
  const Vec3 ab = b.sum - a.sum, ac = c.sum - a.sum;
  const Vec3 n = cross(ab, ac);
  // Any corner will do, unless the portal is a sliver.
  constexpr double kSliver = 1e-2;
  if (norm_sq(n) > kSliver * norm_sq(ab) * norm_sq(ac)) return n;
  const BaseCorner i = base_corner(portal);
  const Vec3& base = portal.corner[i.base].sum;
  return cross(portal.corner[i.next].sum - base, portal.corner[i.last].sum - base);
}

inline double det(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(cross(a, b), c); }

/// Keeps of the portal with the new corner `tip` the part that the ray along r meets.
inline void split(Portal& portal, const SumPoint& tip, const Vec3& r) {
  auto& [a, b, c] = portal.corner;
  const Vec3 side = cross(r, tip.sum);
  const double at_a = dot(side, a.sum), at_b = dot(side, b.sum), at_c = dot(side, c.sum);
  // Which corner goes cannot be foreseen: no branches, by whose failure a step would take twice as
  // long.
  const int without_b = (at_c >= 0.0) & (at_a <= 0.0);
  const int without_c = (at_a >= 0.0) & (at_b <= 0.0);
  portal.corner[without_c ? 2 : without_b] = tip;
}

/// The first bracket, from the direction of r with one corner only. True: the search ends there, as
/// `visit` says or because the ray hits the corner. `across`: from the corner, around to the ray.
template <class Sum, class Visit>
bool ends_at_first_corner(const Sum& sum, const Vec3& r, Portal& portal, Visit& visit,
                          Vec3& across) {
  portal.count = 1;
  portal.corner[0] = sum.support(r);
  portal.normal = r;
  portal.along = norm_sq(r);
  portal.outer = dot(portal.corner[0].sum, r);
  if (visit(portal)) return true;
  across = cross(portal.corner[0].sum, r);
  if (norm_sq(across) > 1e-30 * norm_sq(portal.corner[0].sum) * norm_sq(r)) return false;
  portal.inner = portal.outer;
  visit(portal);
  return true;
}

}  // namespace detail

/// Searches in space. `visit(portal)` sees each bracket and returns true to end the search.
template <class Sum, class Visit>
void search_portal(const Sum& sum, const Vec3& r, Visit&& visit) {
  Portal portal;
  auto& [a, b, c] = portal.corner;
  Vec3 across;
  if (detail::ends_at_first_corner(sum, r, portal, visit, across)) return;
  b = a;
  a = sum.support(across);
  portal.count = 3;
  int step = 0;
  for (;; ++step) {
    if (step == kPortalSteps) return;
    c = sum.support(cross(a.sum, b.sum));
    if (detail::det(b.sum, c.sum, r) < 0.0) {
      a = c;
    } else if (detail::det(c.sum, a.sum, r) < 0.0) {
      b = c;
    } else {
      break;
    }
  }
  for (; step < kPortalSteps; ++step) {
    const Vec3 normal = detail::normal_of(portal);
    const SumPoint tip = detail::close_bracket(sum, r, normal, portal);
    if (visit(portal)) return;
    if (!(portal.outer > portal.inner)) return;
    detail::split(portal, tip, r);
  }
}

/// The same in the plane.
template <class Sum, class Visit>
void search_portal_2d(const Sum& sum, const Vec3& r, Visit&& visit) {
  Portal portal;
  auto& [a, b, c] = portal.corner;
  Vec3 across;
  if (detail::ends_at_first_corner(sum, r, portal, visit, across)) return;
  const double sign = across.z > 0.0 ? 1.0 : -1.0;  // of the turn from a to r
  const auto left = [sign](const Vec3& v) { return Vec3{-sign * v.y, sign * v.x, 0.0}; };
  portal.count = 2;
  int step = 0;
  for (;; ++step) {
    if (step == kPortalSteps) return;
    b = sum.support(left(a.sum));
    if (sign * cross(b.sum, r).z <= 0.0) break;
    a = b;
  }
  for (; step < kPortalSteps; ++step) {
    const SumPoint tip = detail::close_bracket(sum, r, left(a.sum - b.sum), portal);
    if (visit(portal)) return;
    if (!(portal.outer > portal.inner)) return;
    (sign * cross(tip.sum, r).z <= 0.0 ? b : a) = tip;
  }
}

/// Weights of the corners at the point where the ray crosses the portal's plane; they sum to 1.
struct Weights {
  double of[3] = {1.0, 0.0, 0.0};
};
inline Weights crossing_weights(const Portal& portal, const Vec3& r) {
  Weights weights;
  if (portal.count == 1) return weights;
  // Coordinates of the crossing along the edges from the base corner, where slivers lose nothing.
  const Vec3 crossing = (portal.inner / portal.along) * r;
  if (portal.count == 2) {
    const Vec3& base = portal.corner[0].sum;
    const Vec3 edge = portal.corner[1].sum - base;
    const double t = std::clamp(dot(crossing - base, edge) / norm_sq(edge), 0.0, 1.0);
    return {{1.0 - t, t, 0.0}};
  }
  const detail::BaseCorner i = detail::base_corner(portal);
  const Vec3& base = portal.corner[i.base].sum;
  const Vec3 next = portal.corner[i.next].sum - base, last = portal.corner[i.last].sum - base;
  const Vec3 n = cross(next, last), y = crossing - base;
  const double n_sq = norm_sq(n);
  const double to_next = std::clamp(dot(cross(y, last), n) / n_sq, 0.0, 1.0);
  const double to_last = std::clamp(dot(cross(next, y), n) / n_sq, 0.0, 1.0 - to_next);
  weights.of[i.base] = 1.0 - to_next - to_last;
  weights.of[i.next] = to_next;
  weights.of[i.last] = to_last;
  return weights;
}

}  // namespace packstone
