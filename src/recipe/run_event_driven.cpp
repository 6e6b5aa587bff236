#include "recipe/run_event_driven.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "recipe/compare_groups.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/rsa_start.hpp"

namespace packstone::recipe {
namespace {

// The fraction from which bodies grow after random sequential adsorption, unless ordered.
constexpr double kStartFraction = 0.2;

EventDrivenOptions options_of(const Recipe& recipe) {
  const EventDrivenSettings& settings = recipe.event_driven;
  return {.goal = settings.goal,
          .min_gap = recipe.min_gap,
          .growth_rate = settings.growth_rate,
          .slowest_growth = settings.slowest_growth,
          .fixed_orientation = fixed_orientations(recipe),
          .collisions_per_body = settings.collisions_per_body,
          .published_stagnation = settings.published_stagnation,
          .check_every_event = settings.check_every_event,
          .seed = recipe.seed};
}

bool reached(EventDrivenGoal goal, const InclusionMix& mix, const EventDrivenResult& result) {
  if (goal != EventDrivenGoal::densest) return result.stop == EventDrivenStop::target_reached;
  const bool all_stand = result.packing.inclusions.size() == mix.bodies.size();
  return all_stand && result.stop != EventDrivenStop::cancelled;
}

PackOutcome outcome_of(const Recipe& recipe, const InclusionMix& mix, EventDrivenResult result) {
  PackOutcome outcome;
  outcome.target_reached = reached(recipe.event_driven.goal, mix, result);
  outcome.packing = std::move(result.packing);
  outcome.stop = name(result.stop);
  outcome.motion = MotionOutcome{result.size_factor, result.report, std::move(result.history)};
  outcome.groups = compare_groups(recipe, mix, outcome.packing);
  const std::vector<bool> turned = turned_groups(recipe, PackMethod::event_driven);
  for (std::size_t g = 0; g < turned.size(); ++g) outcome.groups[g].turned = turned[g];
  return outcome;
}

// A run that was told to stop is gone on with later: its last state is worth a checkpoint.
PackOutcome finished(const Recipe& recipe, const InclusionMix& mix, EventDrivenResult result,
                     const Checkpointing& checkpointing) {
  const bool halted =
      result.stop == EventDrivenStop::cancelled || result.stop == EventDrivenStop::out_of_time;
  const bool began = result.state.size_factor > 0.0;
  if (halted && began && checkpointing.write) checkpointing.write(result.state);
  return outcome_of(recipe, mix, std::move(result));
}

PackOutcome run_from_points(const Recipe& recipe, const InclusionMix& mix, const RunContext& run,
                            const Checkpointing& checkpointing) {
  return finished(
      recipe, mix,
      event_driven_pack(recipe.cell, mix.bodies, options_of(recipe), run, checkpointing),
      checkpointing);
}

// Bodies of full size in place of the smaller ones that stand.
MovingPacking at_rest(const Recipe& recipe, const Packing& placed,
                      const std::vector<OrderedBody>& bodies, double factor) {
  MovingPacking start;
  start.packing.cell = recipe.cell;
  start.packing.groups = group_names(recipe);
  start.packing.inclusions = placed.inclusions;
  for (std::size_t i = 0; i < bodies.size(); ++i) start.packing.inclusions[i].body = bodies[i].body;
  start.size_factor = factor;
  return start;
}

std::string start_sentence(const RsaResult& placed, const Cell& cell) {
  Packing standing;
  standing.cell = cell;
  standing.inclusions = placed.packing.inclusions;
  const std::string fraction_text = number_text(fraction(standing), 3);
  if (placed.stop == RsaStop::target_reached) {
    return "grown from a fraction of " + fraction_text + " that rsa has placed";
  }
  return "rsa did not place all that were to grow from there (it ended at a fraction of " +
         fraction_text + "), so they grew from points";
}

PackOutcome run_from_rsa(const Recipe& recipe, const InclusionMix& mix, const RunContext& run,
                         const Checkpointing& checkpointing) {
  const double wanted =
      start_factor(recipe, mix.bodies, recipe.event_driven.start_fraction, kStartFraction);
  const bool ordered = recipe.event_driven.start_fraction.has_value();
  auto [placed, factor] = place_smaller(recipe, mix.bodies, wanted, ordered, recipe.seed, run);
  PackOutcome outcome;
  if (placed.stop == RsaStop::target_reached) {
    outcome = finished(recipe, mix,
                       event_driven_continue(at_rest(recipe, placed.packing, mix.bodies, factor),
                                             options_of(recipe), run, checkpointing),
                       checkpointing);
  } else if (run.stop_request() == StopRequest::none) {
    outcome = run_from_points(recipe, mix, run, checkpointing);
  } else {
    EventDrivenResult halted;
    halted.stop = placed.stop == RsaStop::cancelled ? EventDrivenStop::cancelled
                                                    : EventDrivenStop::out_of_time;
    halted.size_factor = factor;
    halted.packing = std::move(placed.packing);
    outcome = outcome_of(recipe, mix, std::move(halted));
  }
  outcome.derived.push_back(start_sentence(placed, recipe.cell));
  outcome.trials = placed.trials;
  outcome.restarts = placed.restarts;
  return outcome;
}

// The number in `a` and `b` is the same but for rounding.
bool alike(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(a, b); }

// Throws unless the inclusions of `state` are those ordered, wherever they are and as they turned.
void check_state(const Recipe& recipe, const InclusionMix& mix, const MovingPacking& state) {
  check_moving(state);
  const auto refuse = [](const std::string& what) {
    throw InvalidArgument("the checkpoint does not belong to the recipe: " + what);
  };
  const std::vector<Inclusion>& inclusions = state.packing.inclusions;
  if (state.packing.cell != recipe.cell) refuse("it has another cell");
  if (state.packing.groups != group_names(recipe)) refuse("it has other groups");
  if (inclusions.size() != mix.bodies.size()) {
    refuse("it holds " + std::to_string(inclusions.size()) + " inclusions of " +
           std::to_string(mix.bodies.size()) + " ordered");
  }
  for (std::size_t i = 0; i < inclusions.size(); ++i) {
    const OrderedBody& ordered = mix.bodies[i];
    const bool same = inclusions[i].group == ordered.group &&
                      kind(inclusions[i].body) == kind(ordered.body) &&
                      alike(volume(inclusions[i].body), volume(ordered.body)) &&
                      alike(circum_radius(inclusions[i].body), circum_radius(ordered.body));
    if (!same) refuse("inclusion " + std::to_string(i) + " is another one");
  }
}

}  // namespace

PackOutcome run_event_driven(const Recipe& recipe, const InclusionMix& mix, const RunContext& run,
                             const Checkpointing& checkpointing) {
  return recipe.event_driven.start == GrowthStart::rsa
             ? run_from_rsa(recipe, mix, run, checkpointing)
             : run_from_points(recipe, mix, run, checkpointing);
}

PackOutcome continue_event_driven(const Recipe& recipe, const InclusionMix& mix,
                                  MovingPacking state, const RunContext& run,
                                  const Checkpointing& checkpointing) {
  check_state(recipe, mix, state);
  return finished(recipe, mix,
                  event_driven_continue(std::move(state), options_of(recipe), run, checkpointing),
                  checkpointing);
}

}  // namespace packstone::recipe
