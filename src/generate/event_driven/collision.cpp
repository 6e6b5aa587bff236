#include "generate/event_driven/collision.hpp"

#include <algorithm>
#include <cmath>

namespace packstone::event_driven {
namespace {

// Collisions faster than this many times the growth of the surfaces keep the energy.
constexpr double kFast = 4.0;
// Of the thermal speed: what a contact that closes no more within rounding is pushed apart with.
constexpr double kLeastApproach = 1e-12;

double restitution(const Contact& contact) {
  const double growth = contact.growth_speed;
  return contact.approach > kFast * growth ? 1.0 - 2.0 * growth / contact.approach : 1.0;
}

// Half the inverse of the moment of inertia is what a torque makes of the energy.
double turning_part(const Bodies& bodies, std::int32_t i, const Pose& pose, double size,
                    const Vec3& torque, Vec3& response) {
  if (bodies.inverse_inertia[static_cast<std::size_t>(i)] == Vec3{}) return 0.0;
  response = inverse_inertia_times(bodies, i, pose, size, torque);
  return dot(torque, response);
}

Pose pose_now(const Bodies& bodies, std::int32_t i) {
  const auto k = static_cast<std::size_t>(i);
  return {bodies.flight[k].center, bodies.spin[k].axis,
          bodies.second.empty() ? Vec3{} : bodies.second[k].axis};
}

}  // namespace

double collide(Bodies& bodies, std::int32_t i, const Partner& partner, const Contact& contact,
               double t) {
  const auto a = static_cast<std::size_t>(i);
  const double size = bodies.size_at(t);
  const Vec3& n = contact.normal;
  const double push = (1.0 + restitution(contact)) * std::max(contact.approach, kLeastApproach);
  const bool own_image = partner.body == i;
  const Vec3 arm = own_image ? contact.arm_a - contact.arm_b : contact.arm_a;
  Vec3 response_a, response_b;
  double inverse = own_image ? 0.0 : bodies.inverse_mass[a];
  inverse += turning_part(bodies, i, pose_now(bodies, i), size, cross(arm, n), response_a);
  const bool two = !own_image && !is_wall(partner.body);
  const auto b = static_cast<std::size_t>(two ? partner.body : i);
  if (two) {
    inverse +=
        bodies.inverse_mass[b] + turning_part(bodies, partner.body, pose_now(bodies, partner.body),
                                              size, cross(contact.arm_b, n), response_b);
  }
  if (!(inverse > 0.0)) return 0.0;
  const double impulse = push / inverse;
  if (!own_image) bodies.flight[a].velocity -= (impulse * bodies.inverse_mass[a]) * n;
  if (!(response_a == Vec3{})) {
    bodies.set_angular(a, bodies.spin[a].angular - impulse * response_a);
  }
  if (two) {
    bodies.flight[b].velocity += (impulse * bodies.inverse_mass[b]) * n;
    if (!(response_b == Vec3{})) {
      bodies.set_angular(b, bodies.spin[b].angular + impulse * response_b);
    }
  }
  return is_wall(partner.body) ? 0.0 : impulse * dot(n, contact.between);
}

Energy energy(const Bodies& bodies, std::int32_t i, double size) {
  const auto k = static_cast<std::size_t>(i);
  const double mass = 1.0 / bodies.inverse_mass[k];
  Energy e{0.5 * mass * norm_sq(bodies.flight[k].velocity), 0.0};
  const Vec3& inverse = bodies.inverse_inertia[k];
  const Spin& spin = bodies.spin[k];
  if (inverse == Vec3{}) return e;
  if (bodies.form[k] != Form::scalene) {
    e.rotation = 0.5 * size * size * norm_sq(spin.angular) / inverse.y;
    return e;
  }
  const Vec3& second = bodies.second[k].axis;
  const Vec3 parts{dot(spin.angular, spin.axis), dot(spin.angular, second),
                   dot(spin.angular, cross(spin.axis, second))};
  e.rotation = 0.5 * size * size * dot(unscale(parts, inverse), parts);
  return e;
}

}  // namespace packstone::event_driven
