#pragma once

/// @file
/// The disk or ball as large as something else.

#include <cmath>
#include <numbers>

namespace packstone {

/// Radius of the disk of area `measure` (dimension 2) or of the ball of volume `measure` (3) [L].
[[nodiscard]] inline double equal_ball_radius(int dimension, double measure) noexcept {
  using std::numbers::pi;
  return dimension == 2 ? std::sqrt(measure / pi) : std::cbrt(0.75 * measure / pi);
}

}  // namespace packstone
