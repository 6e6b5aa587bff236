#pragma once

/// @file
/// Turning at constant angular velocity, in + - * alone: the same bits on every processor, for
/// numbers as for lanes of them.

#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// Most that a body may turn between two looks at it [rad].
inline constexpr double kMostTurn = 1.0;

/// sin(w t) / w and (1 - cos(w t)) / w^2, by their series: for w t up to kMostTurn the first term
/// left out is below 1e-17.
template <class Number>
struct Rotor {
  Number sine;
  Number versine;
};

/// The sums are taken pairwise, so that their terms do not wait for each other.
template <class Number>
[[gnu::always_inline]] inline Rotor<Number> rotor(const Number& angular_sq, const Number& t) {
  const Number x = angular_sq * t * t;
  const Number x2 = x * x, x4 = x2 * x2;
  const Number sine_low = (1.0 - x * (1.0 / 6.0)) + x2 * (1.0 / 120.0 - x * (1.0 / 5040.0));
  const Number sine_high = (1.0 / 362880.0 - x * (1.0 / 39916800.0)) +
                           x2 * (1.0 / 6227020800.0 - x * (1.0 / 1307674368000.0));
  const Number sine = sine_low + x4 * (sine_high + x4 * (1.0 / 355687428096000.0));
  const Number versine_low = (0.5 - x * (1.0 / 24.0)) + x2 * (1.0 / 720.0 - x * (1.0 / 40320.0));
  const Number versine_high = (1.0 / 3628800.0 - x * (1.0 / 479001600.0)) +
                              x2 * (1.0 / 87178291200.0 - x * (1.0 / 20922789888000.0));
  const Number versine = versine_low + x4 * (versine_high + x4 * (1.0 / 6402373705728000.0));
  return {t * sine, t * t * versine};
}

/// `u` after a turn: u + (sin / w) w x u + ((1 - cos) / w^2) w x (w x u).
inline Vec3 turned(const Vec3& u, const Vec3& angular, const Rotor<double>& rotor) {
  const Vec3 first = cross(angular, u);
  return u + rotor.sine * first + rotor.versine * cross(angular, first);
}

}  // namespace packstone::event_driven
