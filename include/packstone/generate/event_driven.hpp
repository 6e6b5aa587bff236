#pragma once

/// @file
/// Event-driven molecular dynamics of hard bodies that fly, turn, collide and grow.

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/moving_packing.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// What a run is for.
enum class EventDrivenGoal {
  target,       ///< Grow until the bodies have the sizes ordered.
  densest,      ///< Grow, ever more slowly, until they jam or time is up; sizes scale together.
  equilibrium,  ///< Do not grow: simulate, and measure the pressure.
};

/// Options of event_driven_pack() and event_driven_continue(). Name what differs from the defaults.
struct EventDrivenOptions {
  EventDrivenGoal goal = EventDrivenGoal::target;

  /// Least surface-to-surface gap between two inclusions [L]. >= 0. It does not grow with them.
  double min_gap = 0.0;

  /// Growth rate to start from: how fast the radius of the ball of mean volume grows, over the
  /// thermal velocity [-]. In (0, 10]. A gas that is thin, of reduced pressure Z below 12, grows
  /// (12 / Z)^2 times as fast, up to a rate of 1; one that is dilute at 1.
  double growth_rate = 0.1;

  /// The slowest growth rate [-]. In (0, growth_rate]. target: the rate is halved, down to this,
  /// when the bodies jam; when they jam at this one the run ends. densest: the rate from where the
  /// fluid has become dense; the slower, the denser and the more ordered the packing, in inverse
  /// proportion to the time it takes. From a reduced pressure of 300 on nothing changes places any
  /// more, and the gaps are closed ten times as fast, at growth_rate at the most.
  double slowest_growth = 1e-3;

  /// Per group: keep the orientations as they are. Empty: all bodies turn.
  std::vector<bool> fixed_orientation = {};

  /// equilibrium: end after that many collisions per body [-]. > 0.
  double collisions_per_body = 1000.0;

  /// End as E. Ghossein and M. Levesque do (2013, section 6.3): when 50 events in a row have raised
  /// the fraction by less than 0.1 %. Far too early; for comparison.
  bool published_stagnation = false;

  /// Check all pairs after every event, N^2 of work each: a search for defects.
  bool check_every_event = false;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// Why a run stopped. All of these are ordinary outcomes; none is an exception.
enum class EventDrivenStop {
  target_reached,  ///< target: the bodies have the sizes ordered. equilibrium: all collisions done.
  jammed,          ///< They hardly grow any more, at the slowest growth rate.
  stagnated,       ///< The published criterion.
  cancelled,       ///< The run was cancelled; the packing so far is valid.
  out_of_time,     ///< The time limit passed; the packing so far is valid.
};

/// "target_reached", "jammed", ...
[[nodiscard]] std::string_view name(EventDrivenStop stop) noexcept;

/// One line of the history of a run: the means over the block of events that ended then.
struct EventDrivenSample {
  double time = 0.0;              ///< Since the start, in units of L / thermal velocity [T].
  std::int64_t collisions = 0;    ///< Since the start.
  double size_factor = 0.0;       ///< Of all lengths, over those ordered [-].
  double fraction = 0.0;          ///< Volume fraction [-].
  double growth_rate = 0.0;       ///< As EventDrivenOptions::growth_rate [-].
  double reduced_pressure = 0.0;  ///< p V / (N k T), from the virial of the collisions [-].
  double collision_rate = 0.0;    ///< Collisions per body and unit of time [1/T].
  double kinetic_energy = 0.0;    ///< Over that of thermal equilibrium, before rescaling [-].
  double nematic_order = 0.0;     ///< S of all bodies with an axis, orientation_order.hpp [-].
};

/// What a run cost, and what it saw.
struct EventDrivenReport {
  std::int64_t collisions = 0;         ///< Pairs, own images and walls.
  std::int64_t wall_collisions = 0;    ///< Of these, with walls.
  std::int64_t predictions = 0;        ///< Bodies whose next event was looked for.
  std::int64_t searches = 0;           ///< Pairs whose contact was searched for step by step.
  std::int64_t steps = 0;              ///< Steps of these searches.
  std::int64_t neighbor_searches = 0;  ///< Lists of near neighbors made anew.
  std::int64_t blocks = 0;             ///< Times that all clocks were set alike.
  /// The most negative gap that any search has started from [L]; >= 0: none ever overlapped.
  double most_negative_gap = 0.0;
  double energy_drift = 0.0;      ///< equilibrium: |E / E_0 - 1| at the end [-].
  double reduced_pressure = 0.0;  ///< Of the last blocks; equilibrium: of the whole run [-].
  double growth_rate = 0.0;       ///< At the end [-].
};

/// What a run produced.
struct EventDrivenResult {
  Packing packing;  ///< In the order given, at the size reached.
  EventDrivenStop stop = EventDrivenStop::target_reached;
  double size_factor = 1.0;  ///< Sizes reached over those ordered [-].
  EventDrivenReport report;
  std::vector<EventDrivenSample> history;
  MovingPacking state;  ///< From which event_driven_continue() goes on.
};

/// Called with the state at the end of a block of events, at most once in `every_seconds`.
struct Checkpointing {
  double every_seconds = 60.0;
  std::function<void(const MovingPacking&)> write;
};

/// Packs `bodies` into `cell`: they start small at random places, in the orientations given, fly,
/// turn and collide as hard bodies, and grow until they have the sizes given.
/// docs/algorithms/event_driven.md tells how.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range, a body cannot
///          stand in the cell even alone, or all together need more room than there is (for goal
///          densest, whose sizes are open, of these the first alone).
/// Cost:    a few microseconds per collision; tens of collisions per body far from jamming.
/// Random:  streams event_driven_centers and event_driven_velocities, keyed by options.seed; the
///          same bits on every processor.
/// @post    check_packing(result.packing, {.min_gap = options.min_gap}) passes.
///
/// Reference: B. D. Lubachevsky, F. H. Stillinger, J. Stat. Phys. 60 (1990) 561-583; A. Donev,
/// S. Torquato, F. H. Stillinger, J. Comput. Phys. 202 (2005) 737-793.
[[nodiscard]] EventDrivenResult event_driven_pack(const Cell& cell,
                                                  const std::vector<OrderedBody>& bodies,
                                                  const EventDrivenOptions& options = {},
                                                  RunContext run = {},
                                                  const Checkpointing& checkpointing = {});

/// The same from inclusions that stand already, free of overlap at their present size. With no
/// velocities given they are drawn. A run that is continued from the state of an interrupted one
/// gives the bits that it would have given.
[[nodiscard]] EventDrivenResult event_driven_continue(MovingPacking start,
                                                      const EventDrivenOptions& options = {},
                                                      RunContext run = {},
                                                      const Checkpointing& checkpointing = {});

}  // namespace packstone
