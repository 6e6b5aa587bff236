#include "generate/event_driven/neighborhoods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "generate/event_driven/contact_search.hpp"

namespace packstone::event_driven {
namespace {

// Greatest slope of the support function over the unit sphere.
double slope_of(Form form, const Spin& spin, double second) {
  switch (form) {
    case Form::ball:
      return 0.0;
    case Form::spheroid:
      return std::abs(spin.axial - spin.lateral);
    case Form::scalene: {
      const auto [low, high] = std::minmax({spin.axial, second, spin.lateral});
      return high - low;
    }
    case Form::cylinder:
      return std::max(spin.axial, spin.lateral);
    case Form::spherocylinder:
      break;
  }
  return spin.axial;
}

std::vector<double> slopes_of(const Bodies& bodies) {
  std::vector<double> slopes;
  for (std::size_t k = 0; k < bodies.flight.size(); ++k) {
    const double second = bodies.second_semi_axis(k);
    slopes.push_back(slope_of(bodies.form[k], bodies.spin[k], second));
  }
  return slopes;
}

}  // namespace

Neighborhoods::Neighborhoods(const Bodies& bodies, const Cell& cell)
    : bodies_(bodies), cell_(cell), slope_(slopes_of(bodies)), revolution_(are_revolution(bodies)) {
  const auto n = static_cast<std::size_t>(bodies.count());
  line_.resize(n);
  if (!bodies.second.empty()) second_.resize(n);
  size_.resize(n);
  margin_.resize(n);
  wraps_.resize(n);
}

void Neighborhoods::set(std::int32_t i, double t, double margin) {
  const auto k = static_cast<std::size_t>(i);
  const Pose pose = bodies_.pose(i, t);
  const double size = bodies_.size_at(t);
  line_[k] = {pose.center, pose.axis, size * bodies_.spin[k].lateral, size * bodies_.spin[k].axial};
  if (!second_.empty()) second_[k] = pose.second;
  size_[k] = size;
  margin_[k] = margin;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    if (!cell_.periodic[a]) continue;
    wraps_[k][a] = static_cast<std::int16_t>(std::floor(pose.center[a] / cell_.size[a]));
  }
}

double Neighborhoods::reach(std::int32_t i) const {
  const auto k = static_cast<std::size_t>(i);
  return size_[k] * bodies_.reach[k] + margin_[k] + 0.5 * bodies_.min_gap;
}

Capsule Neighborhoods::capsule(std::int32_t i) const {
  const auto k = static_cast<std::size_t>(i);
  PosedBody wrapped = body(i);
  wrapped.pose.center -= image_shift(cell_, {wraps_[k][0], wraps_[k][1], wraps_[k][2]});
  return capsule_about(wrapped, margin_[k] + 0.5 * bodies_.min_gap);
}

Neighbor Neighborhoods::neighbor(std::int32_t i, std::int32_t j,
                                 const std::array<int, 3>& image) const {
  Neighbor neighbor;
  neighbor.body = j;
  const auto& own = wraps_[static_cast<std::size_t>(i)];
  const auto& other = wraps_[static_cast<std::size_t>(j)];
  for (std::size_t a = 0; a < 3; ++a) {
    neighbor.image[a] = static_cast<std::int16_t>(image[a] - other[a] + own[a]);
  }
  return neighbor;
}

PosedBody Neighborhoods::body(std::int32_t i) const {
  const auto k = static_cast<std::size_t>(i);
  const double second = size_[k] * bodies_.second_semi_axis(k);
  return {bodies_.form[k],
          {line_[k].center, line_[k].axis, second_.empty() ? Vec3{} : second_[k]},
          line_[k].axial,
          second,
          line_[k].lateral};
}

void Neighborhoods::bound_gaps(std::int32_t i, std::span<const Neighbor> others,
                               double* gaps) const {
  if (others.empty()) return;
  if (revolution_) {
    return event_driven::bound_gaps(line_[static_cast<std::size_t>(i)], line_.data(), others,
                                    cell_.size, gaps);
  }
  const PosedBody own = body(i);
  for (std::size_t k = 0; k < others.size(); ++k) {
    const Neighbor& other = others[k];
    const Vec3 shift = image_shift(cell_, {other.image[0], other.image[1], other.image[2]});
    const PosedBody partner = body(other.body);
    gaps[k] = gap_bound(own, partner, partner.pose.center + shift - own.pose.center);
  }
}

// Perram and Wertheim's l, as it is for the balls around two bodies.
float Neighborhoods::ball_like(std::int32_t i, std::int32_t j) const {
  const double reach = bodies_.reach[static_cast<std::size_t>(i)];
  return static_cast<float>(reach / (reach + bodies_.reach[static_cast<std::size_t>(j)]));
}

void Neighborhoods::keep_near(std::int32_t i, std::vector<Neighbor>& others) const {
  if (others.empty()) return;
  gaps_.resize(others.size());
  const double margin = margin_[static_cast<std::size_t>(i)] + bodies_.min_gap;
  if (revolution_) {
    event_driven::bound_near_gaps(line_[static_cast<std::size_t>(i)], margin, line_.data(),
                                  margin_.data(), others, cell_.size, gaps_.data());
  } else {
    bound_gaps(i, others, gaps_.data());
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < others.size(); ++k) {
    if (gaps_[k] > margin + margin_[static_cast<std::size_t>(others[k].body)]) continue;
    others[kept] = others[k];
    if (revolution_) others[kept].hint[0] = ball_like(i, others[k].body);
    ++kept;
  }
  others.resize(kept);
}

double Neighborhoods::wall_gap(std::int32_t i, int axis, bool high) const {
  const auto a = static_cast<std::size_t>(axis);
  const PosedBody own = body(i);
  Vec3 normal;
  normal[a] = 1.0;
  const double center = own.pose.center[a];
  return (high ? cell_.size[a] - center : center) - support(own, normal);
}

double Neighborhoods::room_left(std::int32_t i, double t) const {
  const auto k = static_cast<std::size_t>(i);
  double used = norm(bodies_.flight[k].center - line_[k].center) +
                (bodies_.size_at(t) - size_[k]) * bodies_.reach[k];
  if (slope_[k] > 0.0) {
    const Vec3& axis = bodies_.spin[k].axis;
    double turn_sq = norm_sq(axis - line_[k].axis);
    if (bodies_.form[k] == Form::scalene) {
      const Vec3& second = bodies_.second[k].axis;
      turn_sq += norm_sq(second - second_[k]) +
                 norm_sq(cross(axis, second) - cross(line_[k].axis, second_[k]));
      turn_sq *= 0.5;
    }
    used += size_[k] * slope_[k] * 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(turn_sq)));
  }
  return margin_[k] - used;
}

double Neighborhoods::exit_time(std::int32_t i, double t) const {
  const auto k = static_cast<std::size_t>(i);
  const Flight& flight = bodies_.flight[k];
  const Vec3 d = flight.center - line_[k].center;
  // |d + v dt| + rate dt = room, a quadratic equation.
  const double room = std::max(0.0, room_left(i, t)) + norm(d);
  const double rate = size_[k] * slope_[k] * flight.turn + bodies_.growth * bodies_.reach[k];
  const double a = norm_sq(flight.velocity) - rate * rate;
  const double b = dot(d, flight.velocity) + room * rate;
  const double c = room * room - norm_sq(d);
  const double root = b + std::sqrt(std::max(0.0, b * b + a * c));
  double dt = root > 0.0 ? c / root : std::numeric_limits<double>::infinity();
  if (flight.turn > 0.0) dt = std::min(dt, kMostTurn / flight.turn);
  return t + dt;
}

void NeighborLists::reset(std::int32_t bodies) {
  pool_.clear();
  extents_.assign(static_cast<std::size_t>(bodies), {});
}

void NeighborLists::append(std::int32_t i, const Neighbor& neighbor) {
  constexpr std::int32_t kStep = 8;
  Extent& e = extents_[static_cast<std::size_t>(i)];
  if (e.size == e.capacity) {
    const auto fresh = static_cast<std::int64_t>(pool_.size());
    const std::int32_t capacity = e.capacity + std::max(kStep, e.capacity / 2 / kStep * kStep);
    pool_.resize(pool_.size() + static_cast<std::size_t>(capacity));
    std::copy_n(pool_.begin() + e.first, e.size, pool_.begin() + fresh);
    e.first = fresh;
    e.capacity = capacity;
  }
  pool_[static_cast<std::size_t>(e.first + e.size++)] = neighbor;
}

void NeighborLists::add(std::int32_t i, const Neighbor& neighbor) {
  append(i, neighbor);
  if (neighbor.body == i || is_wall(neighbor.body)) return;
  Neighbor back = reversed(neighbor, i);
  // Of a pair that is new only Perram and Wertheim's l is known, if anything.
  if (neighbor.hint[0] > 0.0F) back.hint[0] = 1.0F - neighbor.hint[0];
  append(neighbor.body, back);
}

void NeighborLists::remove(std::int32_t i) {
  for (const Neighbor& neighbor : of(i)) {
    if (is_wall(neighbor.body) || neighbor.body == i) continue;
    Extent& e = extents_[static_cast<std::size_t>(neighbor.body)];
    Neighbor* const list = pool_.data() + e.first;
    for (std::int32_t k = 0; k < e.size; ++k) {
      if (list[k].body != i || list[k].image[0] != -neighbor.image[0] ||
          list[k].image[1] != -neighbor.image[1] || list[k].image[2] != -neighbor.image[2]) {
        continue;
      }
      list[k] = list[--e.size];
      break;
    }
  }
  extents_[static_cast<std::size_t>(i)].size = 0;
}

Neighbor reversed(const Neighbor& neighbor, std::int32_t i) {
  Neighbor back;
  back.body = i;
  for (int a = 0; a < 3; ++a) back.image[a] = static_cast<std::int16_t>(-neighbor.image[a]);
  return back;
}

}  // namespace packstone::event_driven
