#pragma once

/// @file
/// Inclusions in motion: what a method that moves them needs to go on where it stopped.

#include <string>
#include <utility>
#include <vector>

#include "packstone/core/vec.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// A packing whose inclusions fly, turn and grow, all of them by one common factor.
struct MovingPacking {
  /// Centers and orientations now; sizes are those at size factor 1.
  Packing packing;
  double size_factor = 0.0;            ///< Lengths now over those of `packing` [-]. > 0.
  std::vector<Vec3> velocity;          ///< Of each center [L/T].
  std::vector<Vec3> angular_velocity;  ///< In the cell frame [1/T].
  /// Whatever else the method counts, by name; a method reads back what it wrote.
  std::vector<std::pair<std::string, double>> numbers;
};

/// The inclusions at their size now, without certificate.
[[nodiscard]] Packing at_present_size(const MovingPacking& moving);

/// Throws InvalidArgument when the packing is not well formed, the size factor is not a number > 0,
/// or there is not one finite velocity and one finite angular velocity for each inclusion.
void check_moving(const MovingPacking& moving);

}  // namespace packstone
