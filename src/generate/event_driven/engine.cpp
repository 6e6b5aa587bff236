#include "generate/event_driven/engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "generate/event_driven/lane_kernels.hpp"

namespace packstone::event_driven {
namespace {

Vec3 known_normal(const Neighbor& neighbor) {
  return {neighbor.hint[0], neighbor.hint[1], neighbor.hint[2]};
}

void remember(Neighbor& neighbor, const Vec3& normal) {
  const Vec3 unit = norm_sq(normal) > 0.0 ? normalized(normal) : Vec3{};
  neighbor.hint[0] = static_cast<float>(unit.x);
  neighbor.hint[1] = static_cast<float>(unit.y);
  neighbor.hint[2] = static_cast<float>(unit.z);
}

// Calls visit(image) for the periods m along each axis that may bring r + m to within `reach`.
template <class Visit>
void for_images_within(const Cell& cell, const Vec3& r, double reach, Visit&& visit) {
  std::array<int, 3> first{}, last{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (!cell.periodic[a]) continue;
    first[a] = static_cast<int>(std::ceil((-reach - r[a]) / cell.size[a]));
    last[a] = static_cast<int>(std::floor((reach - r[a]) / cell.size[a]));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) visit(std::array<int, 3>{x, y, z});
    }
  }
}

}  // namespace

Engine::Engine(Bodies& bodies, const Cell& cell)
    : bodies_(bodies),
      cell_(cell),
      search_(bodies, cell),
      neighbors_(bodies, cell),
      lanes_(bodies, cell, lane_kernels()) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    has_walls_ = has_walls_ || !cell.periodic[a];
  }
}

void Engine::start() {
  const std::int32_t n = bodies_.count();
  queue_.reset(n);
  events_.assign(static_cast<std::size_t>(n), {});
  neighbors_.rebuild_all(0.0);
  for (std::int32_t i = 0; i < n; ++i) await_exit(i, 0.0);
  for (std::int32_t i = 0; i < n; ++i) predict(i, 0.0);
}

// The partner that body i was to meet looks again when they were to meet: up to then nothing can
// happen to it, as all others have been excluded.
void Engine::forget_partner(std::int32_t i) {
  const Event& own = event(i);
  if (own.kind != Kind::collision || is_wall(own.with.body) || own.with.body == i) return;
  Event& other = event(own.with.body);
  if (other.kind == Kind::collision && other.with.body == i) other.kind = Kind::look_again;
}

void Engine::set_event(std::int32_t i, double t, Kind kind, const Neighbor& with) {
  forget_partner(i);
  event(i) = {kind, with};
  queue_.set(i, t);
  if (kind != Kind::collision || is_wall(with.body) || with.body == i) return;
  forget_partner(with.body);
  // The hint of the list of i would be the wrong way round for the other.
  event(with.body) = {kind, reversed(with, i)};
  queue_.set(with.body, t);
}

// What body i has before anything else of it is known. Others look at it no further than that, as
// its turn is known no further.
void Engine::await_exit(std::int32_t i, double t) {
  event(i).kind = Kind::exit;
  queue_.set(i, neighbors_.exit_time(i, t));
}

void Engine::predict(std::int32_t i, double t) {
  ++count_.predictions;
  if (event(i).kind == Kind::look_again) await_exit(i, t);
  // Its exit, or what the partner of a collision just carried out has found already.
  next_ = {queue_.time(i), Kind::exit, -1};
  const std::span<Neighbor> list = neighbors_.of(i);
  if (lanes_.kind() == PairLanes::Kind::none) {
    for (std::size_t k = 0; k < list.size(); ++k) look_at(i, list, k, t, known_normal(list[k]));
  } else {
    look_in_lanes(i, list, t);
  }
  if (next_.neighbor < 0) return;
  set_event(i, next_.time, next_.kind, list[static_cast<std::size_t>(next_.neighbor)]);
}

// Searches for the contact with one neighbor, as far as it would come first.
void Engine::look_at(std::int32_t i, std::span<Neighbor> list, std::size_t k, double t,
                     Vec3 normal) {
  Neighbor& neighbor = list[k];
  double horizon = next_.time;
  if (!is_wall(neighbor.body)) horizon = std::min(horizon, queue_.time(neighbor.body));
  const Found found = search_.first_contact(i, neighbors_.partner(neighbor), t, horizon, normal);
  if (lanes_.kind() == PairLanes::Kind::none) remember(neighbor, normal);
  take(found, static_cast<std::int32_t>(k));
}

void Engine::search_suspect(std::int32_t i, std::span<Neighbor> list, const Suspect& suspect,
                            double t) {
  const Neighbor& neighbor = list[static_cast<std::size_t>(suspect.neighbor)];
  const double horizon = std::min(next_.time, queue_.time(neighbor.body));
  const Found found = search_.first_contact_of_revolution(i, neighbors_.partner(neighbor), t,
                                                          horizon, {suspect.l, suspect.time});
  take(found, suspect.neighbor);
}

void Engine::take(const Found& found, std::int32_t neighbor) {
  if (found.finding == Finding::none || found.time >= next_.time) return;
  next_ = {found.time, found.finding == Finding::contact ? Kind::collision : Kind::look_again,
           neighbor};
}

void Engine::look_in_lanes(std::int32_t i, std::span<Neighbor> list, double t) {
  suspects_.resize(list.size() + PairLanes::kLanes);
  const std::size_t count =
      lanes_.look(i, t, next_.time, queue_.times(), list, suspects_.data(), count_.least_gap);
  if (lanes_.kind() == PairLanes::Kind::balls) {
    for (std::size_t s = 0; s < count; ++s) {
      if (suspects_[s].time >= next_.time) continue;
      next_ = {suspects_[s].time, Kind::collision, suspects_[s].neighbor};
    }
  } else {
    // The one that seems to come first is searched first: it shortens the search for the others.
    std::sort(suspects_.begin(), suspects_.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Suspect& a, const Suspect& b) {
                return a.time < b.time || (a.time == b.time && a.neighbor < b.neighbor);
              });
    for (std::size_t s = 0; s < count && t + suspects_[s].time < next_.time; ++s) {
      search_suspect(i, list, suspects_[s], t);
    }
  }
  for (std::size_t k = 0; has_walls_ && k < list.size(); ++k) {
    if (is_wall(list[k].body)) look_at(i, list, k, t, {});
  }
}

void Engine::carry_out_collision(std::int32_t i, double t) {
  const Neighbor with = event(i).with;
  const Partner partner = neighbors_.partner(with);
  const bool two = !is_wall(with.body) && with.body != i;
  bodies_.advance(i, t);
  if (two) bodies_.advance(with.body, t);
  const bool lanes = lanes_.kind() != PairLanes::Kind::none && !is_wall(with.body);
  const double l = with.hint[0] > 0.0F ? with.hint[0] : 0.5;
  const Contact contact = lanes ? search_.contact_of_revolution(i, partner, t, l)
                                : search_.contact(i, partner, t, known_normal(with));
  count_.virial += collide(bodies_, i, partner, contact, t);
  ++count_.collisions;
  if (is_wall(with.body)) ++count_.wall_collisions;
  await_exit(i, t);
  if (two) await_exit(with.body, t);
  predict(i, t);
  if (two) predict(with.body, t);
}

void Engine::carry_out(std::int32_t i, double t) {
  constexpr double kLittleRoom = 0.1;
  if (event(i).kind == Kind::collision) return carry_out_collision(i, t);
  bodies_.advance(i, t);
  if (neighbors_.room_left(i, t) < kLittleRoom) neighbors_.rebuild(i, t);
  await_exit(i, t);
  predict(i, t);
}

// Every pair and every image that may come near, without the lists: what the lists miss is seen.
double Engine::least_gap_of(std::int32_t i, double t) const {
  const Pose pose = bodies_.pose(i, t);
  const double size = bodies_.size_at(t);
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t j = 0; j <= i; ++j) {
    const Vec3 r = bodies_.pose(j, t).center - pose.center;
    const double reach = size * (bodies_.reach[static_cast<std::size_t>(i)] +
                                 bodies_.reach[static_cast<std::size_t>(j)]);
    for_images_within(cell_, r, reach, [&](const std::array<int, 3>& image) {
      if (j == i && image == std::array<int, 3>{}) return;
      least = std::min(least, search_.gap(i, {j, image_shift(cell_, image)}, t));
    });
  }
  return least;
}

double Engine::least_gap(double t) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t i = 0; i < bodies_.count(); ++i) least = std::min(least, least_gap_of(i, t));
  return least;
}

void Engine::finish(double t) {
  for (std::int32_t i = 0; i < bodies_.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    bodies_.advance(i, t);
    bodies_.flight[k].clock = 0.0;
    bodies_.flight[k].center = wrapped(cell_, bodies_.flight[k].center);
  }
  bodies_.size = bodies_.size_at(t);
  count_.time = t;
}

BlockCount Engine::run_block(const BlockEnd& end, const RunContext& run, bool check_all,
                             const Watch& watch) {
  constexpr std::int64_t kPoll = 128, kTell = 8192;
  count_ = {};
  const SearchCount before = search_.count();
  const std::int64_t rebuilds = neighbors_.rebuilds();
  start();
  double now = 0.0;
  for (std::int64_t events = 0; count_.collisions < end.collisions && events < end.events;
       ++events) {
    const std::int32_t i = queue_.next();
    if (queue_.time(i) >= end.time) {
      now = end.time;
      break;
    }
    now = queue_.time(i);
    if (events % kPoll == 0) {
      count_.stop = run.stop_request();
      if (count_.stop != StopRequest::none) break;
      if (watch && events % kTell == 0) watch(bodies_.size_at(now), count_.collisions);
    }
    carry_out(i, now);
    if (check_all) count_.least_gap = std::min(count_.least_gap, least_gap(now));
  }
  finish(now);
  count_.searches = search_.count();
  count_.searches.searches -= before.searches;
  count_.searches.steps -= before.steps;
  count_.neighbor_searches = neighbors_.rebuilds() - rebuilds;
  return count_;
}

}  // namespace packstone::event_driven
