#include "generate/event_driven/bodies.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "packstone/core/mat.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::event_driven {
namespace {

// What the engine keeps of a body: its form, its axes with their semi-axes, and its moments of
// inertia over its mass, about axis, second and third axis.
struct Features {
  Form form = Form::ball;
  Spin spin;
  SecondAxis second;
  Vec3 inertia;
};

// Semi-axes of an ellipsoid in the order axis, second, third: numbers of the body axes.
std::array<std::size_t, 3> axis_order(const Vec3& semi_axes) {
  const auto first = static_cast<std::size_t>(symmetry_axis(semi_axes));
  return {first, (first + 1) % 3, (first + 2) % 3};
}

const Vec3& column(const Mat3& m, std::size_t k) {
  return k == 0 ? m.col_x : k == 1 ? m.col_y : m.col_z;
}

Features features_of(const Ellipsoid& body) {
  const Vec3& s = body.semi_axes;
  const auto [first, second, third] = axis_order(s);
  const Mat3 frame = to_matrix(body.orientation);
  Features f;
  if (s.x == s.y && s.y == s.z) {
    f.spin.lateral = f.spin.axial = s.x;
    return f;
  }
  f.form = s[second] == s[third] ? Form::spheroid : Form::scalene;
  f.spin.axis = normalized(column(frame, first));
  f.spin.axial = s[first];
  f.spin.lateral = s[third];
  f.second = {normalized(column(frame, second)), s[second]};
  const auto square = [&](std::size_t k) { return s[k] * s[k]; };
  f.inertia = {0.2 * (square(second) + square(third)), 0.2 * (square(first) + square(third)),
               0.2 * (square(first) + square(second))};
  return f;
}

Features features_of(const Ellipse& body) {
  const Vec2& s = body.semi_axes;
  Features f;
  if (s.x == s.y) {
    f.spin.lateral = f.spin.axial = s.x;
    return f;
  }
  f.form = Form::spheroid;
  f.spin.axis = {std::cos(body.angle), std::sin(body.angle), 0.0};
  f.spin.axial = s.x;
  f.spin.lateral = s.y;
  const double polar = 0.25 * (s.x * s.x + s.y * s.y);
  f.inertia = {polar, polar, polar};
  return f;
}

Features features_of(double radius) {
  Features f;
  f.spin.lateral = f.spin.axial = radius;
  return f;
}
Features features_of(const Sphere& body) { return features_of(body.radius); }
Features features_of(const Disk& body) { return features_of(body.radius); }

Features features_of_rod(Form form, const Vec3& axis, double radius, double half_length,
                         double inertia) {
  Features f;
  f.form = form;
  f.spin.axis = normalized(axis);
  f.spin.lateral = radius;
  f.spin.axial = half_length;
  f.inertia = {inertia, inertia, inertia};
  return f;
}

Features features_of(const Cylinder& body) {
  const double r = body.radius, h = body.half_length;
  return features_of_rod(Form::cylinder, body.axis, r, h, 0.25 * r * r + h * h / 3.0);
}

// Transverse moment of inertia of a cylinder with half-balls on its ends, over its mass.
double spherocylinder_inertia(double r, double h) {
  const double cylinder = 2.0 * std::numbers::pi * r * r * h;
  const double caps = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  // A half-ball about its flat side's center 2/5 r^2, its centroid 3/8 r away, then by Steiner.
  const double of_caps = 0.4 * r * r + 0.75 * r * h + h * h;
  return (cylinder * (0.25 * r * r + h * h / 3.0) + caps * of_caps) / (cylinder + caps);
}

Features features_of(const Spherocylinder& body) {
  return features_of_rod(Form::spherocylinder, body.axis, body.radius, body.half_length,
                         spherocylinder_inertia(body.radius, body.half_length));
}

// Bodies of revolution never turn about their axis: nothing would be seen of it, and then a
// constant angular velocity is free motion.
Vec3 inverse_inertia_of(const Features& f, bool turns) {
  if (!turns || f.form == Form::ball) return {};
  if (f.form == Form::scalene) return {1.0 / f.inertia.x, 1.0 / f.inertia.y, 1.0 / f.inertia.z};
  return {0.0, 1.0 / f.inertia.y, 1.0 / f.inertia.y};
}

}  // namespace

void add_body(Bodies& bodies, const Body& body, const Vec3& center, bool turns) {
  const Features f = std::visit([](const auto& b) { return features_of(b); }, body);
  bodies.flight.push_back({center, {}, 0.0, 0.0});
  bodies.reach.push_back(circum_radius(body));
  bodies.spin.push_back(f.spin);
  bodies.form.push_back(f.form);
  bodies.inverse_mass.push_back(1.0);
  bodies.inverse_inertia.push_back(inverse_inertia_of(f, turns));
  if (f.form != Form::scalene && bodies.second.empty()) return;
  bodies.second.resize(bodies.flight.size());
  bodies.second.back() = f.form == Form::scalene
                             ? f.second
                             : SecondAxis{any_perpendicular(f.spin.axis), f.spin.lateral};
}

bool are_revolution(const Bodies& bodies) {
  return std::all_of(bodies.form.begin(), bodies.form.end(),
                     [](Form form) { return form <= Form::spheroid; });
}

void Bodies::advance(std::int32_t i, double t) {
  const auto k = static_cast<std::size_t>(i);
  const Pose now = pose(i, t);
  flight[k].center = now.center;
  flight[k].clock = t;
  if (flight[k].turn == 0.0) return;
  spin[k].axis = normalized(now.axis);
  if (form[k] == Form::scalene) {
    second[k].axis = normalized(now.second - dot(now.second, spin[k].axis) * spin[k].axis);
  } else {
    set_angular(k, spin[k].angular - dot(spin[k].angular, spin[k].axis) * spin[k].axis);
  }
}

Vec3 inverse_inertia_times(const Bodies& bodies, std::int32_t i, const Pose& pose, double size,
                           const Vec3& torque) {
  const auto k = static_cast<std::size_t>(i);
  const Vec3& inverse = bodies.inverse_inertia[k];
  const double per_size = 1.0 / (size * size);
  const Vec3& u = pose.axis;
  if (bodies.form[k] != Form::scalene) {
    return (per_size * inverse.y) * (torque - dot(torque, u) * u);
  }
  const Vec3& v = pose.second;
  const Vec3 w = cross(u, v);
  return per_size * (inverse.x * dot(torque, u) * u + inverse.y * dot(torque, v) * v +
                     inverse.z * dot(torque, w) * w);
}

Body turned_body(const Bodies& bodies, std::int32_t i, const Body& shape) {
  const auto k = static_cast<std::size_t>(i);
  if (bodies.inverse_inertia[k] == Vec3{}) return shape;
  const Vec3& axis = bodies.spin[k].axis;
  const auto turned_ellipsoid = [&](const Ellipsoid& b) -> Body {
    const auto [first, second, third] = axis_order(b.semi_axes);
    if (bodies.form[k] == Form::spheroid) {
      const Vec3 before = normalized(column(to_matrix(b.orientation), first));
      return Ellipsoid{b.semi_axes, normalized(from_to(before, axis) * b.orientation)};
    }
    std::array<Vec3, 3> columns;
    columns[first] = axis;
    columns[second] = bodies.second[k].axis;
    columns[third] = cross(axis, bodies.second[k].axis);
    return Ellipsoid{b.semi_axes, from_matrix({columns[0], columns[1], columns[2]})};
  };
  return std::visit(Overloaded{[](const Sphere& b) -> Body { return b; },
                               [](const Disk& b) -> Body { return b; }, turned_ellipsoid,
                               [&](const Cylinder& b) -> Body {
                                 return Cylinder{b.radius, b.half_length, axis};
                               },
                               [&](const Spherocylinder& b) -> Body {
                                 return Spherocylinder{b.radius, b.half_length, axis};
                               },
                               [&](const Ellipse& b) -> Body {
                                 return Ellipse{b.semi_axes, std::atan2(axis.y, axis.x)};
                               }},
                    shape);
}

}  // namespace packstone::event_driven
