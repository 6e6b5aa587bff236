#include "packstone/geometry/box_contact.hpp"

#include "geometry/convex_contact.hpp"
#include "geometry/posed_box.hpp"

namespace packstone {
namespace {

// The axis across which a box about the body and the box are apart, if there is one.
template <class Shape>
std::optional<Vec3> separating_axis(const Shape& body, const Box& box, const Vec3& r,
                                    double min_gap) {
  for (std::size_t axis = 0; axis < (convex::kPlanar<Shape> ? 2U : 3U); ++axis) {
    Vec3 d;
    d[axis] = std::copysign(1.0, r[axis]);
    if (proven_gap_along(body, box, r, d) > min_gap) return d;
  }
  return std::nullopt;
}

template <class Shape>
std::optional<Vec3> search_direction(const Shape& body, const Box& box, const Vec3& r,
                                     double min_gap) {
  std::optional<Vec3> found = separating_axis(body, box, r, min_gap);
  if (found || norm_sq(r) == 0.0) return found;
  convex::search<Shape>(MinkowskiSum<Shape, Box>(body, box), r, [&](const Portal& portal) {
    // Once r lies below a plane of points of the sum, no direction can part the two.
    if (!(portal.along > portal.outer)) return portal.inner > portal.along;
    const Vec3 d = normalized(portal.normal);
    if (proven_gap_along(body, box, r, d) > min_gap) found = d;
    return found.has_value();
  });
  return found;
}

}  // namespace

std::optional<Vec3> separating_direction(const Body& body, const Vec3& half_edges, const Vec3& r,
                                         double min_gap) noexcept {
  return std::visit(
      [&](const auto& shape) { return search_direction(shape, Box{half_edges}, r, min_gap); },
      body);
}

}  // namespace packstone
