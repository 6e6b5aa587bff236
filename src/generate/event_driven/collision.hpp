#pragma once

/// @file
/// What a collision does to the velocities.
///
/// Hard smooth bodies exchange momentum J along the normal n of their contact. With arms p from the
/// centers and w the speed at which the surfaces come together, growth included,
///
///     J = (1 + e) w / (1/m_a + 1/m_b + k_a.I_a^-1 k_a + k_b.I_b^-1 k_b),   k = p x n         (1)
///
/// leaves them apart at e w. A body that meets its own image gets J at both of its ends: its center
/// keeps its velocity, and k = (p_a - p_b) x n. The surface of a growing body moves at ds/dt times
/// its support function, so that collisions at e = 1 heat a gas that grows. Those that are fast
/// beside the growth speed u are given e = 1 - 2 u / w, which leaves the energy as it is; slow ones
/// must keep e = 1, or bodies would be pressed together in ever faster collisions.

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/contact_search.hpp"

namespace packstone::event_driven {

/// Changes the velocities of body i and its partner, whose clocks stand at t. Returns J n.r, with r
/// from center to center: what the collision adds to the virial [m L^2/T]; 0 for walls.
double collide(Bodies& bodies, std::int32_t i, const Partner& partner, const Contact& contact,
               double t);

/// Translational and rotational energy of body i at its clock, size factor `size`.
struct Energy {
  double translation = 0.0;
  double rotation = 0.0;
};
[[nodiscard]] Energy energy(const Bodies& bodies, std::int32_t i, double size);

}  // namespace packstone::event_driven
