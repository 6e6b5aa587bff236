#include "generate/advancing_layer/settling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generate/advancing_layer/flat_gap.hpp"
#include "geometry/local_gap.hpp"
#include "packstone/geometry/bounds.hpp"

namespace packstone::advancing_layer {

Mover::Mover(const Body& shape)
    : body(posed_body(shape)),
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
  PosedBody body = mover.body;
  body.pose.center = center;
  bodies_.push_back(body);
}

template <int D>
void Settling<D>::gather(const Mover& mover, const Vec3& center, double reach,
                         Workspace& work) const {
  std::swap(work.neighbors, work.before);
  work.neighbors.clear();
  grid_.query(center, mover.half_extents, reach, [&](std::int32_t id, const auto& image) {
    const Vec3 there = bodies_[static_cast<std::size_t>(id)].pose.center + image_shift(cell_, image);
    const auto same = std::find_if(work.before.begin(), work.before.end(), [&](const Neighbor& n) {
      return n.id == id && n.image == image;
    });
    const Vec3 d = same == work.before.end() ? Vec3{} : same->d;
    work.neighbors.push_back({id, image, there, d, 0.0, false});
    return true;
  });
  work.before.clear();
}

template <int D>
void Settling<D>::look_at(const Mover& mover, const Vec3& center, Neighbor& neighbor, double limit,
                          Care care) const {
  const PosedBody& other = bodies_[static_cast<std::size_t>(neighbor.id)];
  const Vec3 r = neighbor.center - center;
  const double keep = min_gap_ + slack_;
  if constexpr (D == 2) {
    constexpr int kToTheEnd = 20;
    constexpr int kFollowing = 2;
    const bool anew = neighbor.d == Vec3{} || care == Care::thorough;
    if (anew) neighbor.d = first_direction(mover.body, other, r);
    const int steps = anew ? kToTheEnd : kFollowing;
    neighbor.room = flat_gap(mover.body, other, r, limit + keep, steps, neighbor.d) - keep;
    neighbor.is_near = neighbor.room <= limit;
  } else {
    LocalGap found;
    neighbor.is_near = local_gap(mover.body, other, r, limit + keep, neighbor.d, found);
    neighbor.room = found.value - keep;
  }
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

// The sides within `limit`; returns the least room.
template <int D>
double Settling<D>::measure(const Mover& mover, const Vec3& center, double limit, Care care,
                            Workspace& work) const {
  work.sides.clear();
  double least = std::numeric_limits<double>::infinity();
  const auto put = [&](const HalfSpace& side) {
    least = std::min(least, side.reach);
    if (side.reach <= limit) work.sides.push_back(side);
  };
  for_walls(mover, center, put);
  for (Neighbor& neighbor : work.neighbors) {
    look_at(mover, center, neighbor, limit, care);
    if (neighbor.is_near) put({neighbor.d, neighbor.room});
  }
  return least;
}

template <int D>
bool Settling<D>::push_out(const Mover& mover, Vec3& center, Workspace& work,
                           int most_rounds) const {
  constexpr double kHopeless = 1.2;  // depth over the thickness
  constexpr double kNear = 0.5;      // over the reach
  constexpr double kStep = 0.7;      // over the reach
  constexpr int kPasses = 6;
  for (int round = 0; round < most_rounds; ++round) {
    gather(mover, center, kNear * mover.reach, work);
    const double least = measure(mover, center, kNear * mover.reach, Care::thorough, work);
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
    const double most = kStep * mover.reach;
    center += length > most ? (most / length) * step : step;
  }
  return false;
}

template <int D>
bool Settling<D>::drop(const Mover& mover, Vec3& center, Workspace& work) const {
  constexpr int kMostSteps = 100;
  constexpr double kRest = 1e-9;   // over the reach
  constexpr double kDeep = 1e-7;   // over the reach
  constexpr double kStep = 0.6;    // over the reach
  constexpr double kAhead = 2.2;   // over the step
  constexpr double kLimit = 1.75;  // over the step; above the diagonal of the box of steps
  const double most = kStep * mover.reach;
  const double limit = kLimit * most;
  Vec3 gathered = center;
  bool is_new = true;
  for (int step = 0; step < kMostSteps; ++step) {
    if (is_new || norm(center - gathered) > (kAhead - kLimit) * most) {
      gather(mover, center, kAhead * most, work);
      gathered = center;
    }
    double least = measure(mover, center, limit, is_new ? Care::thorough : Care::quick, work);
    if (least < -kDeep * mover.reach && !is_new) {
      least = measure(mover, center, limit, Care::thorough, work);
    }
    if (least < -kDeep * mover.reach) return false;
    is_new = false;
    for (HalfSpace& side : work.sides) side.reach = std::max(side.reach, 0.0);
    const Vec3 lowest = lowest_point<D>(work.sides, most);
    if (!(lowest[kUp] < -kRest * mover.reach)) break;
    center += lowest;
  }
  return true;
}

template <int D>
bool Settling<D>::is_clear(const Mover& mover, const Vec3& center, Workspace& work) const {
  gather(mover, center, min_gap_ + slack_, work);
  const double near = 0.5 * mover.reach;
  return measure(mover, center, near, Care::thorough, work) >= -0.5 * slack_;
}

template class Settling<2>;
template class Settling<3>;

}  // namespace packstone::advancing_layer
