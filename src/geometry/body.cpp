#include "packstone/geometry/body.hpp"

#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/core/tolerances.hpp"

namespace packstone {
namespace {

void check_length(const char* field, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidArgument(std::string(field) + " = " + number_text(value, 17) +
                        ", allowed are finite numbers > 0");
}

void check_finite(const char* field, double value) {
  if (std::isfinite(value)) return;
  throw InvalidArgument(std::string(field) + " = " + number_text(value, 17) +
                        ", allowed are finite numbers");
}

void check_unit(const char* field, double length) {
  if (std::abs(length - 1.0) <= kUnitTolerance) return;
  throw InvalidArgument(std::string(field) + " has length " + number_text(length, 17) +
                        ", allowed is 1 within " + number_text(kUnitTolerance));
}

template <class Rod>
void check_rod(const Rod& body) {
  check_length("radius", body.radius);
  check_length("half_length", body.half_length);
  check_unit("axis", norm(body.axis));
}

}  // namespace

void check_body(const Body& body) {
  std::visit(Overloaded{[](const Sphere& b) { check_length("radius", b.radius); },
                        [](const Ellipsoid& b) {
                          check_length("axes[0]", b.semi_axes.x);
                          check_length("axes[1]", b.semi_axes.y);
                          check_length("axes[2]", b.semi_axes.z);
                          check_unit("quaternion", norm(b.orientation));
                        },
                        [](const Cylinder& b) { check_rod(b); },
                        [](const Spherocylinder& b) { check_rod(b); },
                        [](const Disk& b) { check_length("radius", b.radius); },
                        [](const Ellipse& b) {
                          check_length("axes[0]", b.semi_axes.x);
                          check_length("axes[1]", b.semi_axes.y);
                          check_finite("angle", b.angle);
                        }},
             body);
}

}  // namespace packstone
