#include "geometry/posed_body.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "packstone/core/mat.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/core/quaternion.hpp"

namespace packstone {
namespace {

// Semi-axes of an ellipsoid in the order axis, second, third: numbers of the body axes.
std::array<std::size_t, 3> axis_order(const Vec3& semi_axes) {
  const auto first = static_cast<std::size_t>(symmetry_axis(semi_axes));
  return {first, (first + 1) % 3, (first + 2) % 3};
}

const Vec3& column(const Mat3& m, std::size_t k) {
  return k == 0 ? m.col_x : k == 1 ? m.col_y : m.col_z;
}

PosedBody posed_ball(double radius) { return {Form::ball, {}, radius, 0.0, radius}; }

PosedBody posed_rod(Form form, const Vec3& axis, double radius, double half_length) {
  return {form, {{}, normalized(axis), {}}, half_length, 0.0, radius};
}

PosedBody posed_ellipsoid(const Ellipsoid& body) {
  const Vec3& s = body.semi_axes;
  if (s.x == s.y && s.y == s.z) return posed_ball(s.x);
  const auto [first, second, third] = axis_order(s);
  const Mat3 frame = to_matrix(body.orientation);
  const Vec3 axis = normalized(column(frame, first));
  if (s[second] == s[third]) return {Form::spheroid, {{}, axis, {}}, s[first], 0.0, s[third]};
  return {
      Form::scalene, {{}, axis, normalized(column(frame, second))}, s[first], s[second], s[third]};
}

PosedBody posed_ellipse(const Ellipse& body) {
  const Vec2& s = body.semi_axes;
  if (s.x == s.y) return posed_ball(s.x);
  return {
      Form::spheroid, {{}, {std::cos(body.angle), std::sin(body.angle), 0.0}, {}}, s.x, 0.0, s.y};
}

Body turned_ellipsoid(const Ellipsoid& shape, const Pose& pose) {
  const Vec3& s = shape.semi_axes;
  if (s.x == s.y && s.y == s.z) return shape;
  const auto [first, second, third] = axis_order(s);
  if (s[second] == s[third]) {
    const Vec3 before = normalized(column(to_matrix(shape.orientation), first));
    return Ellipsoid{s, normalized(from_to(before, pose.axis) * shape.orientation)};
  }
  std::array<Vec3, 3> columns;
  columns[first] = pose.axis;
  columns[second] = pose.second;
  columns[third] = cross(pose.axis, pose.second);
  return Ellipsoid{s, from_matrix({columns[0], columns[1], columns[2]})};
}

Vec3 about_all(double inertia) { return {inertia, inertia, inertia}; }

Vec3 ellipsoid_inertia(const Ellipsoid& body) {
  const Vec3& s = body.semi_axes;
  if (s.x == s.y && s.y == s.z) return {};
  const auto [first, second, third] = axis_order(s);
  const auto square = [&](std::size_t k) { return s[k] * s[k]; };
  const double across = 0.2 * (square(first) + square(third));
  if (s[second] == s[third]) return about_all(across);
  return {0.2 * (square(second) + square(third)), across, 0.2 * (square(first) + square(second))};
}

// Across the axis of a cylinder with half-balls on its ends.
double spherocylinder_inertia(double r, double h) {
  const double cylinder = 2.0 * std::numbers::pi * r * r * h;
  const double caps = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  // A half-ball about its flat side's center 2/5 r^2, its centroid 3/8 r away, then by Steiner.
  const double of_caps = 0.4 * r * r + 0.75 * r * h + h * h;
  return (cylinder * (0.25 * r * r + h * h / 3.0) + caps * of_caps) / (cylinder + caps);
}

double ellipse_inertia(const Ellipse& body) {
  const Vec2& s = body.semi_axes;
  return s.x == s.y ? 0.0 : 0.25 * (s.x * s.x + s.y * s.y);
}

}  // namespace

PosedBody posed_body(const Body& body, const Vec3& center) {
  PosedBody posed = std::visit(
      Overloaded{[](const Sphere& b) { return posed_ball(b.radius); },
                 [](const Disk& b) { return posed_ball(b.radius); },
                 [](const Ellipsoid& b) { return posed_ellipsoid(b); },
                 [](const Ellipse& b) { return posed_ellipse(b); },
                 [](const Cylinder& b) {
                   return posed_rod(Form::cylinder, b.axis, b.radius, b.half_length);
                 },
                 [](const Spherocylinder& b) {
                   return posed_rod(Form::spherocylinder, b.axis, b.radius, b.half_length);
                 }},
      body);
  posed.pose.center = center;
  return posed;
}

Body turned_body(const Body& shape, const Pose& pose) {
  return std::visit(
      Overloaded{[](const Sphere& b) -> Body { return b; }, [](const Disk& b) -> Body { return b; },
                 [&](const Ellipsoid& b) { return turned_ellipsoid(b, pose); },
                 [&](const Cylinder& b) -> Body {
                   return Cylinder{b.radius, b.half_length, pose.axis};
                 },
                 [&](const Spherocylinder& b) -> Body {
                   return Spherocylinder{b.radius, b.half_length, pose.axis};
                 },
                 [&](const Ellipse& b) -> Body {
                   return Ellipse{b.semi_axes, std::atan2(pose.axis.y, pose.axis.x)};
                 }},
      shape);
}

Vec3 specific_inertia(const Body& body) {
  return std::visit(
      Overloaded{[](const Sphere&) { return Vec3{}; }, [](const Disk&) { return Vec3{}; },
                 [](const Ellipsoid& b) { return ellipsoid_inertia(b); },
                 [](const Ellipse& b) { return about_all(ellipse_inertia(b)); },
                 [](const Cylinder& b) {
                   return about_all(0.25 * b.radius * b.radius +
                                    b.half_length * b.half_length / 3.0);
                 },
                 [](const Spherocylinder& b) {
                   return about_all(spherocylinder_inertia(b.radius, b.half_length));
                 }},
      body);
}

double support(const PosedBody& body, const Vec3& n) {
  if (body.form == Form::ball) return body.lateral * norm(n);
  const double along = dot(n, body.pose.axis);
  const Vec3 flat = n - along * body.pose.axis;
  switch (body.form) {
    case Form::ball:
    case Form::spheroid:
      return std::sqrt(body.axial * body.axial * along * along +
                       body.lateral * body.lateral * norm_sq(flat));
    case Form::scalene:
      return std::sqrt(dot(n, shape_times(body, n)));
    case Form::cylinder:
      return body.axial * std::abs(along) + body.lateral * norm(flat);
    case Form::spherocylinder:
      break;
  }
  return body.axial * std::abs(along) + body.lateral * norm(n);
}

Vec3 support_point(const PosedBody& body, const Vec3& n) {
  constexpr double kOnSide = 1e-14;
  if (is_ellipsoid(body.form)) {
    const Vec3 image = shape_times(body, n);
    return image / std::sqrt(dot(n, image));
  }
  const double along = dot(n, body.pose.axis);
  const double end = std::abs(along) < kOnSide ? 0.0 : std::copysign(body.axial, along);
  if (body.form == Form::spherocylinder) return end * body.pose.axis + body.lateral * n;
  const Vec3 flat = n - along * body.pose.axis;
  const double length = norm(flat);
  return end * body.pose.axis + (length < kOnSide ? Vec3{} : (body.lateral / length) * flat);
}

Vec3 shape_times(const PosedBody& body, const Vec3& n) {
  const double along = dot(n, body.pose.axis);
  const Vec3 flat = n - along * body.pose.axis;
  const double lateral_sq = body.lateral * body.lateral;
  Vec3 image = (body.axial * body.axial * along) * body.pose.axis;
  if (body.form != Form::scalene) return image + lateral_sq * flat;
  const double second = dot(flat, body.pose.second);
  image += (body.second * body.second * second) * body.pose.second;
  return image + lateral_sq * (flat - second * body.pose.second);
}

}  // namespace packstone
