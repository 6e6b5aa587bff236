#pragma once

/// @file
/// From the center of one inclusion to that of another's image, and what rounding did to it.

#include <array>
#include <cmath>

#include "packstone/core/cell.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A vector between centers, as pair kernels take it.
struct Separation {
  Vec3 r_ab;           ///< Center of the image of b minus center of a [L].
  double error = 0.0;  ///< Bound on the length of the error of r_ab by rounding [L].
};

/// The separation of a and the image of b that is shifted by whole periods.
///
/// Rounding: one unit each for the difference of centers, for the shift and for their sum, along
/// every axis. A gap changes by no more than the centers move, so the bodies are apart for certain
/// if decide(a, b, r_ab, error) says so: cell coordinates of double resolution are then enough for
/// bodies of any smallness.
inline Separation separation(const Cell& cell, const Vec3& center_a, const Vec3& center_b,
                             const std::array<int, 3>& image) {
  const Vec3 difference = center_b - center_a;
  const Vec3 shift = image_shift(cell, image);
  const Vec3 r_ab = difference + shift;
  double error = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    error += std::abs(difference[axis]) + std::abs(shift[axis]) + std::abs(r_ab[axis]);
  }
  // A little more than one unit each, for the rounding of this very sum.
  return {r_ab, 1.001 * kUnitRoundoff * error};
}

}  // namespace packstone
