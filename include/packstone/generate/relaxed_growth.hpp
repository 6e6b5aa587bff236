#pragma once

/// @file
/// Growth by relaxation: as dense as bodies come to rest.

#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Options of grow_relaxed(). Name what differs from the defaults.
struct RelaxedGrowthOptions {
  /// Of every relaxation. max_restarts is for the first one: the others go on from where bodies
  /// rest.
  RelaxationOptions relaxation = {};

  /// Lengths at the start, over those ordered [-]. > 0. Halved in volume where bodies do not come
  /// to rest.
  double start_factor = 1.0;

  /// By how much of their volume bodies grow at first [-]. In (0, 1].
  double first_step = 0.08;

  /// The step is halved whenever they do not come to rest; below this one they are jammed [-]. In
  /// (0, first_step].
  double least_step = 0.002;
};

/// What a run produced.
struct RelaxedGrowthResult {
  Packing packing;           ///< In the order given, all lengths scaled by size_factor.
  double size_factor = 1.0;  ///< Lengths over those ordered [-].
  /// No two overlap, and all gaps exceed min_gap. False only where a run is stopped, or gives up,
  /// before anything has come to rest.
  bool at_rest = false;
  RelaxationStop stop = RelaxationStop::jammed;  ///< jammed, stalled, cancelled or out_of_time.
  RelaxationReport report;                       ///< Over all steps.
  std::vector<RelaxationSample> history;         ///< Of the last attempt.
};

/// Relaxes `bodies`, as large as start_factor has them, and lets all grow by one factor and relax
/// again, until the step by which they still come to rest is below the least one. Keeps the last
/// state at rest: that is handed out, whatever ends the run.
///
/// Good for: the highest fractions of long fibers, with their orientation tensors held.
/// Not for:  compact bodies: event-driven growth packs them denser.
///
/// Errors:  as relaxation_pack() for the bodies at the start; InvalidArgument too if an option is
///          out of range.
/// Random:  as relaxation_pack(); the same bits for any number of threads.
/// @post    at_rest: check_packing(packing, {.min_gap = min_gap}) passes.
[[nodiscard]] RelaxedGrowthResult grow_relaxed(const Cell& cell,
                                               const std::vector<OrderedBody>& bodies,
                                               const RelaxedGrowthOptions& options = {},
                                               RunContext run = {},
                                               const RelaxationStart& start = {});

}  // namespace packstone
