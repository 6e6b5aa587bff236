#include "packstone/generate/event_driven.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "generate/event_driven/engine.hpp"
#include "generate/event_driven/growth_schedule.hpp"
#include "generate/event_driven/run_state.hpp"
#include "generate/event_driven/spatial_order.hpp"
#include "generate/event_driven/starting_points.hpp"
#include "generate/ordered_bodies.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/equal_ball.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"

namespace packstone {
namespace {

namespace edmd = event_driven;
using edmd::Bodies;
using edmd::Progressed;

void refuse(const char* field, double value, const char* allowed) {
  throw InvalidArgument(
      fmt::format("EventDrivenOptions::{} is {}; it must be {}", field, value, allowed));
}

void check_options(const Cell& cell, const EventDrivenOptions& options) {
  check_min_gap(cell, options.min_gap, "EventDrivenOptions");
  if (!(options.growth_rate > 0.0 && options.growth_rate <= 10.0)) {
    refuse("growth_rate", options.growth_rate, "> 0 and <= 10");
  }
  if (!(options.slowest_growth > 0.0 && options.slowest_growth <= options.growth_rate)) {
    refuse("slowest_growth", options.slowest_growth, "> 0 and <= growth_rate");
  }
  if (!(options.collisions_per_body > 0.0 && std::isfinite(options.collisions_per_body))) {
    refuse("collisions_per_body", options.collisions_per_body, "a number > 0");
  }
}

bool may_turn(const EventDrivenOptions& options, int group) {
  const auto g = static_cast<std::size_t>(group);
  return g >= options.fixed_orientation.size() || !options.fixed_orientation[g];
}

void check_bodies(const Cell& cell, const std::vector<OrderedBody>& bodies,
                  const EventDrivenOptions& options) {
  std::int64_t k = 0;
  for (const OrderedBody& ordered : bodies) {
    check_ordered(cell, ordered, k);
    const Turn turn = may_turn(options, ordered.group) ? Turn::any : Turn::as_given;
    if (options.goal != EventDrivenGoal::densest) {
      check_alone(cell, ordered, k, options.min_gap, turn);
    }
    ++k;
  }
  if (options.goal != EventDrivenGoal::densest) check_room(cell, bodies, options.min_gap);
}

// Radius of the ball (disk) of the mean volume of all bodies.
double mean_radius(const Packing& packing) {
  const double mean =
      fraction(packing) * volume(packing.cell) / static_cast<double>(packing.inclusions.size());
  return equal_ball_radius(packing.cell.dimension, mean);
}

double nematic_order(const Packing& packing) {
  std::vector<Vec3> axes;
  for (const Inclusion& inclusion : packing.inclusions) {
    if (const auto axis = symmetry_axis(inclusion.body)) axes.push_back(*axis);
  }
  if (axes.empty()) return 0.0;
  return orientation_order(orientation_tensor(axes), packing.cell.dimension).nematic;
}

// A run from block to block.
class Run {
 public:
  Run(MovingPacking start, const EventDrivenOptions& options, RunContext run,
      const Checkpointing& checkpointing)
      : options_(options),
        run_(std::move(run)),
        checkpointing_(checkpointing),
        dimension_(start.packing.cell.dimension),
        count_(static_cast<double>(start.packing.inclusions.size())),
        full_(fraction(start.packing)),
        radius_(mean_radius(start.packing)),
        schedule_(options, full_, dimension_),
        last_checkpoint_(RunContext::Clock::now()) {
    result_.state = std::move(start);
    at_ = edmd::read_numbers(result_.state);
    if (!(at_.growth_rate > 0.0)) at_.growth_rate = options.growth_rate;
  }

  EventDrivenResult result() {
    bool done = count_ == 0.0;
    while (!done) done = run_block();
    finish();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool grows() const {
    return options_.goal != EventDrivenGoal::equilibrium || at_.grown == 0.0;
  }
  [[nodiscard]] bool has_target() const { return options_.goal != EventDrivenGoal::densest; }
  [[nodiscard]] double fraction_at(double size) const { return full_ * std::pow(size, dimension_); }

  edmd::BlockEnd block_end(const Bodies& bodies) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr std::int64_t kEventsPerCollision = 1000;
    constexpr double kLeastCollisions = 200.0;
    edmd::BlockEnd end;
    const double usual = schedule_.block_collisions(at_) * count_;
    end.collisions = static_cast<std::int64_t>(std::max(usual, kLeastCollisions));
    end.time = kInfinity;
    if (options_.published_stagnation) end.collisions = 50;
    if (!grows()) {
      const double left = options_.collisions_per_body * count_ - at_.still_collisions;
      end.collisions = std::min(end.collisions, static_cast<std::int64_t>(std::ceil(left)));
    } else {
      const double dilute = schedule_.dilute_until();
      const double until = bodies.size < dilute ? dilute : has_target() ? 1.0 : kInfinity;
      end.time = (until - bodies.size) / bodies.growth;
    }
    end.events = kEventsPerCollision * end.collisions;
    return end;
  }

  edmd::BlockCount run_engine(Bodies& bodies, const edmd::BlockEnd& end) {
    const Cell& cell = result_.state.packing.cell;
    const std::vector<std::int32_t> order = edmd::spatial_order(bodies, cell);
    bodies = edmd::in_order(bodies, order);
    const edmd::BlockCount block =
        edmd::Engine(bodies, cell)
            .run_block(end, run_, options_.check_every_event,
                       [this](double size, std::int64_t collisions) { report(size, collisions); });
    bodies = edmd::out_of_order(bodies, order);
    return block;
  }

  // Returns whether the run is over.
  bool run_block() {
    MovingPacking& state = result_.state;
    Bodies bodies = edmd::bodies_of(state, options_);
    double heat = 1.0;
    if (grows()) {
      heat = edmd::rescale_velocities(bodies, dimension_);
      bodies.growth = schedule_.rate(at_, bodies.size) / radius_;
    } else if (at_.energy == 0.0) {
      edmd::rescale_velocities(bodies, dimension_);
      at_.energy = edmd::total_energy(bodies);
    }
    const double size_before = bodies.size;
    const edmd::BlockEnd end = block_end(bodies);
    const edmd::BlockCount block = run_engine(bodies, end);
    const bool at_end = grows() && block.time >= end.time;
    const bool reached = at_end && has_target() && size_before >= schedule_.dilute_until();
    if (reached) bodies.size = 1.0;
    if (at_end && !reached) bodies.size = schedule_.dilute_until();
    if (block.stop != StopRequest::none) return interrupt(bodies, block.stop);
    edmd::store(bodies, state);
    count(block);
    note(bodies, block, heat);
    const bool over = is_over(block, reached, size_before);
    edmd::write_numbers(at_, state);
    checkpoint();
    report(state.size_factor, 0);
    return over;
  }

  // What has been reached is kept as a packing; a run that goes on from `state` begins the block
  // anew, so that it comes to where this one would have come.
  bool interrupt(const Bodies& bodies, StopRequest why) {
    MovingPacking now = result_.state;
    edmd::store(bodies, now);
    result_.packing = at_present_size(now);
    result_.size_factor = now.size_factor;
    return stop(why == StopRequest::cancelled ? EventDrivenStop::cancelled
                                              : EventDrivenStop::out_of_time);
  }

  void count(const edmd::BlockCount& block) {
    EventDrivenReport& report = result_.report;
    report.wall_collisions += block.wall_collisions;
    report.predictions += block.predictions;
    report.searches += block.searches.searches;
    report.steps += block.searches.steps;
    report.neighbor_searches += block.neighbor_searches;
    ++report.blocks;
    report.most_negative_gap =
        std::min({report.most_negative_gap, block.searches.least_gap, block.least_gap});
    at_.time += block.time;
    at_.collisions += static_cast<double>(block.collisions);
    if (grows()) return;
    at_.still_collisions += static_cast<double>(block.collisions);
    at_.virial += block.virial;
    at_.still_time += block.time;
  }

  // p V / (N k T) = 1 + virial / (dimension N k T time).
  [[nodiscard]] double reduced_pressure(const Bodies& bodies, double virial, double time) const {
    if (!(time > 0.0)) return 1.0;
    const edmd::Freedom freedom = edmd::freedom_of(bodies, dimension_);
    const double temperature =
        2.0 * edmd::total_energy(bodies) / (freedom.translation + freedom.rotation);
    return 1.0 + virial / (dimension_ * count_ * temperature * time);
  }

  void note(const Bodies& bodies, const edmd::BlockCount& block, double heat) {
    const double collisions = static_cast<double>(block.collisions);
    result_.history.push_back(
        {.time = at_.time,
         .collisions = static_cast<std::int64_t>(at_.collisions),
         .size_factor = bodies.size,
         .fraction = fraction_at(bodies.size),
         .growth_rate = bodies.growth * radius_,
         .reduced_pressure = reduced_pressure(bodies, block.virial, block.time),
         .collision_rate = block.time > 0.0 ? 2.0 * collisions / (count_ * block.time) : 0.0,
         .kinetic_energy = heat,
         .nematic_order = nematic_order(result_.state.packing)});
    EventDrivenReport& report = result_.report;
    report.reduced_pressure = result_.history.back().reduced_pressure;
    at_.pressure = report.reduced_pressure;
    if (grows()) return;
    report.reduced_pressure = reduced_pressure(bodies, at_.virial, at_.still_time);
    report.energy_drift = std::abs(edmd::total_energy(bodies) / at_.energy - 1.0);
  }

  bool stop(EventDrivenStop why) {
    result_.stop = why;
    return true;
  }

  bool is_over(const edmd::BlockCount& block, bool reached, double size_before) {
    if (!grows()) {
      // A body alone has nobody to meet.
      const bool done = at_.still_collisions >= options_.collisions_per_body * count_;
      return (done || block.collisions == 0) && stop(EventDrivenStop::target_reached);
    }
    if (reached) {
      at_.grown = 1.0;
      return options_.goal == EventDrivenGoal::target && stop(EventDrivenStop::target_reached);
    }
    const double gain = dimension_ * std::log(result_.state.size_factor / size_before);
    constexpr double kPublishedGain = 1e-3;
    if (options_.published_stagnation && gain < kPublishedGain) {
      return stop(EventDrivenStop::stagnated);
    }
    const edmd::BlockGain gained{gain, static_cast<double>(block.collisions) / count_,
                                 result_.history.back().growth_rate,
                                 result_.history.back().reduced_pressure};
    return schedule_.slow_down(at_, gained) && stop(EventDrivenStop::jammed);
  }

  void checkpoint() {
    if (!checkpointing_.write) return;
    const auto now = RunContext::Clock::now();
    if (std::chrono::duration<double>(now - last_checkpoint_).count() <
        checkpointing_.every_seconds) {
      return;
    }
    checkpointing_.write(result_.state);
    last_checkpoint_ = now;
  }

  // `collisions`: of the block that is going on.
  void report(double size, std::int64_t collisions) {
    const double now = fraction_at(size);
    double done = -1.0;
    if (!grows()) {
      done = (at_.still_collisions + static_cast<double>(collisions)) /
             (options_.collisions_per_body * count_);
    } else if (options_.goal == EventDrivenGoal::target) {
      done = now / full_;
    }
    run_.report({grows() ? "growing" : "colliding", done, now, 0, 0});
  }

  void finish() {
    if (result_.packing.inclusions.empty()) {
      result_.packing = at_present_size(result_.state);
      result_.size_factor = result_.state.size_factor;
    }
    result_.report.collisions = static_cast<std::int64_t>(at_.collisions);
    result_.report.growth_rate = at_.growth_rate;
  }

  const EventDrivenOptions& options_;
  RunContext run_;
  const Checkpointing& checkpointing_;
  int dimension_;
  double count_;
  double full_;    // Fraction at size factor 1.
  double radius_;  // Mean radius at size factor 1 [L].
  edmd::GrowthSchedule schedule_;
  Progressed at_;
  RunContext::Clock::time_point last_checkpoint_;
  EventDrivenResult result_;
};

// Nothing stands yet that could be kept.
EventDrivenResult interrupted_at_start(const MovingPacking& start, const RunContext& run) {
  EventDrivenResult result;
  result.stop = run.stop_request() == StopRequest::cancelled ? EventDrivenStop::cancelled
                                                             : EventDrivenStop::out_of_time;
  result.packing.cell = start.packing.cell;
  result.packing.groups = start.packing.groups;
  result.size_factor = 0.0;
  return result;
}

}  // namespace

std::string_view name(EventDrivenStop stop) noexcept {
  constexpr std::string_view names[] = {"target_reached", "jammed", "stagnated", "cancelled",
                                        "out_of_time"};
  return names[static_cast<int>(stop)];
}

EventDrivenResult event_driven_pack(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                    const EventDrivenOptions& options, RunContext run,
                                    const Checkpointing& checkpointing) {
  check_cell(cell);
  check_options(cell, options);
  check_bodies(cell, bodies, options);
  MovingPacking start = edmd::starting_points(cell, bodies, options, run);
  if (start.size_factor == 0.0) return interrupted_at_start(start, run);
  edmd::draw_velocities(options.seed, options, start);
  return Run(std::move(start), options, std::move(run), checkpointing).result();
}

EventDrivenResult event_driven_continue(MovingPacking start, const EventDrivenOptions& options,
                                        RunContext run, const Checkpointing& checkpointing) {
  check_cell(start.packing.cell);
  check_options(start.packing.cell, options);
  check_bodies(start.packing.cell, ordered_bodies(start.packing), options);
  if (start.velocity.empty()) edmd::draw_velocities(options.seed, options, start);
  check_moving(start);
  const Certificate certificate =
      check_packing(at_present_size(start), {.min_gap = options.min_gap});
  if (!certificate.passed()) {
    throw InvalidArgument(fmt::format(
        "the inclusions to start from are not proven to keep min_gap at size factor {}: worst pair "
        "{} and {}, gap {}",
        start.size_factor, certificate.worst_pair[0], certificate.worst_pair[1],
        certificate.smallest_gap));
  }
  return Run(std::move(start), options, std::move(run), checkpointing).result();
}

}  // namespace packstone
