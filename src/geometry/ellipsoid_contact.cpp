#include "packstone/geometry/ellipsoid_contact.hpp"

#include <algorithm>

#include "geometry/ellipsoid_pencil.hpp"
#include "geometry/perram_wertheim.hpp"
#include "geometry/posed_ellipsoid.hpp"

namespace packstone {

Decision decide(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab, double min_gap) noexcept {
  const auto [least_a, largest_a] = std::minmax({a.semi_axes.x, a.semi_axes.y, a.semi_axes.z});
  const auto [least_b, largest_b] = std::minmax({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z});
  const Decision quick = decide_by_balls(least_a, largest_a, least_b, largest_b, r_ab, min_gap);
  if (quick.verdict != Verdict::undecided) return quick;
  const PosedPair<PosedEllipsoid> pair(a, b, r_ab);
  const Decision decision = decide_by_pencil<EllipsoidPencil>(pair, min_gap);
  if (decision.verdict != Verdict::undecided) return decision;
  return decide_closely(pair, gap(a, b, r_ab), min_gap);
}

ContactScale contact_scale(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return scale_by_pencil<EllipsoidPencil>(PosedPair<PosedEllipsoid>(a, b, r_ab));
}

}  // namespace packstone
