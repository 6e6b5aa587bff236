#include "generate/published_event_driven/audit.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/geometry/ellipsoid_contact.hpp"

namespace packstone::published {
namespace {

/// Colliding bodies touch to within rounding; this much smaller they are apart.
constexpr double kTouching = 1.0 - 1e-6;

double reach(const Ellipsoid& body) {
  return std::max({body.semi_axes.x, body.semi_axes.y, body.semi_axes.z});
}

Ellipsoid shrunk(const MovingEllipsoid& moving) {
  return {kTouching * moving.semi_axes, moving.orientation};
}

/// Bodies no longer than the cell meet in the nearest image along each axis or in the next one.
bool overlap_in_some_image(const Cell& cell, const Ellipsoid& a, const Ellipsoid& b,
                           const Vec3& r) {
  const double reach_sq = std::pow(reach(a) + reach(b), 2);
  const Vec3 nearest{std::remainder(r.x, cell.size.x), std::remainder(r.y, cell.size.y),
                     std::remainder(r.z, cell.size.z)};
  for (unsigned image = 0; image < 8; ++image) {
    Vec3 r_image = nearest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((image >> axis & 1U) != 0) r_image[axis] -= std::copysign(cell.size[axis], nearest[axis]);
    }
    if (norm_sq(r_image) >= reach_sq) continue;
    if (decide(a, b, r_image).verdict != Verdict::separated) return true;
  }
  return false;
}

}  // namespace

std::int64_t Audit::new_overlaps(const Cell& cell, const std::vector<MovingEllipsoid>& bodies) {
  std::int64_t count = 0;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const bool overlaps = overlap_in_some_image(cell, shrunk(bodies[a]), shrunk(bodies[b]),
                                                  bodies[b].center - bodies[a].center);
      if (overlaps) {
        count += overlapping_.insert({a, b}).second;
      } else {
        overlapping_.erase({a, b});
      }
    }
  }
  return count;
}

}  // namespace packstone::published
