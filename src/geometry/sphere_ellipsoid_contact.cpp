#include <algorithm>

#include "geometry/ball_contact.hpp"
#include "geometry/ellipsoid_pencil.hpp"
#include "geometry/posed_ellipsoid.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"

namespace packstone {
namespace {

Ellipsoid as_ellipsoid(const Sphere& ball, const Quaternion& orientation) {
  return {{ball.radius, ball.radius, ball.radius}, orientation};
}

}  // namespace

Decision decide(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab, double min_gap) noexcept {
  const auto [least, largest] = std::minmax({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z});
  const Decision quick = decide_by_balls(a.radius, a.radius, least, largest, r_ab, min_gap);
  if (quick.verdict != Verdict::undecided) return quick;
  PosedPair<PosedEllipsoid> pair(as_ellipsoid(a, b.orientation), b, r_ab);
  // The ball's support is computed another way here than in support().
  pair.roundoff *= 2;
  const Decision decision = decide_by_pencil<EllipsoidPencil>(pair, min_gap);
  if (decision.verdict != Verdict::undecided) return decision;
  return decide_ball(a.radius, pair.b, r_ab, min_gap);
}

Gap gap(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return ball_gap(a.radius, PosedEllipsoid(b), r_ab);
}

ContactScale contact_scale(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return contact_scale(as_ellipsoid(a, b.orientation), b, r_ab);
}

}  // namespace packstone
