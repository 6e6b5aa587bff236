#include "io/draw/solid.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "packstone/core/overloaded.hpp"
#include "packstone/core/quaternion.hpp"

namespace packstone::draw {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// |o + t d| <= radius.
Crossing ball(const Vec3& o, const Vec3& d, double radius) {
  const double a = norm_sq(d);
  const double b = dot(o, d);
  const double c = norm_sq(o) - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0.0) return {};
  const double root = std::sqrt(discriminant);
  const double enter = (-b - root) / a;
  return {enter, (-b + root) / a, (o + enter * d) / radius};
}

// x^2 + y^2 <= radius^2, endless along z.
Crossing tube(const Vec3& o, const Vec3& d, double radius) {
  const double a = d.x * d.x + d.y * d.y;
  const double b = o.x * d.x + o.y * d.y;
  const double c = o.x * o.x + o.y * o.y - radius * radius;
  const double discriminant = b * b - a * c;
  if (a <= 0.0) return c < 0.0 ? Crossing{-kInfinity, kInfinity, {}} : Crossing{};
  if (discriminant <= 0.0) return {};
  const double root = std::sqrt(discriminant);
  const double enter = (-b - root) / a;
  const Vec3 at = o + enter * d;
  return {enter, (-b + root) / a, {at.x / radius, at.y / radius, 0.0}};
}

// |z| <= h.
Crossing slab(const Vec3& o, const Vec3& d, double h) {
  if (d.z == 0.0) return std::abs(o.z) < h ? Crossing{-kInfinity, kInfinity, {}} : Crossing{};
  const double near = (std::copysign(h, -d.z) - o.z) / d.z;
  const double far = (std::copysign(h, d.z) - o.z) / d.z;
  return {near, far, {0.0, 0.0, std::copysign(1.0, -d.z)}};
}

// The parts of a convex union join into one.
Crossing joined(const Crossing& a, const Crossing& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  Crossing all = a.enter <= b.enter ? a : b;
  all.leave = std::max(a.leave, b.leave);
  return all;
}

Crossing in_body_frame(const Ellipsoid& b, const Vec3& o, const Vec3& d) {
  Crossing c = ball(unscale(o, b.semi_axes), unscale(d, b.semi_axes), 1.0);
  if (!c.empty()) c.normal = normalized(unscale(c.normal, b.semi_axes));
  return c;
}

Crossing in_body_frame(const Cylinder& b, const Vec3& o, const Vec3& d) {
  return intersection(tube(o, d, b.radius), slab(o, d, b.half_length));
}

Crossing in_body_frame(const Spherocylinder& b, const Vec3& o, const Vec3& d) {
  const Vec3 end{0.0, 0.0, b.half_length};
  const Crossing straight = intersection(tube(o, d, b.radius), slab(o, d, b.half_length));
  return joined(straight, joined(ball(o - end, d, b.radius), ball(o + end, d, b.radius)));
}

Crossing in_body_frame(const Sphere& b, const Vec3& o, const Vec3& d) {
  return ball(o, d, b.radius);
}

// Flat bodies are drawn in the plane, never here.
Crossing in_body_frame(const Disk&, const Vec3&, const Vec3&) { return {}; }
Crossing in_body_frame(const Ellipse&, const Vec3&, const Vec3&) { return {}; }

Mat3 frame_of(const Body& body) {
  return std::visit(Overloaded{[](const Ellipsoid& b) { return to_matrix(b.orientation); },
                               [](const Cylinder& b) { return to_matrix(from_z_to(b.axis)); },
                               [](const Spherocylinder& b) { return to_matrix(from_z_to(b.axis)); },
                               [](const auto&) { return Mat3{}; }},
                    body);
}

}  // namespace

Crossing intersection(const Crossing& a, const Crossing& b) noexcept {
  if (a.empty() || b.empty()) return {};
  Crossing common = a.enter >= b.enter ? a : b;
  common.leave = std::min(a.leave, b.leave);
  return common;
}

Crossing crossing(const Box& box, const Ray& ray) noexcept {
  Crossing all{-kInfinity, kInfinity, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    const double d = ray.direction[axis];
    if (d == 0.0) {
      if (o < box.low[axis] || o > box.high[axis]) return {};
      continue;
    }
    double near = (box.low[axis] - o) / d;
    double far = (box.high[axis] - o) / d;
    if (near > far) std::swap(near, far);
    Crossing across{near, far, {}};
    across.normal[axis] = d > 0.0 ? -1.0 : 1.0;
    all = intersection(all, across);
  }
  return all;
}

Solid make_solid(const Body& body, const Vec3& center, const Vec3& color, bool clipped) {
  return {body, center, color, clipped, frame_of(body)};
}

Crossing crossing(const Solid& solid, const Ray& ray) noexcept {
  const Vec3 o = mul_transposed(solid.frame, ray.origin - solid.center);
  const Vec3 d = mul_transposed(solid.frame, ray.direction);
  Crossing c = std::visit([&](const auto& body) { return in_body_frame(body, o, d); }, solid.body);
  if (!c.empty()) c.normal = solid.frame * c.normal;
  return c;
}

}  // namespace packstone::draw
