#pragma once

/// @file
/// Contact of a ball with a posed ellipsoid, and of a disk with a posed ellipse.

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/foot_point.hpp"
#include "geometry/perram_wertheim.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

inline std::array<double, 3> to_array(const Vec3& v) { return {v.x, v.y, v.z}; }
inline std::array<double, 2> to_array(const Vec2& v) { return {v.x, v.y}; }
inline Vec3 to_vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
inline Vec2 to_vec(const std::array<double, 2>& v) { return {v[0], v[1]}; }

/// The ball's center as seen by the posed body: signed distance to its surface, with the error.
struct CenterDistance {
  double value = 0.0;
  double error = 0.0;
  Vec3 normal;  ///< Unit, outward.
  Vec3 foot;    ///< On the surface, relative to the center of the posed body.
};

/// `y` is the ball's center minus the center of `b`.
template <class Posed>
CenterDistance center_distance(const Posed& b, const Vec3& y) {
  const auto foot = foot_point(to_array(b.axes), to_array(b.to_body(y)));
  CenterDistance result;
  result.normal = normalized(b.to_cell(to_vec(foot.normal)));
  result.foot = b.to_cell(to_vec(foot.point));
  result.value = dot(result.normal, y) - b.support(result.normal);
  const double upper = foot.inside ? -foot.distance_bound : foot.distance_bound;
  result.error = std::max(0.0, upper - result.value) + 2 * kProofRoundoff * (norm(y) + b.largest);
  return result;
}

/// A point relative to the ball's center that may lie in both: that center, or else the foot moved
/// inward by half the overlap, as far as the ball of least curvature reaches.
template <class Posed>
Vec3 shared_point(const Posed& b, const Vec3& y, const CenterDistance& found, double radius) {
  if (found.value < 0.0) return {};
  const double curvature_radius = b.least * (b.least / b.largest);
  const double inward = std::min(0.5 * (radius - found.value), curvature_radius);
  return found.foot - inward * found.normal - y;
}

inline Gap ball_gap(double radius, const CenterDistance& found, const Vec3& r) {
  const Vec3 normal = -found.normal;
  return {found.value - radius, found.error + 2 * kUnitRoundoff * radius, normal, radius * normal,
          r + found.foot};
}

/// r points from the ball to the posed body.
template <class Posed>
Gap ball_gap(double radius, const Posed& b, const Vec3& r) {
  return ball_gap(radius, center_distance(b, -r), r);
}

template <class Posed>
Decision decide_ball(double radius, const Posed& b, const Vec3& r, double min_gap) {
  const double apart = norm(r);
  const double slack = 2 * kProofRoundoff * (apart + radius + b.largest);
  if (apart - radius - b.largest - slack > min_gap) return {Verdict::separated, r / apart};
  const CenterDistance found = center_distance(b, -r);
  if (found.value - radius - slack > min_gap) return {Verdict::separated, -found.normal};
  if (min_gap > 0.0) return decide_by_gap(ball_gap(radius, found, r), min_gap);
  const Vec3 x = shared_point(b, -r, found, radius);
  const bool in_ball = norm(x) <= radius * (1.0 - kSupportRoundoff);
  if (in_ball && b.contains(x - r)) return {Verdict::overlapping, x};
  return {Verdict::undecided, -found.normal};
}

/// All stages, the cheap ones first. `ball` is the ball as a body of the kind of b, turned like b.
template <class Pencil, class Posed, class Body>
Decision decide_ball_in_stages(double radius, const Body& ball, const Body& b, const Vec3& r,
                               double min_gap) {
  const auto [least, largest] = extreme_semi_axes(b);
  const Decision quick = decide_by_balls(radius, radius, least, largest, r, min_gap);
  if (quick.verdict != Verdict::undecided) return quick;
  PosedPair<Posed> pair(ball, b, r);
  // The ball's support is computed another way here than in support().
  pair.roundoff *= 2;
  const Decision decision = decide_by_pencil<Pencil>(pair, min_gap);
  if (decision.verdict != Verdict::undecided) return decision;
  return decide_ball(radius, pair.b, r, min_gap);
}

}  // namespace packstone
