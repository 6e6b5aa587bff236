#pragma once

/// @file
/// Places of a ball on the floor that no ball tells of: for the first ones.

#include <optional>

#include "generate/advancing_layer/standing_balls.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/random.hpp"

namespace packstone::advancing_layer {

/// @tparam D  Dimension of the cell.
template <int D>
class FloorPlaces {
 public:
  FloorPlaces(const Cell& cell, RandomStream random) : cell_(cell), random_(random) {}

  /// Where the floor meets walls all around.
  std::optional<Vec3> in_corner(const StandingBalls<D>& balls, double radius) const {
    if (cell_.periodic[0] || (D == 3 && cell_.periodic[1])) return std::nullopt;
    const double beside = balls.beside_wall(radius);
    for (int corner = 0; corner < (D == 2 ? 2 : 4); ++corner) {
      Vec3 center{};
      center[kUp] = beside;
      center.x = corner % 2 == 0 ? beside : cell_.size.x - beside;
      if constexpr (D == 3) center.y = corner < 2 ? beside : cell_.size.y - beside;
      if (balls.is_clear(center, radius)) return center;
    }
    return std::nullopt;
  }

  /// Anywhere at random, where no two balls are near enough to hold a third one.
  std::optional<Vec3> anywhere(const StandingBalls<D>& balls, double radius) {
    constexpr int kTrials = 64;
    const double beside = balls.beside_wall(radius);
    for (int trial = 0; trial < kTrials; ++trial) {
      Vec3 center{};
      for (std::size_t axis = 0; axis < kUp; ++axis) {
        const double margin = cell_.periodic[axis] ? 0.0 : beside;
        center[axis] = random_.uniform(margin, cell_.size[axis] - margin);
      }
      center[kUp] = beside;
      if (balls.is_clear(center, radius)) return center;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kUp = D - 1;

  Cell cell_;
  RandomStream random_;
};

}  // namespace packstone::advancing_layer
