#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/foot_point.hpp"
#include "geometry/posed_ellipsoid.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"

namespace packstone {
namespace {

std::array<double, 3> to_array(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 to_vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The ball's center as seen by the ellipsoid: signed distance to the surface, with its error.
struct CenterDistance {
  double value;
  double error;
  Vec3 normal;  ///< Unit, outward, cell frame.
  Vec3 foot;    ///< On the surface, relative to the center of the ellipsoid, cell frame.
};

/// `y` is the ball's center minus the ellipsoid's.
CenterDistance center_distance(const PosedEllipsoid& b, const Vec3& y) {
  const FootPoint<3> foot = foot_point(to_array(b.axes), to_array(b.to_body(y)));
  CenterDistance result;
  result.normal = b.rotation * to_vec(foot.normal);
  result.foot = b.rotation * to_vec(foot.point);
  result.value = dot(result.normal, y) - b.support(result.normal);
  const double upper = foot.inside ? -foot.distance_bound : foot.distance_bound;
  result.error = std::max(0.0, upper - result.value) + 2 * kProofRoundoff * (norm(y) + b.largest);
  return result;
}

/// A point relative to the center of the ball that may lie in both: the ball's center, or else the
/// foot moved into the ellipsoid by half the overlap, as far as its least ball of curvature
/// reaches.
Vec3 shared_point(const PosedEllipsoid& b, const Vec3& y, const CenterDistance& found,
                  double radius) {
  if (found.value < 0.0) return {};
  const double curvature_radius = b.least * (b.least / b.largest);
  const double inward = std::min(0.5 * (radius - found.value), curvature_radius);
  return found.foot - inward * found.normal - y;
}

}  // namespace

Decision decide(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab, double min_gap) noexcept {
  const PosedEllipsoid pose(b);
  const double apart = norm(r_ab);
  const double slack = 2 * kProofRoundoff * (apart + a.radius + pose.largest);
  if (apart - a.radius - pose.largest - slack > min_gap) {
    return {Verdict::separated, r_ab / apart};
  }
  const CenterDistance found = center_distance(pose, -r_ab);
  const Vec3 d = -found.normal;
  if (found.value - a.radius - slack > min_gap) return {Verdict::separated, d};
  if (min_gap > 0.0) return decide_by_gap(gap(a, b, r_ab), min_gap);
  const Vec3 x = shared_point(pose, -r_ab, found, a.radius);
  const bool in_ball = norm(x) <= a.radius * (1.0 - kSupportRoundoff);
  if (in_ball && pose.contains(x - r_ab)) return {Verdict::overlapping, x};
  return {Verdict::undecided, d};
}

Gap gap(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  const CenterDistance found = center_distance(PosedEllipsoid(b), -r_ab);
  Gap gap;
  gap.value = found.value - a.radius;
  gap.error = found.error + 2 * kUnitRoundoff * a.radius;
  gap.normal = -found.normal;
  gap.point_a = a.radius * gap.normal;
  gap.point_b = r_ab + found.foot;
  return gap;
}

ContactScale contact_scale(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return contact_scale(Ellipsoid{{a.radius, a.radius, a.radius}, b.orientation}, b, r_ab);
}

}  // namespace packstone
