#include "packstone/geometry/support.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/tolerances.hpp"

namespace packstone {
namespace {

// Part of d across the unit vector u.
Vec3 across(const Vec3& u, const Vec3& d) { return d - dot(u, d) * u; }

Vec2 body_x(const Ellipse& body) { return {std::cos(body.angle), std::sin(body.angle)}; }

// Coordinates of the plane vector v along the axes of the ellipse.
Vec2 to_body(const Ellipse& body, const Vec3& v) {
  const Vec2 u = body_x(body);
  return {u.x * v.x + u.y * v.y, u.x * v.y - u.y * v.x};
}

// Rounding of coordinates found by rotation, as seen by the test (coordinate / length <= 1).
double inside_limit(double reach, double least) {
  return 1.0 - kSupportRoundoff * std::max(1.0, reach / least);
}

}  // namespace

double support(const Sphere& body, const Vec3& d) noexcept { return body.radius * norm(d); }

double support(const Ellipsoid& body, const Vec3& d) noexcept {
  return norm(scale(body.semi_axes, mul_transposed(to_matrix(body.orientation), d)));
}

double support(const Cylinder& body, const Vec3& d) noexcept {
  return body.half_length * std::abs(dot(body.axis, d)) + body.radius * norm(across(body.axis, d));
}

double support(const Spherocylinder& body, const Vec3& d) noexcept {
  return body.half_length * std::abs(dot(body.axis, d)) + body.radius * norm(d);
}

double support(const Disk& body, const Vec3& d) noexcept { return body.radius * norm(flatten(d)); }

double support(const Ellipse& body, const Vec3& d) noexcept {
  const Vec2 v = to_body(body, d);
  return norm(Vec2{body.semi_axes.x * v.x, body.semi_axes.y * v.y});
}

double support(const Body& body, const Vec3& d) noexcept {
  return std::visit([&](const auto& b) { return support(b, d); }, body);
}

Vec3 support_point(const Sphere& body, const Vec3& d) noexcept {
  return (body.radius / norm(d)) * d;
}

Vec3 support_point(const Ellipsoid& body, const Vec3& d) noexcept {
  const Mat3 rotation = to_matrix(body.orientation);
  const Vec3 v = scale(body.semi_axes, mul_transposed(rotation, d));
  return rotation * (scale(body.semi_axes, v) / norm(v));
}

Vec3 support_point(const Cylinder& body, const Vec3& d) noexcept {
  const double along = dot(body.axis, d);
  // Twice: near the axis, rounding leaves a part along the axis that would carry the point outside.
  const Vec3 radial = across(body.axis, across(body.axis, d));
  const double rho = norm(radial);
  const Vec3 end = std::copysign(body.half_length, along) * body.axis;
  // Where d is along the axis within rounding, the center of the end face serves as well.
  return rho > kSupportRoundoff * norm(d) ? end + (body.radius / rho) * radial : end;
}

Vec3 support_point(const Spherocylinder& body, const Vec3& d) noexcept {
  return std::copysign(body.half_length, dot(body.axis, d)) * body.axis +
         (body.radius / norm(d)) * d;
}

Vec3 support_point(const Disk& body, const Vec3& d) noexcept {
  return lift((body.radius / norm(flatten(d))) * flatten(d));
}

Vec3 support_point(const Ellipse& body, const Vec3& d) noexcept {
  const Vec2 v = to_body(body, d);
  const Vec2 scaled{body.semi_axes.x * v.x, body.semi_axes.y * v.y};
  const double length = norm(scaled);
  const Vec2 p{body.semi_axes.x * scaled.x / length, body.semi_axes.y * scaled.y / length};
  const Vec2 u = body_x(body);
  return {u.x * p.x - u.y * p.y, u.y * p.x + u.x * p.y, 0.0};
}

Vec3 support_point(const Body& body, const Vec3& d) noexcept {
  return std::visit([&](const auto& b) { return support_point(b, d); }, body);
}

bool contains(const Sphere& body, const Vec3& x) noexcept {
  return norm(x) <= body.radius * (1.0 - kSupportRoundoff);
}

bool contains(const Ellipsoid& body, const Vec3& x) noexcept {
  const Vec3 v = mul_transposed(to_matrix(body.orientation), x);
  const double least = std::min({body.semi_axes.x, body.semi_axes.y, body.semi_axes.z});
  return norm(unscale(v, body.semi_axes)) <= inside_limit(norm(x), least);
}

bool contains(const Cylinder& body, const Vec3& x) noexcept {
  const double slack = kSupportRoundoff * norm(x);
  return std::abs(dot(body.axis, x)) + slack <= body.half_length * (1.0 - kSupportRoundoff) &&
         norm(across(body.axis, x)) + slack <= body.radius * (1.0 - kSupportRoundoff);
}

bool contains(const Spherocylinder& body, const Vec3& x) noexcept {
  const double t = std::clamp(dot(body.axis, x), -body.half_length, body.half_length);
  return norm(x - t * body.axis) + kSupportRoundoff * (norm(x) + body.half_length) <=
         body.radius * (1.0 - kSupportRoundoff);
}

bool contains(const Disk& body, const Vec3& x) noexcept {
  return norm(flatten(x)) <= body.radius * (1.0 - kSupportRoundoff);
}

bool contains(const Ellipse& body, const Vec3& x) noexcept {
  const Vec2 v = to_body(body, x);
  const double least = std::min(body.semi_axes.x, body.semi_axes.y);
  return norm(Vec2{v.x / body.semi_axes.x, v.y / body.semi_axes.y}) <=
         inside_limit(norm(flatten(x)), least);
}

bool contains(const Body& body, const Vec3& x) noexcept {
  return std::visit([&](const auto& b) { return contains(b, x); }, body);
}

}  // namespace packstone
