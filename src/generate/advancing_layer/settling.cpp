#include "generate/advancing_layer/settling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generate/advancing_layer/flat_gap.hpp"
#include "geometry/local_gap.hpp"
#include "packstone/geometry/bounds.hpp"

namespace packstone::advancing_layer {
namespace {

// A body is lowered by steps of this part of its reach at most along each axis ...
constexpr double kStep = 0.4;
// ... past neighbors within this many steps, more than the diagonal of their box is long; they are
// gathered from somewhat farther off.
constexpr double kNear = 1.75;
constexpr double kAhead = 2.2;

bool is_capsule(Form form) { return form == Form::ball || form == Form::spherocylinder; }

// As solid_gap(), of any bodies.
double any_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, double limit, Vec3& d) {
  // Of these the direction is told only where the gap is below the limit, and costs nothing.
  if (is_capsule(a.form) && is_capsule(b.form)) limit = std::numeric_limits<double>::infinity();
  LocalGap found;
  local_gap(a, b, r, limit, d, found);
  return found.value;
}

}  // namespace

Mover::Mover(const Body& shape)
    : body(posed_body(shape)),
      solid(is_ellipsoid(body.form) ? SolidEllipsoid(body) : SolidEllipsoid{}),
      half_extents(packstone::half_extents(shape)),
      thickness(in_radius(shape)),
      reach(std::max({half_extents.x, half_extents.y, half_extents.z})) {}

template <int D>
Settling<D>::Settling(const Cell& cell, double min_gap, double slack, std::int64_t count)
    : cell_(cell), min_gap_(min_gap), slack_(slack), grid_(cell) {
  grid_.reserve(count);
  bodies_.reserve(static_cast<std::size_t>(count));
}

template <int D>
void Settling<D>::add(const Mover& mover, const Vec3& center) {
  grid_.insert(static_cast<std::int32_t>(bodies_.size()), center, mover.half_extents);
  Standing standing{mover.body, mover.solid};
  standing.body.pose.center = center;
  bodies_.push_back(standing);
}

template <int D>
void Settling<D>::gather(const Mover& mover, const Vec3& center, double reach,
                         Workspace& work) const {
  std::swap(work.neighbors, work.before);
  work.neighbors.clear();
  grid_.query(center, mover.half_extents, reach, [&](std::int32_t id, const auto& image) {
    const auto same = std::find_if(work.before.begin(), work.before.end(), [&](const Neighbor& n) {
      return n.id == id && n.image == image;
    });
    if (same != work.before.end()) {
      work.neighbors.push_back(*same);
      return true;
    }
    const Vec3& home = bodies_[static_cast<std::size_t>(id)].body.pose.center;
    work.neighbors.push_back({id, image, home + image_shift(cell_, image), {}, 0.0});
    return true;
  });
  work.before.clear();
}

// Turns the half-space of a neighbor toward the best one, until it leaves more than `limit`;
// returns what it leaves.
template <int D>
double Settling<D>::turn(const Mover& mover, const Vec3& center, Neighbor& neighbor, double limit,
                         int most_steps) const {
  const Standing& other = bodies_[static_cast<std::size_t>(neighbor.id)];
  const Vec3 r = neighbor.center - center;
  const double keep = min_gap_ + slack_;
  const bool is_new = neighbor.d == Vec3{};
  double gap = 0.0;
  if constexpr (D == 2) {
    if (is_new) neighbor.d = first_direction(mover.body, other.body, r);
    gap = flat_gap(mover.body, other.body, r, limit + keep, most_steps, neighbor.d);
  } else if (is_ellipsoid(mover.body.form) && is_ellipsoid(other.body.form)) {
    if (is_new) neighbor.d = first_direction(mover.solid, other.solid, r);
    gap = solid_gap(mover.solid, other.solid, r, limit + keep, most_steps, neighbor.d);
  } else {
    gap = any_gap(mover.body, other.body, r, limit + keep, neighbor.d);
  }
  neighbor.beyond = gap - keep + dot(neighbor.d, center);
  return gap - keep;
}

// How far the mover may go toward a neighbor; looked at more closely where it is near, to the end
// where it would overlap otherwise.
template <int D>
double Settling<D>::room(const Mover& mover, const Vec3& center, Neighbor& neighbor) const {
  constexpr double kClose = 0.05;  // over the reach
  constexpr int kFollowing = 1;
  constexpr int kToTheEnd = 20;
  const bool is_new = neighbor.d == Vec3{};
  double left =
      is_new ? turn(mover, center, neighbor, 0.0, 0) : neighbor.beyond - dot(neighbor.d, center);
  const double close = kClose * mover.reach;
  if (left < close) left = turn(mover, center, neighbor, close, kFollowing);
  if (left < 0.0) left = turn(mover, center, neighbor, 0.0, kToTheEnd);
  return left;
}

template <int D>
bool Settling<D>::has_floor(std::size_t axis) const {
  return !cell_.periodic[axis] || (axis == kUp && floor_);
}

template <int D>
template <class Visit>
void Settling<D>::for_walls(const Mover& mover, const Vec3& center, Visit&& visit) const {
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double extent = mover.half_extents[axis] + slack_;
    Vec3 n{};
    n[axis] = -1.0;
    if (has_floor(axis)) visit(HalfSpace{n, center[axis] - extent});
    if (cell_.periodic[axis]) continue;
    n[axis] = 1.0;
    visit(HalfSpace{n, cell_.size[axis] - extent - center[axis]});
  }
}

// Gathers neighbors anew unless all within `limit` are known.
template <int D>
void Settling<D>::keep_near(const Mover& mover, const Vec3& center, double limit,
                            Workspace& work) const {
  if (norm(center - work.gathered) + limit <= work.reach) return;
  const double ahead = kAhead * kStep * mover.reach;
  gather(mover, center, ahead, work);
  work.gathered = center;
  work.reach = ahead;
}

// The sides that a step may meet, the nearest first; returns the least room.
template <int D>
double Settling<D>::measure(const Mover& mover, const Vec3& center, Workspace& work) const {
  const double limit = kNear * kStep * mover.reach;
  keep_near(mover, center, limit, work);
  work.sides.clear();
  const auto put = [&](const HalfSpace& side) {
    if (side.reach <= limit) work.sides.push_back(side);
  };
  for_walls(mover, center, put);
  for (Neighbor& neighbor : work.neighbors) {
    const double left = room(mover, center, neighbor);
    put({neighbor.d, left});
  }
  std::sort(work.sides.begin(), work.sides.end(),
            [](const HalfSpace& a, const HalfSpace& b) { return a.reach < b.reach; });
  return work.sides.empty() ? std::numeric_limits<double>::infinity() : work.sides.front().reach;
}

template <int D>
auto Settling<D>::settle(const Mover& mover, Vec3& center, double known, Workspace& work) const
    -> Outcome {
  // Half-spaces are those of one mover.
  work.neighbors.clear();
  work.reach = -1.0;
  if (!push_out(mover, center, work)) return Outcome::overlaps;
  return drop(mover, center, known, work);
}

template <int D>
bool Settling<D>::push_out(const Mover& mover, Vec3& center, Workspace& work) const {
  constexpr double kHopeless = 1.2;  // depth over the thickness
  constexpr double kLongest = 0.7;   // over the reach
  constexpr int kMostRounds = 4;
  constexpr int kPasses = 6;
  for (int round = 0; round < kMostRounds; ++round) {
    const double least = measure(mover, center, work);
    if (least >= 0.0) return true;
    if (least < -kHopeless * mover.thickness) return false;
    // Onto one broken side after the other (S. Agmon, Can. J. Math. 6 (1954) 382-392).
    Vec3 step{};
    for (int pass = 0; pass < kPasses; ++pass) {
      for (const HalfSpace& side : work.sides) {
        const double beyond = dot(side.n, step) - side.reach;
        if (beyond > 0.0) step -= beyond * side.n;
      }
    }
    const double length = norm(step);
    const double most = kLongest * mover.reach;
    center += length > most ? (most / length) * step : step;
  }
  return false;
}

template <int D>
auto Settling<D>::drop(const Mover& mover, Vec3& center, double known, Workspace& work) const
    -> Outcome {
  constexpr int kMostSteps = 100;
  constexpr double kRest = 1e-9;  // over the reach
  constexpr double kDeep = 1e-7;  // over the reach
  constexpr double kHope = 4.0;   // Steps like the last one to come.
  const double most = kStep * mover.reach;
  for (int step = 0; step < kMostSteps; ++step) {
    if (measure(mover, center, work) < -kDeep * mover.reach) return Outcome::overlaps;
    for (HalfSpace& side : work.sides) side.reach = std::max(side.reach, 0.0);
    const Vec3 lowest = lowest_point<D>(work.sides, most);
    if (!(lowest[kUp] < -kRest * mover.reach)) break;
    center += lowest;
    if (center[kUp] + kHope * lowest[kUp] > known) return Outcome::lags;
  }
  return Outcome::rests;
}

template <int D>
bool Settling<D>::is_clear(const Mover& mover, const Vec3& center, Workspace& work) const {
  work.neighbors.clear();
  work.reach = -1.0;
  gather(mover, center, min_gap_ + slack_, work);
  const double least = -0.5 * slack_;
  bool is_clear = true;
  for_walls(mover, center, [&](const HalfSpace& wall) { is_clear &= wall.reach >= least; });
  return is_clear &&
         std::all_of(work.neighbors.begin(), work.neighbors.end(),
                     [&](Neighbor& neighbor) { return keeps_off(mover, center, neighbor, least); });
}

// Of rods the best direction is now and then found only when it is looked for again.
template <int D>
bool Settling<D>::keeps_off(const Mover& mover, const Vec3& center, Neighbor& neighbor,
                            double least) const {
  constexpr int kToTheEnd = 40;
  constexpr int kLooks = 3;
  for (int look = 0; look < kLooks; ++look) {
    if (turn(mover, center, neighbor, least, kToTheEnd) >= least) return true;
  }
  return false;
}

template class Settling<2>;
template class Settling<3>;

}  // namespace packstone::advancing_layer
