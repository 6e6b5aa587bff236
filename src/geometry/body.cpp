#include "packstone/geometry/body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/mat.hpp"
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

int symmetry_axis(const Vec3& s) noexcept {
  const auto equal = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(a, b); };
  if (equal(s.x, s.y)) return 2;
  if (equal(s.x, s.z)) return 1;
  if (equal(s.y, s.z)) return 0;
  return s.x > s.y && s.x > s.z ? 0 : s.y > s.z ? 1 : 2;
}

std::optional<Vec3> symmetry_axis(const Body& body) noexcept {
  using Axis = std::optional<Vec3>;
  return std::visit(
      Overloaded{[](const Ellipsoid& b) -> Axis {
                   const Mat3 turn = to_matrix(b.orientation);
                   const int axis = symmetry_axis(b.semi_axes);
                   return axis == 0 ? turn.col_x : axis == 1 ? turn.col_y : turn.col_z;
                 },
                 [](const Ellipse& b) -> Axis {
                   const bool x_is_major = b.semi_axes.x >= b.semi_axes.y;
                   const double angle = b.angle + (x_is_major ? 0.0 : std::numbers::pi / 2);
                   return Vec3{std::cos(angle), std::sin(angle), 0.0};
                 },
                 [](const Cylinder& b) -> Axis { return b.axis; },
                 [](const Spherocylinder& b) -> Axis { return b.axis; },
                 [](const auto&) -> Axis { return std::nullopt; }},
      body);
}

}  // namespace packstone
