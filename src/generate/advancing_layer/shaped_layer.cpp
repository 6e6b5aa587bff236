#include "generate/advancing_layer/shaped_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/inscribed_balls.hpp"

namespace packstone::advancing_layer {
namespace {

// Of the balls that stand for a body that stands: in space as few as may be, as each costs far more
// than in the plane.
template <int D>
constexpr double kBallSpacing = D == 2 ? 0.8 : 1.0;

// From one radius of guides to the next; the same holds.
template <int D>
constexpr double kGuideStep = D == 2 ? 1.1 : 1.4;

// The body, nowhere thinner than a ball of radius `least`.
Body thickened(const Body& body, double least) {
  const auto thick = [&](double length) { return std::max(length, least); };
  return std::visit(
      Overloaded{[&](const Ellipsoid& b) -> Body {
                   const Vec3& s = b.semi_axes;
                   return Ellipsoid{{thick(s.x), thick(s.y), thick(s.z)}, b.orientation};
                 },
                 [&](const Cylinder& b) -> Body {
                   return Cylinder{thick(b.radius), thick(b.half_length), b.axis};
                 },
                 [](const auto& b) -> Body { return b; }},
      body);
}

// Balls that keep guides of radius `guide` off. Flat bodies would hold thousands, far smaller than
// the guides: those of a thicker one do, made smaller.
template <int D>
std::vector<InscribedBall> guards(const Body& body, double guide) {
  constexpr double kLeast = 0.6;  // over the guide
  if constexpr (D == 2) return inscribed_balls(body, kBallSpacing<D>);
  const Body thick = thickened(body, kLeast * guide);
  std::vector<InscribedBall> balls = inscribed_balls(thick, kBallSpacing<D>);
  const double part = in_radius(body) / in_radius(thick);
  for (InscribedBall& ball : balls) ball.radius *= part;
  return balls;
}

}  // namespace

template <int D>
ShapedLayer<D>::ShapedLayer(const Cell& cell, const Expected& expected, std::int64_t bodies,
                            double min_gap, RandomStream random)
    : cell_(cell),
      pockets_(cell, expected, min_gap),
      settling_(cell, min_gap, contact_slack(cell, expected.largest), bodies),
      random_(random),
      least_guide_(expected.smallest) {
  pockets_.remember_places();
}

// Radii of guides come from a short list, so that what is found for one body serves others too.
template <int D>
auto ShapedLayer<D>::guide_of(const Body& body) const -> Guide {
  const double wanted = guide_radius(body);
  Guide guide{least_guide_, 0};
  while (guide.radius * std::sqrt(kGuideStep<D>) < wanted) {
    guide.radius *= kGuideStep<D>;
    ++guide.level;
  }
  return guide;
}

template <int D>
std::optional<Vec3> ShapedLayer<D>::place(const Body& body, const Search& search) {
  constexpr std::int64_t kFew = 30;
  const Mover mover(body);
  const Guide guide = guide_of(body);
  lowest_.reset();
  try_pockets(mover, guide, search);
  if (standing_ < kFew) try_columns(mover);
  if (!lowest_ && !search.holes) {
    // What failed for others need not fail for this one.
    pockets_.renew_above(search.from);
    try_pockets(mover, guide, search);
    try_columns(mover);
  }
  if (!lowest_) return std::nullopt;
  const Vec3 center = wrapped(cell_, *lowest_);
  add(body, mover, center);
  return center;
}

// Pockets, the lowest first. Most of them are found on each ball that they touch.
template <int D>
void ShapedLayer<D>::list_starts(const Guide& guide, const Search& search) {
  const int found_per_try = search.holes ? 1 : 3;
  constexpr double kSame = 1e-6;  // over the guide
  pockets_.find({guide.radius, search.from, found_per_try * search.candidates, guide.level},
                found_);
  std::sort(found_.begin(), found_.end(), [](const Pocket& a, const Pocket& b) {
    return a.center[kUp] != b.center[kUp] ? a.center[kUp] < b.center[kUp] : a.anchor < b.anchor;
  });
  starts_.clear();
  for (std::size_t k = 0; k < found_.size(); ++k) {
    const bool is_same =
        k > 0 && norm(found_[k].center - found_[k - 1].center) < kSame * guide.radius;
    if (!is_same) starts_.push_back({k, k});
    starts_.back().last = k + 1;
  }
}

template <int D>
void ShapedLayer<D>::try_pockets(const Mover& mover, const Guide& guide, const Search& search) {
  constexpr double kAbove = 0.5;  // A body may end this part of its reach below where it is put.
  constexpr int kLifts = 4;
  list_starts(guide, search);
  int tries = 0;
  for (const Start& start : starts_) {
    // More than asked for until there is one place: there may be none but high up.
    if (++tries > search.candidates && lowest_) break;
    const Vec3& center = found_[start.first].center;
    if (center[kUp] > lowest_height() + kAbove * mover.reach) break;
    if (settle_from(mover, center, search.holes ? 0 : kLifts)) {
      if (search.holes && lowest_) return;
      continue;
    }
    // One of another orientation might fit, but hardly a larger one.
    for (std::size_t same = start.first; same < start.last; ++same) {
      pockets_.fail(found_[same].anchor, guide.radius);
    }
  }
}

// Lets the body down, from where it is put or, where it overlaps too much there, from above that.
// False where there is no place.
template <int D>
bool ShapedLayer<D>::settle_from(const Mover& mover, const Vec3& start, int lifts) {
  using Outcome = typename Settling<D>::Outcome;
  constexpr double kLift = 0.5;  // over the reach
  for (int lift = 0; lift <= lifts; ++lift) {
    Vec3 center = start;
    center[kUp] += lift * kLift * mover.reach;
    const Outcome outcome = settling_.settle(mover, center, lowest_height(), work_);
    if (outcome == Outcome::overlaps) continue;
    if (outcome == Outcome::lags) return true;
    const double ceiling = cell_.size[kUp] - mover.half_extents[kUp];
    if (!cell_.periodic[kUp] && center[kUp] > ceiling) return false;
    if (center[kUp] >= lowest_height()) return true;
    // Where rounding leaves that open, another place has to do.
    if (!settling_.is_clear(mover, center, work_)) return false;
    lowest_ = center;
    return true;
  }
  return false;
}

template <int D>
double ShapedLayer<D>::lowest_height() const {
  return lowest_ ? (*lowest_)[kUp] : std::numeric_limits<double>::infinity();
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
  for (const InscribedBall& ball : guards<D>(body, guide_radius(body))) {
    pockets_.add(wrapped(cell_, center + ball.center), ball.radius);
  }
  top_ = std::max(top_, std::min(center[kUp] + mover.half_extents[kUp], cell_.size[kUp]));
  ++standing_;
}

template class ShapedLayer<2>;
template class ShapedLayer<3>;

}  // namespace packstone::advancing_layer
