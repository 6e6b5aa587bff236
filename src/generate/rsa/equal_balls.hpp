#pragma once

/// @file
/// Random sequential adsorption of equal balls: disks in a 2D cell, spheres in a 3D one.

#include <cstdint>
#include <limits>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/generate/rsa.hpp"

namespace packstone::rsa {

/// What rsa_equal_balls() is to place.
struct EqualBallsOrder {
  Cell cell;             ///< Balls stay inside the walls and meet their images along periods.
  double radius = 0.0;   ///< [L] > 0.
  double min_gap = 0.0;  ///< Least gap of two balls, images included [L]. >= 0.
  /// Balls wanted [-]. >= 0. As it stands: as many as fit.
  std::int64_t target = std::numeric_limits<std::int64_t>::max();
  std::uint64_t seed = 0;   ///< Key of the streams rsa_center and rsa_voxel.
  std::uint64_t start = 0;  ///< Which fresh start this is: each has numbers of its own.
};

/// What it placed.
struct EqualBallsRun {
  std::vector<Vec3> centers;  ///< In the order placed.
  /// target_reached; saturated: proven, no position is left; given_up: room smaller than the
  /// spacing of doubles is left undecided; cancelled; out_of_time.
  RsaStop stop = RsaStop::target_reached;
  std::int64_t trials = 0;  ///< Positions tried.
};

/// Places balls one by one, each uniformly in the room that the earlier ones left.
///
/// The sequence of centers is that of random sequential adsorption, exactly: see
/// docs/algorithms/rsa_saturation.md. Depends on the order alone, not on run.threads().
///
/// Errors:  throws InvalidArgument, before any work, if the order is out of range or one ball
/// cannot
///          stand in the cell even alone.
/// Cost:    proportional to the volume of the cell over that of a ball.
[[nodiscard]] EqualBallsRun rsa_equal_balls(const EqualBallsOrder& order, RunContext run = {});

}  // namespace packstone::rsa
