#include "packstone/generate/published_event_driven.hpp"

namespace packstone {

MovingEllipsoid published_moved(const MovingEllipsoid& moving, double dt) noexcept {
  MovingEllipsoid later = moving;
  later.center += dt * moving.velocity;
  later.semi_axes += dt * moving.growth;
  const double speed = norm(moving.angular_velocity);
  if (speed > 0.0) {  // Equation (10) divides by it.
    const Quaternion turn = from_axis_angle(moving.angular_velocity / speed, speed * dt);
    later.orientation = normalized(turn * moving.orientation);
  }
  return later;
}

}  // namespace packstone
