#include "generate/advancing_layer/shaped_layer.hpp"

#include <algorithm>
#include <limits>

#include "packstone/core/parallel.hpp"
#include "packstone/geometry/inscribed_balls.hpp"

namespace packstone::advancing_layer {
namespace {

// Of the balls that stand for a body that stands: in space as few as may be, as each costs far more
// than in the plane.
template <int D>
constexpr double kBallSpacing = D == 2 ? 0.8 : 1.0;

}  // namespace

template <int D>
ShapedLayer<D>::ShapedLayer(const Cell& cell, const Expected& expected, std::int64_t bodies,
                            double min_gap, RandomStream random, int threads)
    : cell_(cell),
      pockets_(cell, expected, min_gap),
      settling_(cell, min_gap, contact_slack(cell, expected.largest), bodies),
      random_(random),
      threads_(threads) {}

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

// The lowest of the pockets found. Most of them are found on each ball that they touch.
template <int D>
void ShapedLayer<D>::list_starts(double guide, const Search& search) {
  constexpr int kFoundPerTry = 3;
  constexpr double kSame = 1e-6;  // over the guide
  pockets_.find({guide, search.from, kFoundPerTry * search.candidates, true}, found_);
  std::sort(found_.begin(), found_.end(), [](const Pocket& a, const Pocket& b) {
    return a.center[kUp] != b.center[kUp] ? a.center[kUp] < b.center[kUp] : a.anchor < b.anchor;
  });
  starts_.clear();
  for (std::size_t k = 0; k < found_.size(); ++k) {
    const bool is_same = k > 0 && norm(found_[k].center - found_[k - 1].center) < kSame * guide;
    if (!is_same) starts_.push_back({k, k});
    starts_.back().last = k + 1;
  }
  const auto most = static_cast<std::size_t>(search.candidates);
  if (starts_.size() > most) starts_.resize(most);
}

template <int D>
void ShapedLayer<D>::try_pockets(const Mover& mover, double guide, const Search& search) {
  constexpr double kAbove = 0.5;  // A body may end this part of its reach below where it is put.
  constexpr int kLifts = 4;
  list_starts(guide, search);
  const std::size_t batch = search.holes ? 1 : kBatch;
  for (std::size_t begin = 0; begin < starts_.size(); begin += batch) {
    const double start = found_[starts_[begin].first].center[kUp];
    if (start > lowest_place() + kAbove * mover.reach) break;
    const std::size_t end = std::min(begin + batch, starts_.size());
    try_batch(mover, begin, end, search.holes ? 0 : kLifts);
    for (std::size_t k = begin; k < end; ++k) {
      const Trial& trial = trials_[k - begin];
      if (trial.outcome == Outcome::rests) places_.push_back(trial.center);
      if (trial.outcome != Outcome::overlaps) continue;
      // One of another orientation might fit, but hardly a larger one.
      for (std::size_t same = starts_[k].first; same < starts_[k].last; ++same) {
        pockets_.give_up(found_[same].anchor, guide);
      }
    }
    if (search.holes && !places_.empty()) return;
  }
}

template <int D>
void ShapedLayer<D>::try_batch(const Mover& mover, std::size_t begin, std::size_t end, int lifts) {
  const double known = lowest_place();
  const auto count = static_cast<std::int64_t>(end - begin);
  parallel_for(count, threads_, 1, [&](std::int64_t first, std::int64_t last) {
    for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
      const Vec3& start = found_[starts_[begin + k].first].center;
      trials_[k] = settle_from(mover, start, lifts, known, works_[k]);
    }
  });
}

// Lets the body down, from where it is put or, where it overlaps too much there, from above that.
template <int D>
auto ShapedLayer<D>::settle_from(const Mover& mover, const Vec3& start, int lifts, double known,
                                 Workspace& work) const -> Trial {
  constexpr double kLift = 0.5;  // over the reach
  for (int lift = 0; lift <= lifts; ++lift) {
    Trial trial{start, Outcome::overlaps};
    trial.center[kUp] += lift * kLift * mover.reach;
    trial.outcome = settling_.settle(mover, trial.center, known, work);
    if (trial.outcome == Outcome::overlaps) continue;
    const double ceiling = cell_.size[kUp] - mover.half_extents[kUp];
    const bool is_out = !cell_.periodic[kUp] && trial.center[kUp] > ceiling;
    if (is_out && trial.outcome == Outcome::rests) trial.outcome = Outcome::overlaps;
    return trial;
  }
  return {start, Outcome::overlaps};
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
    if (settling_.is_clear(mover, place, works_.front())) return place;
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
    const Trial trial = settle_from(mover, start, 0, lowest_place(), works_.front());
    if (trial.outcome == Outcome::rests) places_.push_back(trial.center);
  }
}

template <int D>
void ShapedLayer<D>::add(const Body& body, const Mover& mover, const Vec3& center) {
  settling_.add(mover, center);
  for (const InscribedBall& ball : inscribed_balls(body, kBallSpacing<D>)) {
    pockets_.add(wrapped(cell_, center + ball.center), ball.radius);
  }
  top_ = std::max(top_, std::min(center[kUp] + mover.half_extents[kUp], cell_.size[kUp]));
  ++standing_;
}

template class ShapedLayer<2>;
template class ShapedLayer<3>;

}  // namespace packstone::advancing_layer
