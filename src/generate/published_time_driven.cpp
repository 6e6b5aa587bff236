#include "packstone/generate/published_time_driven.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "generate/ordered_bodies.hpp"
#include "generate/published_time_driven/dynamics.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {
namespace {

using time_driven::Dynamics;

template <class Value>
void check_number(const char* field, Value value, bool allowed, const char* range) {
  if (!allowed) {
    throw InvalidArgument(
        fmt::format("TimeDrivenOptions::{} is {}; it must be {}", field, value, range));
  }
}

void check_at_least_0(const char* field, double value) {
  check_number(field, value, value >= 0.0 && std::isfinite(value), "a number >= 0");
}

void check_at_least(const char* field, std::int64_t value, std::int64_t least) {
  check_number(field, value, value >= least, least == 0 ? ">= 0" : ">= 1");
}

void check_forces(const TimeDrivenOptions& o) {
  check_number("time_step", o.time_step, o.time_step > 0.0 && o.time_step <= 1.0, "in (0, 1]");
  check_number("rescale", o.rescale, o.rescale >= 1.0 && std::isfinite(o.rescale), "a number >= 1");
  check_number("rescale_limit", o.rescale_limit, o.rescale_limit >= 1.0 && o.rescale_limit <= 1e4,
               "in [1, 1e4]");
  check_number("rescale_limit", o.rescale_limit,
               o.rescale == 1.0 || o.time_step * o.time_step * o.rescale_limit < 1.0,
               "below 1 / time_step^2");
  check_at_least_0("damping", o.damping);
  check_at_least_0("berendsen", o.berendsen);
  check_at_least_0("berendsen_temperature", o.berendsen_temperature);
  check_at_least_0("nose_hoover", o.nose_hoover);
  check_at_least_0("nose_hoover_temperature", o.nose_hoover_temperature);
}

void check_schedule(const TimeDrivenOptions& o) {
  check_at_least_0("energy_threshold", o.energy_threshold);
  check_number("stagnation_drop", o.stagnation_drop,
               o.stagnation_drop > 0.0 && o.stagnation_drop < 1.0, "in (0, 1)");
  check_at_least("stagnation_steps", o.stagnation_steps, 1);
  check_at_least("reshuffles", o.reshuffles, 0);
  check_at_least("reshuffle_steps", o.reshuffle_steps, 1);
  check_at_least("max_steps", o.max_steps, 0);
  check_at_least("history_every", o.history_every, 1);
  check_at_least("overlap_volume_every", o.overlap_volume_every, 0);
  check_number("overlap_points", o.overlap_points,
               o.overlap_points >= 2 && o.overlap_points <= 512 && o.overlap_points % 2 == 0,
               "even, in [2, 512]");
}

void check_order(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  check_cell(cell);
  if (cell.dimension != 3) throw InvalidArgument("Cell::dimension is 2; it must be 3");
  if (bodies.empty() || bodies.size() > kMostTimeDrivenBodies) {
    throw InvalidArgument(fmt::format("{} bodies are ordered; allowed are 1 to {}", bodies.size(),
                                      kMostTimeDrivenBodies));
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto number = static_cast<std::int64_t>(k);
    check_ordered(cell, bodies[k], number);
    const ShapeKind shape = kind(bodies[k].body);
    if (shape != ShapeKind::sphere && shape != ShapeKind::cylinder) {
      throw InvalidArgument(
          fmt::format("body {} is a {}; it must be a sphere or a cylinder", k, name(shape)));
    }
    check_alone(cell, bodies[k], number, 0.0, Turn::any);
  }
}

// Uniform over the places at which the body is inside the walls as it is turned; in the middle
// where there are none.
Vec3 random_center(const Cell& cell, const Body& body, std::uint64_t seed, std::size_t k) {
  RandomStream random(seed, StreamId::time_driven_centers, k);
  const CenterBox box = centers_inside_walls(cell, half_extents(body));
  Vec3 center;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double u = random.uniform();
    const bool fits = box.lo[axis] <= box.hi[axis];
    center[axis] = fits ? box.lo[axis] + u * (box.hi[axis] - box.lo[axis]) : 0.5 * cell.size[axis];
  }
  return wrapped(cell, center);
}

Packing at_random_centers(const Cell& cell, const std::vector<OrderedBody>& bodies,
                          std::uint64_t seed) {
  std::vector<Vec3> centers(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    centers[k] = random_center(cell, bodies[k].body, seed, k);
  }
  return packing_at(cell, bodies, centers);
}

/// Steps until there is a reason to stop.
class Relaxation {
 public:
  Relaxation(Packing packing, const TimeDrivenOptions& options)
      : options_(options), result_{.packing = std::move(packing)} {
    result_.packing.certificate.reset();
    result_.packing.provenance.reset();
    fraction_ = fraction(result_.packing);
    threshold_ = options.energy_threshold * time_driven::squared_size(result_.packing) *
                 static_cast<double>(result_.packing.inclusions.size());
  }

  TimeDrivenResult run(RunContext& context) {
    Dynamics dynamics(result_.packing, options_);
    result_.start_energy = least_ = rescaled_at_ = dynamics.potential_energy();
    result_.stop = until_stopped(dynamics, context);
    if (result_.history.empty() || last_sampled_ != result_.steps) sample(dynamics);
    result_.potential_energy = dynamics.potential_energy();
    result_.kinetic_energy = dynamics.kinetic_energy();
    judge();
    return std::move(result_);
  }

 private:
  TimeDrivenStop until_stopped(Dynamics& dynamics, RunContext& context) {
    for (;;) {
      if (result_.steps % options_.history_every == 0) sample(dynamics);
      if (dynamics.potential_energy() <= threshold_) return TimeDrivenStop::relaxed;
      if (result_.steps >= options_.max_steps) return TimeDrivenStop::steps_used_up;
      if (const StopRequest request = context.stop_request(); request != StopRequest::none) {
        return request == StopRequest::cancelled ? TimeDrivenStop::cancelled
                                                 : TimeDrivenStop::out_of_time;
      }
      if (!go_on_when_stagnant(dynamics)) return TimeDrivenStop::stagnated;
      rescale(dynamics);
      context.report({.stage = "relaxing", .done = -1.0, .fraction = fraction_});
      dynamics.step();
      ++result_.steps;
    }
  }

  // The thermostat takes its time; what the energy does meanwhile does not count.
  [[nodiscard]] bool go_on_when_stagnant(Dynamics& dynamics) {
    if (hot_) {
      if (result_.steps - lowered_at_ >= options_.reshuffle_steps) switch_hot(dynamics, false);
      return true;
    }
    if (dynamics.potential_energy() < (1.0 - options_.stagnation_drop) * least_) {
      least_ = dynamics.potential_energy();
      lowered_at_ = result_.steps;
    }
    if (result_.steps - lowered_at_ < options_.stagnation_steps) return true;
    if (result_.reshuffles == options_.reshuffles) return false;
    ++result_.reshuffles;
    switch_hot(dynamics, true);
    return true;
  }

  void switch_hot(Dynamics& dynamics, bool on) {
    hot_ = on;
    dynamics.switch_nose_hoover(on);
    least_ = std::numeric_limits<double>::infinity();
    lowered_at_ = result_.steps;
  }

  void rescale(Dynamics& dynamics) {
    if (dynamics.potential_energy() > 0.5 * rescaled_at_) return;
    rescaled_at_ = dynamics.potential_energy();
    dynamics.set_force_factor(
        std::min(options_.rescale_limit, options_.rescale * dynamics.force_factor()));
  }

  void sample(const Dynamics& dynamics) {
    TimeDrivenSample sample{.time = static_cast<double>(result_.steps) * options_.time_step,
                            .potential_energy = dynamics.potential_energy(),
                            .kinetic_energy = dynamics.kinetic_energy(),
                            .force_factor = dynamics.force_factor(),
                            .friction = dynamics.friction()};
    const auto count = static_cast<std::int64_t>(result_.history.size());
    if (options_.overlap_volume_every > 0 && count % options_.overlap_volume_every == 0) {
      sample.overlap_volume = overlap_volume(result_.packing, options_.overlap_points);
      sample.overlap_measured = true;
    }
    result_.history.push_back(sample);
    last_sampled_ = result_.steps;
  }

  void judge() {
    const Certificate certificate = check_packing(result_.packing);
    result_.overlaps = certificate.overlaps;
    result_.deepest = std::max(0.0, -certificate.smallest_gap);
    result_.packing.certificate = certificate;
  }

  const TimeDrivenOptions& options_;
  TimeDrivenResult result_;
  double fraction_ = 0.0;
  double threshold_ = 0.0;
  double least_ = 0.0;
  double rescaled_at_ = 0.0;
  std::int64_t lowered_at_ = 0;  // Step of the least energy, or of the last switch.
  bool hot_ = false;
  std::int64_t last_sampled_ = 0;
};

}  // namespace

std::string_view name(TimeDrivenStop stop) noexcept {
  constexpr std::string_view names[] = {"relaxed", "stagnated", "steps_used_up", "cancelled",
                                        "out_of_time"};
  return names[static_cast<int>(stop)];
}

TimeDrivenResult published_time_driven_pack(const Cell& cell,
                                            const std::vector<OrderedBody>& bodies,
                                            const TimeDrivenOptions& options, RunContext run) {
  check_forces(options);
  check_schedule(options);
  check_order(cell, bodies);
  return Relaxation(at_random_centers(cell, bodies, options.seed), options).run(run);
}

TimeDrivenResult published_time_driven_relax(Packing start, const TimeDrivenOptions& options,
                                             RunContext run) {
  check_forces(options);
  check_schedule(options);
  check_well_formed(start);
  check_order(start.cell, ordered_bodies(start));
  return Relaxation(std::move(start), options).run(run);
}

}  // namespace packstone
