#pragma once

/// @file
/// Bodies under forces, friction and thermostats: equations (1) to (3) of
/// published_time_driven.hpp.

#include <cstddef>
#include <vector>

#include "generate/published_time_driven/interactions.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::time_driven {

/// How a body moves.
struct Flight {
  Vec3 velocity{};          ///< [L/T]
  Vec3 angular_velocity{};  ///< [rad/T]; of spheres 0.
};

/// R^2, by which the thermostats and the threshold measure energies: R is the radius of the ball of
/// mean volume [L^2].
[[nodiscard]] double squared_size(const Packing& packing);

/// `axis` turned by the rotation vector `turn` [rad], to second order in its length, exactly unit.
[[nodiscard]] Vec3 turned(const Vec3& axis, const Vec3& turn) noexcept;

/// The packing in motion, all bodies at rest at first.
class Dynamics {
 public:
  /// Keeps references to both.
  Dynamics(Packing& packing, const TimeDrivenOptions& options);

  /// One step of time.
  void step();

  /// Switches the Nose-Hoover thermostat; gamma_NH starts at 0 each time.
  void switch_nose_hoover(bool on);

  void set_force_factor(double factor) { force_factor_ = factor; }
  [[nodiscard]] double force_factor() const { return force_factor_; }
  [[nodiscard]] double potential_energy() const { return loads_.energy; }
  [[nodiscard]] double kinetic_energy() const;
  /// N.
  [[nodiscard]] double degrees_of_freedom() const { return degrees_of_freedom_; }
  /// gamma of equation (2), in the last step.
  [[nodiscard]] double friction() const { return friction_; }
  [[nodiscard]] std::vector<Flight>& flights() { return flights_; }

 private:
  void update_friction();
  void kick(double dt);
  void drift(double dt);

  Packing& packing_;
  const TimeDrivenOptions& options_;
  Interactions interactions_;
  Loads loads_;
  std::vector<Flight> flights_;
  double degrees_of_freedom_ = 0.0;
  double squared_size_;
  double force_factor_ = 1.0;
  double friction_ = 0.0;
  double nose_hoover_friction_ = 0.0;
  bool nose_hoover_on_ = false;
};

}  // namespace packstone::time_driven
