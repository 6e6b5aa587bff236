#pragma once

/// @file
/// Balls of very unequal sizes, found by place over all periodic images.
///
/// A grid per size: level k holds the radii in (R / 2^(k+1), R / 2^k], R the largest, in grid cells
/// of edge 2 R / 2^k. A search looks at each level only as far as balls of that level reach. Center
/// and radius lie in the list itself, as a search does little else than compare distances.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// @tparam D  Dimension of the cell.
template <int D>
class BallLevels {
 public:
  /// @param smallest, largest  Radii that are expected [L] > 0; others are found as well, slower.
  /// @param count              Balls that are expected.
  BallLevels(const Cell& cell, double smallest, double largest, std::int64_t count) : cell_(cell) {
    balls_.reserve(static_cast<std::size_t>(count));
    const double most = 4.0 * static_cast<double>(count) + 64.0;
    for (double radius = largest; levels_.empty() || radius >= smallest; radius *= 0.5) {
      Level level = level_for(radius);
      if (!levels_.empty() && static_cast<double>(level.heads.size()) > most) break;
      levels_.push_back(std::move(level));
      if (levels_.size() == kMostLevels) break;
    }
  }

  [[nodiscard]] std::int32_t size() const noexcept {
    return static_cast<std::int32_t>(balls_.size());
  }
  [[nodiscard]] const Vec3& center(std::int32_t ball) const noexcept {
    return balls_[static_cast<std::size_t>(ball)].center;
  }
  [[nodiscard]] double radius(std::int32_t ball) const noexcept {
    return balls_[static_cast<std::size_t>(ball)].radius;
  }

  /// Stores a ball whose center lies in the cell; returns its number.
  std::int32_t add(const Vec3& center, double radius) {
    std::size_t k = 0;
    while (k + 1 < levels_.size() && radius <= levels_[k + 1].largest) ++k;
    Level& level = levels_[k];
    level.reach = std::max(level.reach, radius);
    std::size_t slot = 0;
    for (std::size_t axis = D; axis-- > 0;) {
      const int n = level.dims[axis];
      slot = slot * static_cast<std::size_t>(n) +
             static_cast<std::size_t>(
                 std::clamp(static_cast<int>(center[axis] * level.per_length[axis]), 0, n - 1));
    }
    const std::int32_t ball = size();
    balls_.push_back({center, radius, level.heads[slot]});
    level.heads[slot] = ball;
    return ball;
  }

  /// Calls visit(ball, r, radius) for every image of a stored ball whose surface comes within
  /// `reach` of p [L], r from p to its center, and for some more; until it returns false. Returns
  /// whether all returned true.
  template <class Visit>
  bool near(const Vec3& p, double reach, Visit&& visit) const {
    for (const Level& level : levels_) {
      if (level.reach > 0.0 && !near_on(level, p, reach + level.reach, visit)) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t kMostLevels = 24;

  struct Ball {
    Vec3 center;
    double radius;
    std::int32_t next;  // In the same grid cell; -1: none.
  };
  struct Level {
    double largest = 0.0;  // Radii that belong here are not above.
    double reach = 0.0;    // Largest radius stored.
    std::array<int, D> dims{};
    std::array<double, D> per_length{};
    std::vector<std::int32_t> heads;  // By grid cell, x fastest.
  };
  // Grid cells along one axis, not wrapped; the first one is in period `image` at index `wrapped`.
  struct Range {
    int first = 0, last = 0;
    int wrapped = 0;
    double shift = 0.0;
  };

  [[nodiscard]] Level level_for(double largest) const {
    Level level;
    level.largest = largest;
    std::size_t cells = 1;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double count = std::floor(cell_.size[axis] / (2.0 * largest));
      level.dims[axis] = static_cast<int>(std::clamp(count, 1.0, 65536.0));
      level.per_length[axis] = level.dims[axis] / cell_.size[axis];
      cells *= static_cast<std::size_t>(level.dims[axis]);
    }
    level.heads.assign(cells, -1);
    return level;
  }

  static int floor_of(double x) {
    const int i = static_cast<int>(x);
    return i - static_cast<int>(x < i);
  }

  [[nodiscard]] Range range_of(const Level& level, double x, double reach, std::size_t axis) const {
    const int n = level.dims[axis];
    Range range;
    range.first = floor_of((x - reach) * level.per_length[axis]);
    range.last = floor_of((x + reach) * level.per_length[axis]);
    if (!cell_.periodic[axis]) {
      range.first = std::clamp(range.first, 0, n - 1);
      range.last = std::clamp(range.last, 0, n - 1);
      range.wrapped = range.first;
      return range;
    }
    const int image = range.first >= 0 ? range.first / n : -((n - 1 - range.first) / n);
    range.wrapped = range.first - image * n;
    range.shift = image * cell_.size[axis];
    return range;
  }

  // The next grid cell along an axis.
  void advance(const Level& level, std::size_t axis, int& wrapped, double& shift) const {
    if (++wrapped < level.dims[axis]) return;
    wrapped = 0;
    shift += cell_.size[axis];
  }

  template <class Visit>
  bool near_on(const Level& level, const Vec3& p, double reach, Visit& visit) const {
    const Range x = range_of(level, p.x, reach, 0);
    const Range y = range_of(level, p.y, reach, 1);
    if constexpr (D == 2) {
      return near_in_plane(level, p, x, y, 0, 0.0, visit);
    } else {
      const Range z = range_of(level, p.z, reach, 2);
      int at = z.wrapped;
      double shift = z.shift;
      for (int k = z.first; k <= z.last; ++k) {
        const auto plane = static_cast<std::size_t>(at) * static_cast<std::size_t>(level.dims[1]);
        if (!near_in_plane(level, p, x, y, plane, shift, visit)) return false;
        advance(level, 2, at, shift);
      }
      return true;
    }
  }

  template <class Visit>
  bool near_in_plane(const Level& level, const Vec3& p, const Range& x, const Range& y,
                     std::size_t plane, double shift_z, Visit& visit) const {
    int j = y.wrapped;
    double shift_y = y.shift;
    for (int k = y.first; k <= y.last; ++k) {
      const std::int32_t* row = level.heads.data() + (plane + static_cast<std::size_t>(j)) *
                                                         static_cast<std::size_t>(level.dims[0]);
      if (!near_in_row(level, row, x, {p.x, p.y - shift_y, p.z - shift_z}, visit)) return false;
      advance(level, 1, j, shift_y);
    }
    return true;
  }

  template <class Visit>
  bool near_in_row(const Level& level, const std::int32_t* row, const Range& x, const Vec3& p,
                   Visit& visit) const {
    int i = x.wrapped;
    double shift = x.shift;
    for (int k = x.first; k <= x.last; ++k) {
      for (std::int32_t at = row[i]; at >= 0;) {
        const Ball& ball = balls_[static_cast<std::size_t>(at)];
        const Vec3 r{ball.center.x - (p.x - shift), ball.center.y - p.y, ball.center.z - p.z};
        if (!visit(at, r, ball.radius)) return false;
        at = ball.next;
      }
      advance(level, 0, i, shift);
    }
    return true;
  }

  Cell cell_;
  std::vector<Ball> balls_;
  std::vector<Level> levels_;
};

}  // namespace packstone::advancing_layer
