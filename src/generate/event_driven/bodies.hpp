#pragma once

/// @file
/// The bodies of a run, as the innermost loops want them.

#include <cmath>
#include <cstdint>
#include <vector>

#include "generate/event_driven/rotation.hpp"
#include "geometry/posed_body.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone::event_driven {

/// Where a body is and how it flies, at its own clock. One cache line.
struct alignas(64) Flight {
  Vec3 center;       ///< Not wrapped into the cell [L].
  Vec3 velocity;     ///< [L/T]
  double clock = 0;  ///< When both hold [T].
  double turn = 0;   ///< Length of Spin::angular [1/T].
};

/// How it is turned, at the same clock. One cache line.
struct alignas(64) Spin {
  Vec3 axis{0, 0, 1};  ///< Unit.
  Vec3 angular;        ///< Constant between events; perpendicular to `axis` but for scalene bodies.
  double lateral = 0;  ///< Semi-axis across `axis`; radius of ball and rods [L].
  double axial = 0;    ///< Semi-axis along `axis`; half length of rods, radius of a ball [L].
};

/// What a body with three different semi-axes has besides: its second axis. The third is across
/// both, with semi-axis Spin::lateral.
struct SecondAxis {
  Vec3 axis{1, 0, 0};
  double semi_axis = 0;  ///< [L]
};

/// All bodies. Sizes at time t are (size + growth t) times those stored.
struct Bodies {
  std::vector<Flight> flight;
  std::vector<Spin> spin;
  std::vector<SecondAxis> second;  ///< Empty where no body is scalene.
  std::vector<Form> form;
  std::vector<double> reach;  ///< Circumscribed radii at size factor 1 [L].
  std::vector<double> inverse_mass;
  /// Of the moments of inertia at size factor 1, about axis, second and third axis; 0 where the
  /// body does not turn.
  std::vector<Vec3> inverse_inertia;
  double size = 1.0;    ///< Size factor at time 0 [-].
  double growth = 0.0;  ///< [1/T]
  double min_gap = 0.0;

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(flight.size()); }
  [[nodiscard]] double size_at(double t) const { return size + growth * t; }
  /// Of scalene bodies; of others it means nothing [L].
  [[nodiscard]] double second_semi_axis(std::size_t k) const {
    return second.empty() ? 0.0 : second[k].semi_axis;
  }

  [[nodiscard]] Pose pose(std::int32_t i, double t) const {
    const auto k = static_cast<std::size_t>(i);
    const Flight& f = flight[k];
    const Spin& s = spin[k];
    const double dt = t - f.clock;
    Pose pose{f.center + dt * f.velocity, s.axis, {}};
    if (f.turn > 0.0) {
      const Rotor<double> turn = rotor(f.turn * f.turn, dt);
      pose.axis = turned(s.axis, s.angular, turn);
      if (!second.empty()) pose.second = turned(second[k].axis, s.angular, turn);
    } else if (!second.empty()) {
      pose.second = second[k].axis;
    }
    return pose;
  }

  /// Sets the angular velocity of a body.
  void set_angular(std::size_t k, const Vec3& angular) {
    spin[k].angular = angular;
    flight[k].turn = norm(angular);
  }

  /// Brings the clock of a body to t.
  void advance(std::int32_t i, double t);
};

/// Balls and spheroids alone?
[[nodiscard]] bool are_revolution(const Bodies& bodies);

/// The inverse inertia of body i, turned to `pose`, applied to a vector; at size factor `size`.
[[nodiscard]] Vec3 inverse_inertia_times(const Bodies& bodies, std::int32_t i, const Pose& pose,
                                         double size, const Vec3& torque);

/// Adds a body to `bodies`, at rest, at time 0. Mass 1.
void add_body(Bodies& bodies, const Body& body, const Vec3& center, bool turns);

/// The body as it is turned at its clock; of the given shape, whose sizes it keeps.
[[nodiscard]] Body turned_body(const Bodies& bodies, std::int32_t i, const Body& shape);

}  // namespace packstone::event_driven
