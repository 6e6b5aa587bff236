#pragma once

/// @file
/// The advancing layer algorithm of Ilin and Bernacki as published, for comparison only.
///
/// **Its ellipses overlap.** It knows an ellipse by circles inside it, and where those touch the
/// ellipses overlap, at nearly every contact; the areas of a published density count such places
/// twice. Every result says how many true pairs do and how deeply. Disks stay apart.
///
/// Bodies come in the order given. The first row is laid on the floor from left to right; then each
/// body takes a place in contact with two that stand, found by going through pairs: the first
/// partner is of the top layer, whose bodies have heights H_E (highest ordinates) with
///
///     H_max - H_E < h_TL a_max                                          paper (10)         (1)
///
/// from the lowest one up; the second is any whose rectangle meets the candidate domain, the
/// rectangle of the first widened by that of the new body, from the lowest one up. For a circle of
/// the new body and one of each partner, with offsets o from its center c,
///
///     |c + o_g - p_q| = R_g + R_q,   |c + o_f - p_p| = R_f + R_p                           (2)
///
/// have two solutions, "beneath" and "above". The first at which the new body lies inside the walls
/// and overlaps nothing, rectangles tested first, then circle by circle, is taken.
///
/// Reference: D. N. Ilin, M. Bernacki, "A new algorithm for dense ellipse packing and polygonal
/// structures generation in context of FEM or DEM", MATEC Web of Conferences 80 (2016) 02004.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/constructive.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone {

/// Options of published_advancing_layer_pack() and its kin. Name what differs from the defaults.
struct PublishedLayerOptions {
  /// x_1 over the minor half axis b, the precision of the multi-circles [-]; not printed. In
  /// [0.01, 1].
  double spacing = 0.5;

  /// h_TL of equation (1) [-]; printed: from 1.1 to 2. > 0; infinite: all bodies are tried.
  double top_layer = 2.0;

  /// a_max of equation (1) [L]. >= 0; 0: of the list, or the largest one so far of an endless
  /// supply.
  double largest_semi_axis = 0.0;
};

/// What is true of a packing of multi-circles.
struct TrueOverlaps {
  std::int64_t pairs = 0;  ///< Pairs of true bodies, with image, that are not proven apart.
  double deepest = 0.0;    ///< Deepest overlap of a pair over the smaller of both b, radii of the
                           ///< largest balls about the center that the bodies hold [-].
  double mean = 0.0;       ///< Mean over these pairs [-]; 0: none.
};

/// Measures every near pair by gap(). Groups need no names.
///
/// Errors:  throws InvalidArgument if a body is malformed or not of the dimension of the cell.
[[nodiscard]] TrueOverlaps true_overlaps(const Packing& packing);

/// What a run produced.
struct PublishedLayerResult : ConstructiveResult {
  TrueOverlaps overlaps{};       ///< Read this beside the fraction.
  std::int64_t first_row = 0;    ///< Bodies laid upon the floor.
  std::int64_t pairs_tried = 0;  ///< Pairs of partners.
};

/// Packs disks and ellipses, turned as given, into `cell`, in the order given. Along x the cell is
/// periodic, which the paper does not know, or has walls.
///
/// Good for: seeing what the published method does.
/// Not for:  packings, as ellipses overlap.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range, the cell is not
///          2D or is periodic along y, or a body is neither disk nor ellipse or cannot stand in the
///          cell even alone.
/// Random:  nothing is.
/// Cost:    some 20 us per disk, 1 to 10 ms per ellipse, as its circles are many.
[[nodiscard]] PublishedLayerResult published_advancing_layer_pack(
    const Cell& cell, const std::vector<OrderedBody>& bodies,
    const PublishedLayerOptions& options = {}, RunContext run = {});

/// The same from an endless supply, until the first body that has no position. One that could not
/// stand in the cell even alone ends the run too, unless it is the first: that is refused.
[[nodiscard]] PublishedLayerResult published_advancing_layer_fill(
    const Cell& cell, const BodySource& source, const PublishedLayerOptions& options = {},
    RunContext run = {});

}  // namespace packstone
