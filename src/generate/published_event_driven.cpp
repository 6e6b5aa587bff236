#include "packstone/generate/published_event_driven.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "generate/ordered_bodies.hpp"
#include "generate/published_event_driven/audit.hpp"
#include "generate/published_event_driven/collisions.hpp"
#include "generate/published_event_driven/contact_search.hpp"
#include "generate/published_event_driven/faces.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

using published::Audit;
using published::Clock;
using published::Collision;
using published::FaceForecasts;
using published::PairForecasts;

double shortest_edge(const Cell& cell) { return std::min({cell.size.x, cell.size.y, cell.size.z}); }

double longest(const Vec3& semi_axes) { return std::max({semi_axes.x, semi_axes.y, semi_axes.z}); }

void check_number(const char* field, double value, bool allowed, const char* range) {
  if (!allowed) {
    throw InvalidArgument(
        fmt::format("PublishedOptions::{} is {}; it must be {}", field, value, range));
  }
}

void check_options(const PublishedOptions& options) {
  constexpr double kMost = std::numeric_limits<double>::max();
  check_number("samples", options.samples, options.samples >= 1, ">= 1");
  check_number("neighborhood", options.neighborhood,
               options.neighborhood >= 1.0 && options.neighborhood <= kMost, "a number >= 1");
  check_number("growth_rate", options.growth_rate,
               options.growth_rate > 0.0 && options.growth_rate <= kMost, "a number > 0");
  check_number("start_size", options.start_size,
               options.start_size > 0.0 && options.start_size < 1.0, "in (0, 1)");
  check_number("max_events", static_cast<double>(options.max_events), options.max_events >= 0,
               ">= 0");
}

void check_cubic(const Cell& cell) {
  check_cell(cell);
  if (cell.dimension != 3 || !(cell.periodic[0] && cell.periodic[1] && cell.periodic[2])) {
    throw InvalidArgument("Cell is not one of 3 dimensions and periodic along all of them");
  }
}

/// As an ellipsoid; throws unless it is one that the paper can treat.
Ellipsoid checked_body(const Cell& cell, const OrderedBody& ordered, std::int64_t k) {
  check_ordered(cell, ordered, k);
  const Sphere* sphere = std::get_if<Sphere>(&ordered.body);
  if (sphere == nullptr && kind(ordered.body) != ShapeKind::ellipsoid) {
    throw InvalidArgument(fmt::format("body {} is a {}; it must be an ellipsoid or a sphere", k,
                                      name(kind(ordered.body))));
  }
  const Ellipsoid body = sphere != nullptr ? Ellipsoid{sphere->radius * Vec3{1, 1, 1}, {}}
                                           : std::get<Ellipsoid>(ordered.body);
  if (2.0 * longest(body.semi_axes) >= shortest_edge(cell)) {
    throw InvalidArgument(fmt::format("body {} is {} long; it must be below {}, the shortest edge",
                                      k, 2.0 * longest(body.semi_axes), shortest_edge(cell)));
  }
  return body;
}

std::vector<Ellipsoid> checked_bodies(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  if (bodies.empty() || bodies.size() > kMostPublishedBodies) {
    throw InvalidArgument(fmt::format("{} bodies are ordered; allowed are 1 to {}", bodies.size(),
                                      kMostPublishedBodies));
  }
  std::vector<Ellipsoid> checked;
  double total = 0.0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    checked.push_back(checked_body(cell, bodies[k], static_cast<std::int64_t>(k)));
    total += volume(Body{checked.back()});
  }
  if (total >= volume(cell)) {
    throw InvalidArgument(
        fmt::format("the bodies fill {} of the cell; it must be below 1", total / volume(cell)));
  }
  return checked;
}

Vec3 random_in_cube(RandomStream& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

/// Lines 2 to 8 of Algorithm 1. `time`: at which the body has the size ordered.
MovingEllipsoid started(const Cell& cell, const Ellipsoid& ordered, double time, std::uint64_t k,
                        const PublishedOptions& options) {
  RandomStream places(options.seed, StreamId::event_driven_centers, k);
  RandomStream velocities(options.seed, StreamId::event_driven_velocities, k);
  const Vec3 place{places.uniform(), places.uniform(), places.uniform()};
  return {.center = scale(cell.size, place),
          .orientation = ordered.orientation,
          .velocity = shortest_edge(cell) * random_in_cube(velocities),
          .angular_velocity = random_in_cube(velocities),
          .semi_axes = options.start_size * ordered.semi_axes,
          .growth = ordered.semi_axes / time};
}

/// At the size ordered and unit density.
double kinetic_energy(const MovingEllipsoid& moving, const Vec3& semi_axes) {
  const Vec3 e_sq = scale(semi_axes, semi_axes);
  const Vec3 spin = mul_transposed(to_matrix(moving.orientation), moving.angular_velocity);
  const Vec3 inertia{e_sq.y + e_sq.z, e_sq.x + e_sq.z, e_sq.x + e_sq.y};
  const double mass = semi_axes.x * semi_axes.y * semi_axes.z;
  return mass * (norm_sq(moving.velocity) + dot(inertia, scale(spin, spin)) / 5.0);
}

/// The main loop, Algorithm 1.
class PublishedRun {
 public:
  PublishedRun(const Cell& cell, const std::vector<OrderedBody>& ordered,
               const PublishedOptions& options)
      : cell_(cell),
        options_(options),
        targets_(checked_bodies(cell, ordered)),
        pairs_(ordered.size()),
        faces_(ordered.size()) {
    double filled = 0.0, largest = 0.0;
    for (const Ellipsoid& target : targets_) {
      filled += volume(Body{target}) / volume(cell);
      largest = std::max(largest, longest(target.semi_axes));
    }
    target_time_ = largest / (options.growth_rate * shortest_edge(cell));
    clock_ = {.now = options.start_size * target_time_, .end = target_time_ / std::cbrt(filled)};
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      bodies_.push_back(started(cell, targets_[k], target_time_, k, options));
    }
    first_energy_ = energy();
  }

  PublishedResult run(RunContext& context) {
    result_.stop = until_stopped(context);
    result_.heating = energy() / first_energy_;
    result_.size_factor = std::min(1.0, clock_.now / target_time_);
    return std::move(result_);
  }

  /// Line 25 of Algorithm 1: the last event may lie beyond the time at which sizes are reached.
  [[nodiscard]] Inclusion inclusion(std::size_t k, int group, double size_factor) const {
    const Ellipsoid body{size_factor * targets_[k].semi_axes, bodies_[k].orientation};
    return {wrapped(cell_, bodies_[k].center), body, group};
  }

 private:
  PublishedStop until_stopped(RunContext& context) {
    for (;;) {
      result_.counts.missed += audit_.new_overlaps(cell_, bodies_);
      if (clock_.now >= target_time_) return PublishedStop::target_reached;
      const std::int64_t events = result_.counts.collisions + result_.counts.face_events;
      if (events >= options_.max_events) return PublishedStop::most_events;
      if (const StopRequest request = context.stop_request(); request != StopRequest::none) {
        return request == StopRequest::cancelled ? PublishedStop::cancelled
                                                 : PublishedStop::out_of_time;
      }
      context.report({.stage = "published events", .done = clock_.now / target_time_});
      next_event();
    }
  }

  /// Lines 11 to 21.
  void next_event() {
    const Collision collision = pairs_.next(cell_, bodies_, clock_, options_, result_.counts);
    Clock clock = clock_;
    clock.next = collision.time;
    const double face_time = faces_.next(cell_, bodies_, clock, options_);
    if (collision.time <= std::min(face_time, clock_.end)) {
      move_to(collision.time);
      collide(collision);
      ++result_.counts.collisions;
    } else {
      move_to(std::min(face_time, clock_.end));
      result_.counts.face_events += face_time <= clock_.end;
    }
  }

  void move_to(double time) {
    for (MovingEllipsoid& moving : bodies_) moving = published_moved(moving, time - clock_.now);
    clock_.now = time;
  }

  /// Images have the velocities of their bodies, lines 8 to 19 of Algorithm 9, since they are not
  /// bodies of their own here.
  void collide(const Collision& collision) {
    MovingEllipsoid& a = bodies_[collision.a];
    MovingEllipsoid& b = bodies_[collision.b];
    const auto [after_a, after_b] =
        published_impact(a, published::shifted(cell_, b, collision.shift), options_.growth_speed);
    a.velocity = after_a.velocity;
    a.angular_velocity = after_a.angular_velocity;
    b.velocity = after_b.velocity;
    b.angular_velocity = after_b.angular_velocity;
    for (const std::size_t body : {collision.a, collision.b}) {
      pairs_.forget(body);
      faces_.forget(body);
    }
  }

  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      sum += kinetic_energy(bodies_[k], targets_[k].semi_axes);
    }
    return sum;
  }

  const Cell& cell_;
  const PublishedOptions& options_;
  std::vector<Ellipsoid> targets_;
  std::vector<MovingEllipsoid> bodies_;
  PairForecasts pairs_;
  FaceForecasts faces_;
  Audit audit_;
  Clock clock_;
  double target_time_ = 0.0;
  double first_energy_ = 0.0;
  PublishedResult result_;
};

}  // namespace

std::string_view name(PublishedStop stop) noexcept {
  constexpr std::string_view names[] = {"target_reached", "most_events", "cancelled",
                                        "out_of_time"};
  return names[static_cast<int>(stop)];
}

PublishedResult published_event_driven_pack(const Cell& cell,
                                            const std::vector<OrderedBody>& bodies,
                                            const PublishedOptions& options, RunContext run) {
  check_options(options);
  check_cubic(cell);
  PublishedRun published_run(cell, bodies, options);
  PublishedResult result = published_run.run(run);
  result.packing.cell = cell;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    result.packing.inclusions.push_back(
        published_run.inclusion(k, bodies[k].group, result.size_factor));
  }
  return result;
}

}  // namespace packstone
