#include "generate/event_driven/bodies.hpp"

#include <algorithm>

#include "packstone/geometry/bounds.hpp"

namespace packstone::event_driven {
namespace {

// Bodies of revolution never turn about their axis: nothing would be seen of it, and then a
// constant angular velocity is free motion.
Vec3 inverse_inertia_of(const Body& body, Form form, bool turns) {
  if (!turns || form == Form::ball) return {};
  const Vec3 inertia = specific_inertia(body);
  if (form == Form::scalene) return {1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z};
  return {0.0, 1.0 / inertia.y, 1.0 / inertia.y};
}

}  // namespace

void add_body(Bodies& bodies, const Body& body, const Vec3& center, bool turns) {
  const PosedBody posed = posed_body(body);
  bodies.flight.push_back({center, {}, 0.0, 0.0});
  bodies.reach.push_back(circum_radius(body));
  bodies.spin.push_back({posed.pose.axis, {}, posed.lateral, posed.axial});
  bodies.form.push_back(posed.form);
  bodies.inverse_mass.push_back(1.0);
  bodies.inverse_inertia.push_back(inverse_inertia_of(body, posed.form, turns));
  if (posed.form != Form::scalene && bodies.second.empty()) return;
  bodies.second.resize(bodies.flight.size());
  bodies.second.back() = posed.form == Form::scalene
                             ? SecondAxis{posed.pose.second, posed.second}
                             : SecondAxis{any_perpendicular(posed.pose.axis), posed.lateral};
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
  const Vec3 second = bodies.second.empty() ? Vec3{} : bodies.second[k].axis;
  return turned_body(shape, {{}, bodies.spin[k].axis, second});
}

}  // namespace packstone::event_driven
