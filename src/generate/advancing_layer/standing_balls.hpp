#pragma once

/// @file
/// Balls that stand, and the places on one of them where another may rest.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "generate/advancing_layer/ball_levels.hpp"
#include "generate/advancing_layer/contact_arcs.hpp"
#include "generate/advancing_layer/contact_caps.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// What balls to expect.
struct Expected {
  double smallest = 0.0;   ///< Least radius [L].
  double largest = 0.0;    ///< [L].
  double typical = 0.0;    ///< Radius of the disk or ball of mean area or volume [L].
  std::int64_t count = 0;  ///< Balls.
};

/// What keeps contacts proven apart after rounding, where the largest body has the radius `largest`
/// [L].
inline double contact_slack(const Cell& cell, double largest) {
  const double edge = std::max({cell.size.x, cell.size.y, cell.size.z});
  return 32.0 * kUnitRoundoff * edge + 4e-12 * largest;
}

/// @tparam D  Dimension of the cell.
template <int D>
class StandingBalls {
 public:
  static constexpr std::size_t kUp = D - 1;

  /// @param min_gap  Least gap of any two balls [L].
  StandingBalls(const Cell& cell, const Expected& expected, double min_gap)
      : cell_(cell),
        smallest_(expected.smallest),
        largest_(expected.largest),
        slack_(contact_slack(cell, expected.largest)),
        apart_(min_gap + slack_),
        levels_(cell, std::max(expected.smallest, kFinest * expected.typical), expected.largest,
                expected.count) {}

  /// A ball that stands; its center lies in the cell. Returns its number.
  std::int32_t add(const Vec3& center, double radius) {
    top_ = std::max(top_, std::min(center[kUp] + radius, cell_.size[kUp]));
    return levels_.add(center, radius);
  }

  [[nodiscard]] std::int32_t size() const { return levels_.size(); }
  [[nodiscard]] const Vec3& center(std::int32_t ball) const { return levels_.center(ball); }
  [[nodiscard]] double radius(std::int32_t ball) const { return levels_.radius(ball); }
  /// Height of the highest top [L].
  [[nodiscard]] double top() const { return top_; }
  [[nodiscard]] std::int64_t tests() const { return tests_; }

  /// There is no floor any more, along a period: other balls hold those that are there.
  void open_floor() { floor_ = floor_ && !cell_.periodic[kUp]; }

  /// Whether two heights are so near that a ball may touch both, along a period in either way.
  [[nodiscard]] bool is_near(double height, double other) const {
    double apart = std::abs(height - other);
    if (cell_.periodic[kUp]) apart = std::min(apart, cell_.size[kUp] - apart);
    return apart <= 4.0 * largest_;
  }

  /// Calls visit(center) for all places of a ball on `anchor`.
  template <class Visit>
  void visit_places(std::int32_t anchor, double radius, Visit&& visit) {
    double rho = 0.0;
    if (!block_around(anchor, radius, rho)) return;
    const Vec3& center = levels_.center(anchor);
    blocked_.visit_ends([](const Vec3&) { return true; },
                        [&](const Vec3& e) { visit(center + rho * e); });
  }

  /// Distance to a wall at which a ball touches it [L].
  [[nodiscard]] double beside_wall(double radius) const { return radius + slack_; }

  /// Whether a ball overlaps nothing, walls included.
  [[nodiscard]] bool is_clear(const Vec3& center, double radius) const {
    const double to_wall = radius + (1.0 - kRounding) * slack_;
    for (std::size_t axis = 0; axis < D; ++axis) {
      if (has_floor(axis) && center[axis] < to_wall) return false;
      if (!cell_.periodic[axis] && center[axis] > cell_.size[axis] - to_wall) return false;
    }
    const double keep = radius + apart_ - kRounding * slack_;
    return levels_.near(center, keep, [&](std::int32_t, const Vec3& r, double other) {
      const double least = keep + other;
      return norm_sq(r) >= least * least;
    });
  }

  /// The lowest place of a ball on `anchor` [L], not wrapped into the cell. Returns whether there
  /// is one.
  bool lowest(std::int32_t anchor, double radius, Vec3& place) {
    double rho = 0.0;
    if (!block_around(anchor, radius, rho)) return false;
    double least = std::numeric_limits<double>::infinity();
    Vec3 best;
    blocked_.visit_ends([&](const Vec3& e) { return e[kUp] < least; },
                        [&](const Vec3& e) {
                          least = e[kUp];
                          best = e;
                        });
    place = levels_.center(anchor) + rho * best;
    return std::isfinite(least);
  }

  /// A radius that fails on `anchor`, near the least such [L].
  ///
  /// @param radius  Fails [L]; smaller ones are tried,
  /// @param step    the first one smaller by this part of it [-].
  double failing_radius(std::int32_t anchor, double radius, double step) {
    constexpr int kHalvings = 3;
    double fails = radius;
    double fits = fails - step * radius;
    gather(anchor, radius);
    while (fits > smallest_ && !has_place(anchor, fits)) {
      fails = fits;
      step *= 2.0;
      fits = fails - step * radius;
    }
    if (!(fits > smallest_)) return std::min(fails, smallest_);
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (fits + fails);
      (has_place(anchor, middle) ? fits : fails) = middle;
    }
    return fails;
  }

 private:
  using Blocked = std::conditional_t<D == 2, ContactArcs, ContactCaps>;

  // Radius of the finest grid over the typical one: finer grids have hardly a ball in a cell.
  static constexpr double kFinest = 0.8;
  // Part of the slack that rounding of positions may take.
  static constexpr double kRounding = 0.25;

  [[nodiscard]] bool has_floor(std::size_t axis) const {
    return !cell_.periodic[axis] || (axis == kUp && floor_);
  }

  // Another ball, as an anchor sees it.
  struct Neighbor {
    Vec3 direction;  // Unit.
    double distance_sq;
    double per_distance;
    double radius;
  };

  // Where the center of a ball of one radius may be that touches an anchor.
  struct Shell {
    double rho;   // Radius of the shell.
    double keep;  // From the center to the surface of another ball.

    [[nodiscard]] bool is_met_by(double distance_sq, double radius) const {
      const double reach = rho + keep + radius;
      return distance_sq < reach * reach;
    }
    // Cosine of half the opening of what a neighbor blocks, as contact_arcs.hpp (1).
    [[nodiscard]] double rim(const Neighbor& k) const {
      const double s = keep + k.radius;
      return (rho * rho + k.distance_sq - s * s) * (0.5 / rho * k.per_distance);
    }
  };
  [[nodiscard]] Shell shell(std::int32_t anchor, double radius) const {
    return {levels_.radius(anchor) + radius + apart_, radius + apart_};
  }

  // Calls visit(neighbor) for what a ball of this radius on the anchor may touch, until it returns
  // false.
  template <class Visit>
  bool visit_neighbors(std::int32_t anchor, const Shell& of, Visit&& visit) const {
    return levels_.near(
        levels_.center(anchor), of.rho + of.keep,
        [&](std::int32_t ball, const Vec3& r, double radius) {
          const double distance_sq = norm_sq(r);
          if (!of.is_met_by(distance_sq, radius)) return true;
          if (ball == anchor && distance_sq == 0.0) return true;
          const double per_distance = 1.0 / std::sqrt(distance_sq);
          return visit(Neighbor{per_distance * r, distance_sq, per_distance, radius});
        });
  }

  // Blocks what walls and balls block for a ball on `anchor`. False where nothing is left.
  bool block_around(std::int32_t anchor, double radius, double& rho) {
    ++tests_;
    blocked_.clear();
    const Shell of = shell(anchor, radius);
    rho = of.rho;
    return block_walls(levels_.center(anchor), radius, rho) &&
           visit_neighbors(anchor, of, [&](const Neighbor& k) {
             return blocked_.block(k.direction, of.rim(k));
           });
  }

  // The neighbors of all balls of up to this radius, for has_place().
  void gather(std::int32_t anchor, double radius) {
    neighbors_.clear();
    visit_neighbors(anchor, shell(anchor, radius), [&](const Neighbor& k) {
      neighbors_.push_back(k);
      return true;
    });
  }

  // Whether there is a place on the anchor whose neighbors are gathered.
  bool has_place(std::int32_t anchor, double radius) {
    ++tests_;
    blocked_.clear();
    const Shell of = shell(anchor, radius);
    if (!block_walls(levels_.center(anchor), radius, of.rho)) return false;
    for (const Neighbor& k : neighbors_) {
      if (of.is_met_by(k.distance_sq, k.radius) && !blocked_.block(k.direction, of.rim(k))) {
        return false;
      }
    }
    bool found = false;
    blocked_.visit_ends([&](const Vec3&) { return !found; }, [&](const Vec3&) { found = true; });
    return found;
  }

  bool block_walls(const Vec3& center, double radius, double rho) {
    const double to_wall = beside_wall(radius);
    for (std::size_t axis = 0; axis < D; ++axis) {
      Vec3 n{};
      n[axis] = -1.0;
      if (has_floor(axis) && !blocked_.block(n, (center[axis] - to_wall) / rho)) return false;
      if (cell_.periodic[axis]) continue;
      n[axis] = 1.0;
      const double room = cell_.size[axis] - to_wall - center[axis];
      if (!blocked_.block(n, room / rho)) return false;
    }
    return true;
  }

  Cell cell_;
  double smallest_;
  double largest_;
  double slack_;
  double apart_;  // Of the surfaces of balls that touch.
  BallLevels<D> levels_;
  Blocked blocked_;
  std::vector<Neighbor> neighbors_;
  double top_ = 0.0;
  bool floor_ = true;
  std::int64_t tests_ = 0;
};

}  // namespace packstone::advancing_layer
