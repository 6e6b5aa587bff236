#pragma once

/// @file
/// Advancing layer: lay body after body where it comes to lie lowest, orientations kept.

#include <cstdint>
#include <optional>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/constructive.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone {

/// Options of advancing_layer_pack() and advancing_layer_fill(). Name what differs from the
/// defaults.
struct AdvancingLayerOptions {
  /// Least surface-to-surface gap of two inclusions [L]; none is kept to walls. >= 0.
  double min_gap = 0.0;

  /// Depth of the layer in which bodies are placed, over the largest half width of any body: h_TL
  /// of Ilin and Bernacki, equation 10 [-]. >= 2: below, a single large body closes the cavities
  /// beside it for good.
  double top_layer = 3.0;

  /// Places compared for each body, of which it takes the lowest [-]. >= 1. Absent: 1 to 24 for
  /// disks, more the nearer the sizes are to each other; for other bodies 60, in space 40 to 160,
  /// more the longer or flatter they are.
  std::optional<int> candidates = {};

  /// Part of the volume (area), of the smallest bodies, that is placed last, largest first, in
  /// holes from random heights upward [-]. In [0, 1]. What is placed stays exactly what is ordered.
  /// The more the denser, but what the holes do not take gathers at the top. Absent: first 0.03 of
  /// all sizes, so that these stay spread evenly; with the first restart the smallest, 0.02 to 0.1
  /// of them, more the wider the sizes are spread, and 1.7 times that with every other, up to 0.3.
  std::optional<double> held_back = {};

  /// Whether bodies go on into the room that is left, under the ceiling and below, when one finds
  /// no place in the layer on top. false: that one ends the run, as published; the top stays open,
  /// and nothing is held back.
  bool close_top = true;

  /// Further attempts, in other orders, where some of the bodies find no place [-]. >= 0. None
  /// where far too much is ordered.
  std::int64_t max_restarts = 4;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// What a run produced.
struct AdvancingLayerResult : ConstructiveResult {
  /// Part of the volume that was placed last [-]. Much more than 0.05: of the smallest bodies,
  /// which gather below the ceiling.
  double held_back = 0.0;

  /// Height of the highest point of all others [L]. Far below the ceiling: so much less is ordered
  /// than the cell has room for, and what is above stays empty but for some of the smallest.
  double top = 0.0;
};

/// Places all `bodies` in `cell`; docs/algorithms/advancing_layer.md tells how.
///
/// Every body touches two others, walls or the floor (three in 3D), and none is moved again. Sizes,
/// aspects and orientations are those given. A cell that is periodic along the vertical axis is
/// filled from a floor at 0, which is then taken away.
///
/// Good for: dense packings of any sizes and orientations, quickly.
/// Not for:  the densest ones: nothing is rearranged.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range, a body cannot
///          stand in the cell even alone, or all together need more room than there is.
/// Random:  stream advancing_layer, keyed by options.seed.
/// Cost:    some 10 us a disk, 0.4 ms an ellipse; flat in the number of bodies.
/// @post    check_packing(result.packing, {.min_gap = options.min_gap}) passes. Bodies that
///          found no place are absent, and stop is then `full`.
///
/// Reference: D. N. Ilin, M. Bernacki, MATEC Web Conf. 80 (2016) 02004.
[[nodiscard]] AdvancingLayerResult advancing_layer_pack(const Cell& cell,
                                                        const std::vector<OrderedBody>& bodies,
                                                        const AdvancingLayerOptions& options = {},
                                                        RunContext run = {});

/// Fills `cell` with the first bodies of an endless supply, as many as all find a place: the number
/// is searched for, in some five runs. With an open top one run does, up to the first body that
/// finds none. So no body is left out, and the laws of the supply hold to sampling error.
[[nodiscard]] AdvancingLayerResult advancing_layer_fill(const Cell& cell, const BodySource& source,
                                                        const AdvancingLayerOptions& options = {},
                                                        RunContext run = {});

}  // namespace packstone
