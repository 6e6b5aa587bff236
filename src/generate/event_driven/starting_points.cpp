#include "generate/event_driven/starting_points.hpp"

#include <algorithm>
#include <cmath>

#include "generate/event_driven/neighborhoods.hpp"
#include "generate/event_driven/run_state.hpp"
#include "generate/ordered_bodies.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::event_driven {
namespace {

// Uniform in the cell, away from its walls by a part of its edges.
Vec3 random_point(const Cell& cell, std::uint64_t seed, std::size_t item, std::uint64_t trial) {
  constexpr double kFromWall = 1e-3;
  RandomStream random(seed, StreamId::event_driven_centers, item, trial);
  Vec3 point;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    const double margin = cell.periodic[a] ? 0.0 : kFromWall;
    point[a] = cell.size[a] * random.uniform(margin, 1.0 - margin);
  }
  return point;
}

Packing at_random_points(const Cell& cell, const std::vector<OrderedBody>& bodies,
                         std::uint64_t seed) {
  std::vector<Vec3> points(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) points[k] = random_point(cell, seed, k, 0);
  return packing_at(cell, bodies, points);
}

// Random places at which bodies of one size factor do not touch.
class Placement {
 public:
  Placement(MovingPacking& state, const EventDrivenOptions& options)
      : cell_(state.packing.cell),
        inclusions_(state.packing.inclusions),
        seed_(options.seed),
        bodies_(bodies_of(state, options)),
        standing_(bodies_, cell_),
        grid_(cell_) {
    // Rounding of the capsules in the grid, and the gap that counts as contact.
    margin_ = 1e-9 * std::max({cell_.size.x, cell_.size.y, cell_.size.z});
    std::vector<Capsule> capsules;
    for (std::int32_t i = 0; i < bodies_.count(); ++i) {
      standing_.set(i, 0.0, margin_);
      capsules.push_back(standing_.capsule(i));
    }
    grid_.reset(capsules);
  }

  // Whether all have found one.
  bool place_all() {
    constexpr std::uint64_t kTrials = 20;
    for (std::int32_t i = 0; i < bodies_.count(); ++i) {
      bool placed = false;
      for (std::uint64_t trial = 0; trial < kTrials && !placed; ++trial) placed = try_at(i, trial);
      if (!placed) return false;
    }
    return true;
  }

 private:
  bool try_at(std::int32_t i, std::uint64_t trial) {
    const auto k = static_cast<std::size_t>(i);
    bodies_.flight[k].center = random_point(cell_, seed_, k, trial);
    standing_.set(i, 0.0, margin_);
    for (int axis = 0; axis < cell_.dimension; ++axis) {
      if (cell_.periodic[static_cast<std::size_t>(axis)]) continue;
      if (std::min(standing_.wall_gap(i, axis, false), standing_.wall_gap(i, axis, true)) <=
          margin_) {
        return false;
      }
    }
    near_.clear();
    grid_.query(standing_.capsule(i), scratch_,
                [&](std::int32_t j, const CapsuleGrid::Image& image) {
                  near_.push_back(standing_.neighbor(i, j, image));
                  return true;
                });
    standing_.keep_near(i, near_);
    if (!near_.empty()) return false;
    grid_.insert(i, standing_.capsule(i));
    inclusions_[k].center = bodies_.flight[k].center;
    return true;
  }

  const Cell& cell_;
  std::vector<Inclusion>& inclusions_;
  std::uint64_t seed_;
  Bodies bodies_;
  Neighborhoods standing_;
  CapsuleGrid grid_;
  CapsuleGrid::Scratch scratch_;
  double margin_ = 0.0;
  std::vector<Neighbor> near_;
};

// Sets centers and size factor of `state`, as large as chance allows without much trying.
void place_at_random(MovingPacking& state, const EventDrivenOptions& options) {
  constexpr double kLargest = 0.6, kSmaller = 0.8, kSmallest = 1e-6;
  for (double size = kLargest; size > kSmallest; size *= kSmaller) {
    state.size_factor = size;
    if (Placement(state, options).place_all() && check_packing(at_present_size(state)).passed()) {
      return;
    }
  }
  throw InvalidArgument("the bodies find no room even when they are a millionth of their size");
}

// A size factor at which a hundredth of a pair of circumscribed balls is expected to overlap.
double first_guess(const Packing& packing) {
  double reach = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    reach = std::max(reach, circum_radius(inclusion.body));
  }
  const auto n = static_cast<double>(packing.inclusions.size());
  const bool flat = packing.cell.dimension == 2;
  const double pairs =
      0.5 * n * n * (flat ? 3.2 * reach * reach * 4 : 4.2 * reach * reach * reach * 8);
  const double part = 0.01 * volume(packing.cell) / pairs;
  return std::min(0.01, flat ? std::sqrt(part) : std::cbrt(part));
}

// The balls that the least gap makes of points, grown from points.
std::vector<OrderedBody> balls_of(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                  double diameter) {
  std::vector<OrderedBody> balls = bodies;
  const double radius = 0.5 * diameter * (1.0 + 1e-6);
  for (OrderedBody& ball : balls) {
    ball.body = cell.dimension == 2 ? Body{Disk{radius}} : Body{Sphere{radius}};
  }
  return balls;
}

}  // namespace

MovingPacking starting_points(const Cell& cell, const std::vector<OrderedBody>& bodies,
                              const EventDrivenOptions& options, RunContext& run) {
  MovingPacking state;
  state.packing = at_random_points(cell, bodies, options.seed);
  if (options.min_gap == 0.0) {
    place_at_random(state, options);
    return state;
  }
  const EventDrivenOptions of_balls{.growth_rate = 1.0, .seed = options.seed};
  const EventDrivenResult spread =
      event_driven_pack(cell, balls_of(cell, bodies, options.min_gap), of_balls, run);
  if (spread.stop != EventDrivenStop::target_reached) return state;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    state.packing.inclusions[k].center = spread.packing.inclusions[k].center;
  }
  constexpr double kSmallest = 1e-12;
  double size = first_guess(state.packing);
  for (; size > kSmallest; size *= 0.25) {
    state.size_factor = size;
    if (check_packing(at_present_size(state), {.min_gap = options.min_gap}).passed()) return state;
  }
  throw InvalidArgument("the bodies find no room even as points");
}

}  // namespace packstone::event_driven
