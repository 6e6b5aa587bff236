#pragma once

/// @file
/// The lowest places for a ball of a given radius among those that stand.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "generate/advancing_layer/anchor_queue.hpp"
#include "generate/advancing_layer/standing_balls.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// The lowest place on one anchor.
struct Pocket {
  Vec3 center;  ///< Not wrapped into the cell [L].
  std::int32_t anchor = 0;
};

/// Which pockets to look for.
struct PocketSearch {
  double radius = 0.0;  ///< Of the ball [L].
  double from = 0.0;    ///< Height of the tops of anchors from which to look upward [L].
  int most = 1;         ///< Anchors with a place after which the search ends.
  int level = 0;        ///< Of the radius, see Pockets::remember_places().
};

/// @tparam D  Dimension of the cell.
template <int D>
class Pockets {
 public:
  static constexpr std::size_t kUp = D - 1;

  /// @param min_gap  Least gap of any two balls [L].
  Pockets(const Cell& cell, const Expected& expected, double min_gap)
      : cell_(cell),
        balls_(cell, expected, min_gap),
        queue_(cell.size[kUp], kBin * expected.typical, expected.smallest) {}

  /// From now on radii come from a short list, numbered by PocketSearch::level: what is found on an
  /// anchor is kept, and what fails there is told for that radius alone. Before the first add().
  void remember_places() { remembers_ = true; }

  /// A ball that stands; its center lies in the cell.
  void add(const Vec3& center, double radius) {
    queue_.add(balls_.add(center, radius), center[kUp] + radius);
    failures_.push_back(0);
    if (remembers_) known_.emplace_back();
  }

  [[nodiscard]] const StandingBalls<D>& balls() const { return balls_; }

  /// There is no floor any more, along a period: other balls hold those that are there.
  void open_floor() {
    if (!cell_.periodic[kUp]) return;
    balls_.open_floor();
    for (std::int32_t ball = 0; ball < balls_.size(); ++ball) {
      if (balls_.is_near(balls_.center(ball)[kUp], 0.0)) queue_.renew(ball);
    }
  }
  /// Forgets what failed on anchors with tops above `height`.
  void renew_above(double height) {
    for (std::int32_t ball = 0; ball < balls_.size(); ++ball) {
      if (balls_.center(ball)[kUp] + balls_.radius(ball) >= height) queue_.renew(ball);
    }
  }

  /// Lists the lowest place on each anchor that has one.
  void find(const PocketSearch& search, std::vector<Pocket>& found) {
    found.clear();
    queue_.walk(search.from, search.radius, [&](std::int32_t anchor, double& limit) {
      Pocket pocket{{}, anchor};
      if (remembers_ ? lowest_known(anchor, search, pocket.center)
                     : balls_.lowest(anchor, search.radius, pocket.center)) {
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

 private:
  // A place found, for a ball of this radius; 0: none.
  struct Known {
    Vec3 center;
    double radius = 0.0;
  };
  static constexpr std::size_t kRemembered = 4;  // Levels.

  // Height of a bin of anchors over the typical radius.
  static constexpr double kBin = 0.15;

  bool fails_again(std::int32_t anchor) {
    std::uint8_t& failures = failures_[static_cast<std::size_t>(anchor)];
    if (failures < std::numeric_limits<std::uint8_t>::max()) ++failures;
    return failures > 1;
  }

  // The more often an anchor has failed the closer, so that balls of slowly falling size do not
  // fail on it time and again.
  double failing_radius(std::int32_t anchor, double radius) {
    constexpr double kFirstStep = 0.1;
    constexpr int kMostHalvings = 10;
    const std::uint8_t failures = failures_[static_cast<std::size_t>(anchor)];
    const int halvings = std::min<int>(failures - 2, kMostHalvings);
    return balls_.failing_radius(anchor, radius, std::ldexp(kFirstStep, -halvings));
  }

  // The place found last, while it is clear: balls that have come since take places away, and what
  // they add is hardly ever lower.
  bool lowest_known(std::int32_t anchor, const PocketSearch& search, Vec3& place) {
    const auto slot = static_cast<std::size_t>(search.level) % kRemembered;
    Known& known = known_[static_cast<std::size_t>(anchor)][slot];
    if (known.radius == search.radius &&
        balls_.is_clear(wrapped(cell_, known.center), search.radius)) {
      place = known.center;
      return true;
    }
    const bool found = balls_.lowest(anchor, search.radius, place);
    known = {place, found ? search.radius : 0.0};
    return found;
  }

  Cell cell_;
  StandingBalls<D> balls_;
  AnchorQueue queue_;
  std::vector<std::uint8_t> failures_;
  bool remembers_ = false;
  std::vector<std::array<Known, kRemembered>> known_;  // By anchor and level.
};

}  // namespace packstone::advancing_layer
