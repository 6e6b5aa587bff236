#pragma once

/// @file
/// Relaxation: bodies that overlap push each other apart until none does.

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// How the bodies of a group may turn.
enum class RelaxationTurn {
  hold_tensor,  ///< Each turns, but the mean of u u^T over the group stays what it is.
  free,         ///< Each turns as it is pushed.
  locked,       ///< None turns.
};

/// Options of relaxation_pack() and relax(). Name what differs from the defaults.
struct RelaxationOptions {
  /// Least surface-to-surface gap between two inclusions [L]. >= 0.
  double min_gap = 0.0;

  /// How much wider than min_gap the gaps are made, over the least half-width of the smaller body
  /// [-]. In (0, 0.1]. The bodies are pushed as if each pair had to keep all of it, and at rest
  /// when each has half of it, which every sequence of ever smaller overlaps comes to.
  double inflation = 1e-3;

  /// Per group. Empty: hold_tensor for all.
  std::vector<RelaxationTurn> turn = {};

  /// Steps that lower the energy by less than a fifth before some of those that overlap most are
  /// moved elsewhere [-]. >= 1. As many more after every three rounds of such moves without a new
  /// least energy. Three times as many that lower it by less than 3 % end a descent in any case.
  std::int64_t patience = 20;

  /// Share of the bodies that are then moved, at most [-]. In [0, 1]; 0: none, the attempt ends.
  double relocated_share = 0.04;

  /// Rounds of such moves without a new least energy after which an attempt ends [-]. >= 0.
  std::int64_t max_relocations = 30;

  /// Further attempts, from other starts [-]. >= 0. relax() makes one attempt.
  std::int64_t max_restarts = 1000;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// Why a run stopped. All of these are ordinary outcomes; none is an exception.
enum class RelaxationStop {
  target_reached,  ///< No two overlap, and all gaps exceed min_gap.
  stalled,         ///< They overlap, and no attempt found a way on.
  jammed,          ///< They rest, and no larger ones did: of grow_relaxed() alone.
  cancelled,       ///< The run was cancelled; the packing is the best state so far.
  out_of_time,     ///< The time limit passed; the packing is the best state so far.
};

/// "target_reached", "stalled", ...
[[nodiscard]] std::string_view name(RelaxationStop stop) noexcept;

/// One line of the history of an attempt.
struct RelaxationSample {
  std::int64_t iteration = 0;
  double energy = 0.0;        ///< Half the sum of the squared depths [L^2].
  double deepest = 0.0;       ///< Greatest depth of two bodies with their shells [L].
  std::int64_t contacts = 0;  ///< Pairs, own images and walls that push.
};

/// What a run cost, and how it ended.
struct RelaxationReport {
  std::int64_t restarts = 0;           ///< Attempts after the first.
  std::int64_t iterations = 0;         ///< Steps, over all attempts.
  std::int64_t evaluations = 0;        ///< Of the energy.
  std::int64_t neighbor_searches = 0;  ///< Lists of near pairs made anew.
  std::int64_t relocated = 0;          ///< Bodies moved elsewhere.
  double energy = 0.0;                 ///< Of the packing returned [L^2].
  double deepest = 0.0;                ///< In the packing returned [L].
};

/// What a run produced.
struct RelaxationResult {
  Packing packing;  ///< In the order given. Overlaps remain unless stop is target_reached.
  RelaxationStop stop = RelaxationStop::target_reached;
  RelaxationReport report;
  std::vector<RelaxationSample> history;  ///< Of the last attempt, thinned to some 1000 lines.
};

/// Centers for the bodies from which an attempt starts [L]; anywhere, overlapping or not. Bodies
/// for which there is none start at random places.
using RelaxationStart = std::function<std::vector<Vec3>(std::int64_t attempt)>;

/// Moves and turns `bodies`, from centers that `start` gives (none: random ones), until no two of
/// them, of their periodic images and of the walls overlap. docs/algorithms/relaxation.md tells
/// how.
///
/// Energy: with g_ij the gap, G_ij = min_gap + inflation * least half-width of the smaller,
///     E = 1/2 sum max(0, G_ij - g_ij)^2                                                    (1)
/// is minimized by the limited-memory method of Broyden, Fletcher, Goldfarb and Shanno. The end is
/// max (G_ij - g_ij) <= (G_ij - min_gap) / 2, each gap proven by a direction.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range, a body cannot
///          stand in the cell even alone, or all together need more room than there is.
/// Random:  streams relaxation_centers and relaxation_places, keyed by options.seed; the same bits
///          for any number of threads.
/// @post    stop is target_reached exactly if check_packing(packing, {.min_gap = min_gap}) passes
///          or would have passed at an earlier step.
///
/// Reference: D. C. Liu, J. Nocedal, Math. Program. 45 (1989) 503-528.
[[nodiscard]] RelaxationResult relaxation_pack(const Cell& cell,
                                               const std::vector<OrderedBody>& bodies,
                                               const RelaxationOptions& options = {},
                                               RunContext run = {},
                                               const RelaxationStart& start = {});

/// The same from inclusions that stand somewhere: opens their gaps to min_gap, or takes their
/// overlaps away. One attempt.
[[nodiscard]] RelaxationResult relax(const Packing& packing, const RelaxationOptions& options = {},
                                     RunContext run = {});

}  // namespace packstone
