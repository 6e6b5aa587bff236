#pragma once

/// @file
/// Random sequential adsorption: place inclusions one by one, never move one again.

#include <cstdint>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Which inclusion comes next.
enum class RsaOrder {
  largest_first,  ///< By volume, descending; ties in the order given.
  as_given,       ///< Group after group, as Salnikov et al. (2014) do.
  shuffled,       ///< A random order.
};

/// Options of rsa_pack() and its kin. Name what differs from the defaults.
struct RsaOptions {
  /// Least surface-to-surface gap between two inclusions [L]. >= 0.
  double min_gap = 0.0;

  /// Which inclusion comes next.
  RsaOrder order = RsaOrder::largest_first;

  /// Per group: redraw the orientation, uniformly, with every trial. Favors the orientations that
  /// fit, so the result no longer follows the law ordered. Empty: never.
  std::vector<bool> redraw_orientation = {};

  /// Rejected trials in a row after which an inclusion is given up, where no proof is reached
  /// before [-]. >= 1.
  std::int64_t max_trials = 10'000'000;

  /// Fresh starts after an inclusion that was proven not to fit, or given up [-]. >= 0.
  /// A packing reached after a restart is RSA conditioned on success. Fewer where they would be
  /// hopeless: when eight or more starts have all ended far below the volume ordered, by twelve
  /// standard deviations of what they reached and twelve largest bodies.
  std::int64_t max_restarts = 1'000'000;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// Why a run stopped. All of these are ordinary outcomes; none is an exception.
enum class RsaStop {
  target_reached,  ///< Every inclusion ordered stands.
  saturated,       ///< Proven: the next inclusion fits nowhere (restarts used up, or hopeless).
  given_up,        ///< max_trials in a row failed (restarts used up, or hopeless).
  cancelled,       ///< The run was cancelled; the packing so far is valid.
  out_of_time,     ///< The time limit passed; the packing so far is valid.
};

/// "target_reached", "saturated", ...
[[nodiscard]] std::string_view name(RsaStop stop) noexcept;

/// What a run produced and what it cost.
struct RsaResult {
  Packing packing;  ///< In the order of the bodies given; those not placed are
                    ///< absent. Group names are left to the caller.
  RsaStop stop = RsaStop::target_reached;  ///< Read this before trusting the count.
  std::int64_t trials = 0;                 ///< Positions tried, over all starts.
  std::int64_t restarts = 0;               ///< Fresh starts.
};

/// Packs `bodies` into `cell` by random sequential adsorption.
///
/// For each body in turn: draw a center, accept it if the body keeps min_gap to every image of
/// every placed body and to its own, stays inside the walls, else draw another. Sizes are never
/// redrawn. When a body keeps failing, the cell is searched with voxels: a voxel whose corners all
/// lie in the (convex) contact region of one placed body holds no center, so it is dropped; the
/// others are tried and split until the body stands or none is left, which proves that it fits
/// nowhere. See docs/algorithms/rsa.md.
///
/// More than 150 equal spheres or disks take the way of rsa_saturate(), which is faster and has the
/// same law; there a start ends with the proof that nothing more fits, and max_trials has no part.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range or a body cannot
///          stand in the cell even alone.
/// Random:  streams rsa_center, rsa_orientation, rsa_voxel, rsa_order, keyed by options.seed; the
///          same bits for any number of threads.
/// @post    check_packing(result.packing, {.min_gap = options.min_gap}) passes.
///
/// Reference: B. Widom, J. Chem. Phys. 44 (1966) 3888-3894.
[[nodiscard]] RsaResult rsa_pack(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                 const RsaOptions& options = {}, RunContext run = {});

/// Fills `cell` with equal spheres or disks of `radius` until no further one fits, proven: the list
/// of voxels that may still hold a center is empty.
///
/// Reference: G. Zhang, S. Torquato, Phys. Rev. E 88 (2013) 053312.
[[nodiscard]] RsaResult rsa_saturate(const Cell& cell, double radius,
                                     const RsaOptions& options = {}, RunContext run = {});

/// Fills `cell` from `source`, body after body in the order of the source, until one is proven to
/// fit nowhere, or given up. A body that does not fit ends the run; nothing is skipped. One that
/// could not stand in the cell even alone does so too, unless it is the first: that is refused.
[[nodiscard]] RsaResult rsa_fill(const Cell& cell, const BodySource& source,
                                 const RsaOptions& options = {}, RunContext run = {});

}  // namespace packstone
