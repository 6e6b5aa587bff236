#include "generate/advancing_layer/shaped_layer.hpp"

#include <algorithm>
#include <limits>

#include "packstone/geometry/inscribed_balls.hpp"

namespace packstone::advancing_layer {
namespace {

// Of the balls that stand for a body that stands.
constexpr double kBallSpacing = 0.8;

}  // namespace

template <int D>
ShapedLayer<D>::ShapedLayer(const Cell& cell, const Expected& expected, std::int64_t bodies,
                            double min_gap, RandomStream random)
    : cell_(cell),
      pockets_(cell, expected, min_gap),
      settling_(cell, min_gap, contact_slack(cell, expected.largest), bodies),
      random_(random) {}

template <int D>
std::optional<Vec3> ShapedLayer<D>::place(const Body& body, const Search& search) {
  constexpr std::int64_t kFew = 30;
  const Mover mover(body);
  places_.clear();
  try_pockets(mover, guide_radius(body), search);
  if (standing_ < kFew) try_columns(mover);
  std::optional<Vec3> place = lowest_clear(mover);
  if (!place && !search.holes) {
    // What failed for others need not fail for this one.
    pockets_.renew_above(search.from);
    try_pockets(mover, guide_radius(body), search);
    try_columns(mover);
    place = lowest_clear(mover);
  }
  if (!place) return std::nullopt;
  const Vec3 center = wrapped(cell_, *place);
  add(body, mover, center);
  return center;
}

template <int D>
void ShapedLayer<D>::try_pockets(const Mover& mover, double guide, const Search& search) {
  constexpr double kAbove = 0.5;  // A body may end this part of its reach below where it is put.
  constexpr int kLifts = 4;
  pockets_.find({guide, search.from, search.candidates}, found_);
  for (const Pocket& pocket : found_) {
    if (pocket.center[kUp] > lowest_place() + kAbove * mover.reach) continue;
    if (settle_from(mover, pocket.center, search.holes ? 0 : kLifts)) {
      if (search.holes) return;
    } else {
      // One of another orientation might fit, but hardly a larger one.
      pockets_.give_up(pocket.anchor, guide);
    }
  }
}

// Lets the body down, from where it is put or, where it overlaps too much there, from above that.
template <int D>
bool ShapedLayer<D>::settle_from(const Mover& mover, const Vec3& start, int lifts) {
  constexpr double kLift = 0.5;  // over the reach
  constexpr int kRounds = 4;
  for (int lift = 0; lift <= lifts; ++lift) {
    Vec3 center = start;
    center[kUp] += lift * kLift * mover.reach;
    if (!settling_.push_out(mover, center, work_, kRounds)) continue;
    if (!settling_.drop(mover, center, work_)) return false;
    const double ceiling = cell_.size[kUp] - mover.half_extents[kUp];
    if (!cell_.periodic[kUp] && center[kUp] > ceiling) return false;
    places_.push_back(center);
    return true;
  }
  return false;
}

template <int D>
double ShapedLayer<D>::lowest_place() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& place : places_) lowest = std::min(lowest, place[kUp]);
  return lowest;
}

template <int D>
std::optional<Vec3> ShapedLayer<D>::lowest_clear(const Mover& mover) {
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Vec3& a, const Vec3& b) { return a[kUp] < b[kUp]; });
  for (const Vec3& place : places_) {
    if (settling_.is_clear(mover, place, work_)) return place;
  }
  places_.clear();
  return std::nullopt;
}

// From above all that stands, at random.
template <int D>
void ShapedLayer<D>::try_columns(const Mover& mover) {
  constexpr int kColumns = 20;
  const double above = mover.half_extents[kUp] * (1.0 + 1e-9);
  for (int column = 0; column < kColumns; ++column) {
    Vec3 start{};
    for (std::size_t axis = 0; axis < kUp; ++axis) {
      const double margin = cell_.periodic[axis] ? 0.0 : mover.half_extents[axis];
      start[axis] = random_.uniform(margin, cell_.size[axis] - margin);
    }
    start[kUp] = top_ + above;
    if (!cell_.periodic[kUp]) start[kUp] = std::min(start[kUp], cell_.size[kUp] - above);
    settle_from(mover, start, 0);
  }
}

template <int D>
void ShapedLayer<D>::add(const Body& body, const Mover& mover, const Vec3& center) {
  settling_.add(mover, center);
  for (const InscribedBall& ball : inscribed_balls(body, kBallSpacing)) {
    pockets_.add(wrapped(cell_, center + ball.center), ball.radius);
  }
  top_ = std::max(top_, std::min(center[kUp] + mover.half_extents[kUp], cell_.size[kUp]));
  ++standing_;
}

template class ShapedLayer<2>;
template class ShapedLayer<3>;

}  // namespace packstone::advancing_layer
