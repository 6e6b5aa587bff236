#include "packstone/geometry/ellipsoid_contact.hpp"

#include "geometry/ellipsoid_pencil.hpp"
#include "geometry/perram_wertheim.hpp"
#include "geometry/posed_ellipsoid.hpp"

namespace packstone {

Decision decide(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab, double min_gap) noexcept {
  return decide_in_stages<EllipsoidPencil, PosedEllipsoid>(a, b, r_ab, min_gap,
                                                           [&] { return gap(a, b, r_ab); });
}

ContactScale contact_scale(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return scale_by_pencil<EllipsoidPencil>(PosedPair<PosedEllipsoid>(a, b, r_ab));
}

}  // namespace packstone
