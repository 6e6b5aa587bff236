#include "packstone/geometry/measures.hpp"

#include <algorithm>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/ellint_rg.hpp>
#include <cmath>
#include <numbers>

#include "packstone/core/overloaded.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

double ellipse_perimeter(double a, double b) {
  const double major = std::max(a, b);
  const double minor = std::min(a, b);
  return 4.0 * major *
         boost::math::ellint_2(std::sqrt((1.0 - minor / major) * (1.0 + minor / major)));
}

// S = 4 pi R_G(a^2 b^2, a^2 c^2, b^2 c^2), Carlson, Numer. Algorithms 10 (1995) 13-26.
double ellipsoid_surface(const Vec3& s) {
  const double ab = s.x * s.y, ac = s.x * s.z, bc = s.y * s.z;
  return 4.0 * pi * boost::math::ellint_rg(ab * ab, ac * ac, bc * bc);
}

// along u u^T + across (1 - u u^T).
SymMat3 transversely_isotropic(const Vec3& u, double along, double across) {
  return across * SymMat3{1, 1, 1, 0, 0, 0} + (along - across) * dyad(u);
}

SymMat3 cylinder_moment(double r, double h, const Vec3& u) {
  const double v = 2.0 * pi * r * r * h;
  return transversely_isotropic(u, v * h * h / 3.0, v * r * r / 4.0);
}

// Straight part, plus two half-balls whose centroids stand 3r/8 beyond its ends.
SymMat3 spherocylinder_moment(double r, double h, const Vec3& u) {
  const double ball = 4.0 / 3.0 * pi * r * r * r;
  const double along = ball * (r * r / 5.0 + h * h + 0.75 * h * r);
  return cylinder_moment(r, h, u) + transversely_isotropic(u, along, ball * r * r / 5.0);
}

SymMat3 ellipse_moment(const Ellipse& b) {
  const double area = pi * b.semi_axes.x * b.semi_axes.y;
  const Vec3 u{std::cos(b.angle), std::sin(b.angle), 0.0};
  const Vec3 v{-u.y, u.x, 0.0};
  return area / 4.0 *
         (b.semi_axes.x * b.semi_axes.x * dyad(u) + b.semi_axes.y * b.semi_axes.y * dyad(v));
}

double turn_about_z(const Quaternion& q) { return 2.0 * std::atan2(q.z, q.w); }

}  // namespace

double volume(const Body& body) noexcept {
  return std::visit(
      Overloaded{[](const Sphere& b) { return 4.0 / 3.0 * pi * b.radius * b.radius * b.radius; },
                 [](const Ellipsoid& b) {
                   return 4.0 / 3.0 * pi * b.semi_axes.x * b.semi_axes.y * b.semi_axes.z;
                 },
                 [](const Cylinder& b) { return 2.0 * pi * b.radius * b.radius * b.half_length; },
                 [](const Spherocylinder& b) {
                   return pi * b.radius * b.radius * (2.0 * b.half_length + 4.0 / 3.0 * b.radius);
                 },
                 [](const Disk& b) { return pi * b.radius * b.radius; },
                 [](const Ellipse& b) { return pi * b.semi_axes.x * b.semi_axes.y; }},
      body);
}

double surface(const Body& body) {
  return std::visit(
      Overloaded{
          [](const Sphere& b) { return 4.0 * pi * b.radius * b.radius; },
          [](const Ellipsoid& b) { return ellipsoid_surface(b.semi_axes); },
          [](const Cylinder& b) { return 2.0 * pi * b.radius * (b.radius + 2.0 * b.half_length); },
          [](const Spherocylinder& b) { return 4.0 * pi * b.radius * (b.radius + b.half_length); },
          [](const Disk& b) { return 2.0 * pi * b.radius; },
          [](const Ellipse& b) { return ellipse_perimeter(b.semi_axes.x, b.semi_axes.y); }},
      body);
}

SymMat3 second_moment(const Body& body) noexcept {
  return std::visit(
      Overloaded{[&](const Sphere& b) {
                   const double m = volume(body) * b.radius * b.radius / 5.0;
                   return SymMat3{m, m, m, 0, 0, 0};
                 },
                 [&](const Ellipsoid& b) {
                   return volume(body) / 5.0 *
                          rotated_diagonal(to_matrix(b.orientation),
                                           scale(b.semi_axes, b.semi_axes));
                 },
                 [](const Cylinder& b) { return cylinder_moment(b.radius, b.half_length, b.axis); },
                 [](const Spherocylinder& b) {
                   return spherocylinder_moment(b.radius, b.half_length, b.axis);
                 },
                 [&](const Disk& b) {
                   const double m = volume(body) * b.radius * b.radius / 4.0;
                   return SymMat3{m, m, 0, 0, 0, 0};
                 },
                 [](const Ellipse& b) { return ellipse_moment(b); }},
      body);
}

Vec3 long_axis(const Body& body) noexcept {
  return std::visit(
      Overloaded{[](const Ellipsoid& b) {
                   const Mat3 frame = to_matrix(b.orientation);
                   const Vec3& s = b.semi_axes;
                   if (s.x >= s.y && s.x >= s.z) return frame.col_x;
                   return s.y >= s.z ? frame.col_y : frame.col_z;
                 },
                 [](const Cylinder& b) { return b.axis; },
                 [](const Spherocylinder& b) { return b.axis; },
                 [](const Ellipse& b) {
                   const Vec3 u{std::cos(b.angle), std::sin(b.angle), 0.0};
                   return b.semi_axes.x >= b.semi_axes.y ? u : Vec3{-u.y, u.x, 0.0};
                 },
                 [](const Sphere&) { return Vec3{}; }, [](const Disk&) { return Vec3{}; }},
      body);
}

Body scaled(const Body& body, double f) noexcept {
  return std::visit(Overloaded{[=](const Sphere& b) -> Body { return Sphere{f * b.radius}; },
                               [=](const Ellipsoid& b) -> Body {
                                 return Ellipsoid{f * b.semi_axes, b.orientation};
                               },
                               [=](const Cylinder& b) -> Body {
                                 return Cylinder{f * b.radius, f * b.half_length, b.axis};
                               },
                               [=](const Spherocylinder& b) -> Body {
                                 return Spherocylinder{f * b.radius, f * b.half_length, b.axis};
                               },
                               [=](const Disk& b) -> Body { return Disk{f * b.radius}; },
                               [=](const Ellipse& b) -> Body {
                                 return Ellipse{f * b.semi_axes, b.angle};
                               }},
                    body);
}

Body rotated(const Body& body, const Quaternion& q) noexcept {
  return std::visit(
      Overloaded{[](const Sphere& b) -> Body { return b; },
                 [&](const Ellipsoid& b) -> Body {
                   return Ellipsoid{b.semi_axes, normalized(q * b.orientation)};
                 },
                 [&](const Cylinder& b) -> Body {
                   return Cylinder{b.radius, b.half_length, normalized(rotate(q, b.axis))};
                 },
                 [&](const Spherocylinder& b) -> Body {
                   return Spherocylinder{b.radius, b.half_length, normalized(rotate(q, b.axis))};
                 },
                 [](const Disk& b) -> Body { return b; },
                 [&](const Ellipse& b) -> Body {
                   return Ellipse{b.semi_axes, b.angle + turn_about_z(q)};
                 }},
      body);
}

}  // namespace packstone
