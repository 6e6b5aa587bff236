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
  return decide_ball_in_stages<EllipsoidPencil, PosedEllipsoid>(
      a.radius, as_ellipsoid(a, b.orientation), b, r_ab, min_gap);
}

Gap gap(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return ball_gap(a.radius, PosedEllipsoid(b), r_ab);
}

ContactScale contact_scale(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return contact_scale(as_ellipsoid(a, b.orientation), b, r_ab);
}

}  // namespace packstone
