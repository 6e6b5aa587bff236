#include "geometry/ball_contact.hpp"
#include "geometry/posed_ellipsoid.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"

namespace packstone {

Decision decide(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab, double min_gap) noexcept {
  return decide_ball(a.radius, PosedEllipsoid(b), r_ab, min_gap);
}

Gap gap(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return ball_gap(a.radius, PosedEllipsoid(b), r_ab);
}

ContactScale contact_scale(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return contact_scale(Ellipsoid{{a.radius, a.radius, a.radius}, b.orientation}, b, r_ab);
}

}  // namespace packstone
