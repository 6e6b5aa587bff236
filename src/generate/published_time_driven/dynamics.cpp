#include "generate/published_time_driven/dynamics.hpp"

#include <algorithm>
#include <variant>

#include "packstone/geometry/equal_ball.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::time_driven {
namespace {

// Friction for a time dt as a factor on velocities, second order. Bounded on both sides, since
// thermostats know no bounds: one step neither reverses a velocity nor much more than doubles it.
double slowing(double friction, double dt) {
  const double half = 0.5 * std::clamp(friction * dt, -1.0, 1.0);
  return (1.0 - half) / (1.0 + half);
}

// A center that was pushed through a wall stays on it; the wall pushes the body back.
Vec3 inside(const Cell& cell, Vec3 center) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!cell.periodic[axis]) center[axis] = std::clamp(center[axis], 0.0, cell.size[axis]);
  }
  return wrapped(cell, center);
}

}  // namespace

double squared_size(const Packing& packing) {
  double total = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) total += volume(inclusion.body);
  const double mean = total / static_cast<double>(packing.inclusions.size());
  const double radius = equal_ball_radius(3, mean);
  return radius * radius;
}

// The Cayley form of the rotation keeps lengths and needs no sine.
Vec3 turned(const Vec3& axis, const Vec3& turn) noexcept {
  const Vec3 half = 0.5 * turn;
  const Vec3 across = cross(half, axis);
  return normalized(axis + (2.0 / (1.0 + norm_sq(half))) * (across + cross(half, across)));
}

Dynamics::Dynamics(Packing& packing, const TimeDrivenOptions& options)
    : packing_(packing),
      options_(options),
      interactions_(packing, options.literal),
      flights_(packing.inclusions.size()),
      squared_size_(squared_size(packing)) {
  for (const Inclusion& inclusion : packing.inclusions) {
    degrees_of_freedom_ += std::holds_alternative<Sphere>(inclusion.body) ? 3.0 : 5.0;
  }
  interactions_.evaluate(packing_.inclusions, loads_);
}

void Dynamics::step() {
  const double dt = options_.time_step;
  update_friction();
  if (options_.integrator == TimeDrivenIntegrator::leapfrog) {
    kick(dt);
    drift(dt);
    interactions_.evaluate(packing_.inclusions, loads_);
    return;
  }
  kick(0.5 * dt);
  drift(dt);
  interactions_.evaluate(packing_.inclusions, loads_);
  kick(0.5 * dt);
}

void Dynamics::switch_nose_hoover(bool on) {
  nose_hoover_on_ = on;
  nose_hoover_friction_ = 0.0;
}

// The moment of inertia of a cylinder is |l|^2 / 6, equation (1).
double Dynamics::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < flights_.size(); ++k) {
    sum += norm_sq(flights_[k].velocity);
    if (const auto* cylinder = std::get_if<Cylinder>(&packing_.inclusions[k].body)) {
      const double inertia = cylinder->half_length * cylinder->half_length / 6.0;
      sum += inertia * norm_sq(flights_[k].angular_velocity);
    }
  }
  return 0.5 * sum;
}

// Equations (2) and (3), energies in units of R^2 / T^2.
void Dynamics::update_friction() {
  const double energy = kinetic_energy() / squared_size_;
  const auto excess = [&](double temperature) {
    return energy - 0.5 * degrees_of_freedom_ * temperature;
  };
  if (nose_hoover_on_) {
    nose_hoover_friction_ +=
        options_.time_step * options_.nose_hoover * excess(options_.nose_hoover_temperature);
  }
  friction_ = options_.berendsen * excess(options_.berendsen_temperature) + nose_hoover_friction_;
}

void Dynamics::kick(double dt) {
  const double keep = slowing(options_.damping + friction_, dt);
  const double push = dt * force_factor_;
  for (std::size_t k = 0; k < flights_.size(); ++k) {
    Flight& flight = flights_[k];
    flight.velocity = keep * flight.velocity + push * loads_.force[k];
    if (const auto* cylinder = std::get_if<Cylinder>(&packing_.inclusions[k].body)) {
      const double per_inertia = 6.0 / (cylinder->half_length * cylinder->half_length);
      flight.angular_velocity =
          keep * flight.angular_velocity + (push * per_inertia) * loads_.torque[k];
    }
  }
}

void Dynamics::drift(double dt) {
  for (std::size_t k = 0; k < flights_.size(); ++k) {
    Inclusion& inclusion = packing_.inclusions[k];
    inclusion.center = inside(packing_.cell, inclusion.center + dt * flights_[k].velocity);
    if (auto* cylinder = std::get_if<Cylinder>(&inclusion.body)) {
      cylinder->axis = turned(cylinder->axis, dt * flights_[k].angular_velocity);
    }
  }
}

}  // namespace packstone::time_driven
