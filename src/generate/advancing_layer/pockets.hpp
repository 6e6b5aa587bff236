#pragma once

/// @file
/// The places where a ball of a given radius may rest among those that stand.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "generate/advancing_layer/anchor_queue.hpp"
#include "generate/advancing_layer/ball_levels.hpp"
#include "generate/advancing_layer/contact_arcs.hpp"
#include "generate/advancing_layer/contact_caps.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// The lowest place on one anchor.
struct Pocket {
  Vec3 center;  ///< Not wrapped into the cell [L].
  std::int32_t anchor = 0;
};

/// What balls to expect.
struct Expected {
  double smallest = 0.0;   ///< Least radius [L].
  double largest = 0.0;    ///< [L].
  double typical = 0.0;    ///< Radius of the disk or ball of mean area or volume [L].
  std::int64_t count = 0;  ///< Balls.
};

/// Which pockets to look for.
struct PocketSearch {
  double radius = 0.0;  ///< Of the ball [L].
  double from = 0.0;    ///< Height of the tops of anchors from which to look upward [L].
  int most = 1;         ///< Anchors with a place after which the search ends.
  int level = 0;        ///< Of the radius, see Pockets::remember_places().
};

/// What keeps contacts proven apart after rounding, where the largest body has the radius `largest`
/// [L].
inline double contact_slack(const Cell& cell, double largest) {
  const double edge = std::max({cell.size.x, cell.size.y, cell.size.z});
  return 32.0 * kUnitRoundoff * edge + 4e-12 * largest;
}

/// @tparam D  Dimension of the cell.
template <int D>
class Pockets {
 public:
  static constexpr std::size_t kUp = D - 1;

  /// @param min_gap  Least gap of any two balls [L].
  Pockets(const Cell& cell, const Expected& expected, double min_gap)
      : cell_(cell),
        smallest_(expected.smallest),
        largest_(expected.largest),
        slack_(contact_slack(cell, expected.largest)),
        apart_(min_gap + slack_),
        levels_(cell, std::max(expected.smallest, kFinest * expected.typical), expected.largest,
                expected.count),
        queue_(cell.size[kUp], kBin * expected.typical, expected.smallest) {}

  /// From now on radii come from a short list, numbered by PocketSearch::level: what is found on an
  /// anchor is kept, and what fails there is told for that radius alone. Before the first add().
  void remember_places() { remembers_ = true; }

  /// A ball that stands; its center lies in the cell.
  void add(const Vec3& center, double radius) {
    const std::int32_t ball = levels_.add(center, radius);
    const double top = center[kUp] + radius;
    top_ = std::max(top_, std::min(top, cell_.size[kUp]));
    queue_.add(ball, top);
    failures_.push_back(0);
    if (remembers_) known_.emplace_back();
  }

  /// Height of the highest top [L].
  [[nodiscard]] double top() const { return top_; }
  [[nodiscard]] const BallLevels<D>& balls() const { return levels_; }
  [[nodiscard]] std::int64_t tests() const { return tests_; }

  /// There is no floor any more, along a period: other balls hold those that are there.
  void open_floor() {
    if (!cell_.periodic[kUp]) return;
    floor_ = false;
    for (std::int32_t ball = 0; ball < levels_.size(); ++ball) {
      if (is_near(levels_.center(ball)[kUp], 0.0)) queue_.renew(ball);
    }
  }
  /// Forgets what failed on anchors with tops above `height`.
  void renew_above(double height) {
    for (std::int32_t ball = 0; ball < levels_.size(); ++ball) {
      if (levels_.center(ball)[kUp] + levels_.radius(ball) >= height) queue_.renew(ball);
    }
  }
  /// Whether two heights are so near that a ball may touch both, along a period in either way.
  [[nodiscard]] bool is_near(double height, double other) const {
    double apart = std::abs(height - other);
    if (cell_.periodic[kUp]) apart = std::min(apart, cell_.size[kUp] - apart);
    return apart <= 4.0 * largest_;
  }

  /// Lists the lowest place on each anchor that has one.
  void find(const PocketSearch& search, std::vector<Pocket>& found) {
    found.clear();
    queue_.walk(search.from, search.radius, [&](std::int32_t anchor, double& limit) {
      Pocket pocket{{}, anchor};
      if (remembers_ ? lowest_known(anchor, search, pocket.center)
                     : lowest(anchor, search.radius, pocket.center)) {
        found.push_back(pocket);
        return static_cast<int>(found.size()) < search.most;
      }
      limit = search.radius;
      if (!remembers_ && fails_again(anchor)) limit = failing_radius(anchor, search.radius);
      return true;
    });
  }

  /// What was found on this anchor was of no use: after a few times, nothing that may be found
  /// there is to balls of `radius` and above.
  void fail(std::int32_t anchor, double radius) {
    constexpr int kPatience = 3;
    std::uint8_t& failures = failures_[static_cast<std::size_t>(anchor)];
    if (++failures < kPatience) return;
    failures = 0;
    queue_.lower_limit(anchor, radius);
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

 private:
  using Blocked = std::conditional_t<D == 2, ContactArcs, ContactCaps>;
  // A place found, for a ball of this radius; 0: none.
  struct Known {
    Vec3 center;
    double radius = 0.0;
  };
  static constexpr std::size_t kRemembered = 4;  // Levels.

  // Radius of the finest grid over the typical one: finer grids have hardly a ball in a cell.
  static constexpr double kFinest = 0.8;
  // Height of a bin of anchors over the typical radius.
  static constexpr double kBin = 0.15;
  // Part of the slack that rounding of positions may take.
  static constexpr double kRounding = 0.25;

  [[nodiscard]] bool has_floor(std::size_t axis) const {
    return !cell_.periodic[axis] || (axis == kUp && floor_);
  }

  bool fails_again(std::int32_t anchor) {
    std::uint8_t& failures = failures_[static_cast<std::size_t>(anchor)];
    if (failures < std::numeric_limits<std::uint8_t>::max()) ++failures;
    return failures > 1;
  }

  // The place found last, while it is clear: balls that have come since take places away, and what
  // they add is hardly ever lower.
  bool lowest_known(std::int32_t anchor, const PocketSearch& search, Vec3& place) {
    const auto slot = static_cast<std::size_t>(search.level) % kRemembered;
    Known& known = known_[static_cast<std::size_t>(anchor)][slot];
    if (known.radius == search.radius && is_clear(wrapped(cell_, known.center), search.radius)) {
      place = known.center;
      return true;
    }
    const bool found = lowest(anchor, search.radius, place);
    known = {place, found ? search.radius : 0.0};
    return found;
  }

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

  // A radius that fails, near the least such: `radius` fails, smaller ones are tried. The more
  // often an anchor has failed the closer, so that balls of slowly falling size do not fail on it
  // time and again.
  double failing_radius(std::int32_t anchor, double radius) {
    constexpr double kFirstStep = 0.1;
    constexpr int kMostHalvings = 10;
    constexpr int kHalvings = 3;
    const std::uint8_t failures = failures_[static_cast<std::size_t>(anchor)];
    double step = std::ldexp(kFirstStep, -std::min<int>(failures - 2, kMostHalvings));
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
  AnchorQueue queue_;
  Blocked blocked_;
  std::vector<Neighbor> neighbors_;
  std::vector<std::uint8_t> failures_;
  bool remembers_ = false;
  std::vector<std::array<Known, kRemembered>> known_;  // By anchor and level.
  double top_ = 0.0;
  bool floor_ = true;
  std::int64_t tests_ = 0;
};

}  // namespace packstone::advancing_layer
