#include "packstone/geometry/bounds.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/overloaded.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone {

double in_radius(const Body& body) noexcept {
  return std::visit(
      Overloaded{[](const Sphere& b) { return b.radius; },
                 [](const Ellipsoid& b) {
                   return std::min({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z});
                 },
                 [](const Cylinder& b) { return std::min(b.radius, b.half_length); },
                 [](const Spherocylinder& b) { return b.radius; },
                 [](const Disk& b) { return b.radius; },
                 [](const Ellipse& b) { return std::min(b.semi_axes.x, b.semi_axes.y); }},
      body);
}

double circum_radius(const Body& body) noexcept {
  return std::visit(
      Overloaded{[](const Sphere& b) { return b.radius; },
                 [](const Ellipsoid& b) {
                   return std::max({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z});
                 },
                 [](const Cylinder& b) { return std::hypot(b.radius, b.half_length); },
                 [](const Spherocylinder& b) { return b.radius + b.half_length; },
                 [](const Disk& b) { return b.radius; },
                 [](const Ellipse& b) { return std::max(b.semi_axes.x, b.semi_axes.y); }},
      body);
}

Vec3 half_extents(const Body& body) noexcept {
  const double slack = kSupportRoundoff * circum_radius(body);
  const double z = dimension(kind(body)) == 3 ? support(body, {0, 0, 1}) + slack : 0.0;
  return {support(body, {1, 0, 0}) + slack, support(body, {0, 1, 0}) + slack, z};
}

}  // namespace packstone
