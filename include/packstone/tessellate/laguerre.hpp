#pragma once

/// @file
/// Polygons and polyhedra from a packing: each inclusion gets a cell of its measure and its shape.
///
/// As published (D. N. Ilin, M. Bernacki, MATEC Web Conf. 80 (2016) 02004) each inclusion is
/// replaced by circles inside it, and the cells of these in the Laguerre diagram are made one. What
/// the cells then are is left to the gaps between the inclusions. Here
///
/// - the bodies grow by fraction^(-1/d) before the balls are put into them, so that they share the
///   whole box among each other as they share the packing;
/// - the balls of each inclusion get one more weight, by which the measures of all cells become
///   exactly proportional to those of the inclusions;
/// - on request the balls (in the plane) or the bodies that they are put into (in space) are moved
///   until the cells have the aspect and the orientation that the inclusions have.

#include <cstdint>
#include <vector>

#include "packstone/core/run_context.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// Options of laguerre_tessellate(). Name what differs from the defaults; published_laguerre() has
/// those of the paper.
struct LaguerreOptions {
  /// Of the balls inside each body, see inscribed_balls() [-]. In [0.01, 1].
  double spacing = 0.5;

  /// Whether bodies grow by fraction^(-1/d) before the balls are put into them. Not so in the plane
  /// where shapes are ordered: the rounds begin better from bodies that do not overlap.
  bool inflate = true;

  /// Whether cells get measures exactly proportional to those of the inclusions.
  bool ordered_measures = true;

  /// Largest |measure / ordered - 1| that is left of that [-]. In [1e-12, 1].
  double measure_tolerance = 1e-9;

  /// Newton's steps for that, at most. >= 1.
  int max_newton_steps = 100;

  /// Where there are walls: whether cells that touch one keep the measure they are found with, and
  /// only the others share the rest of the box in proportion. In a box that is filled up to an open
  /// top the cells there are too large, and to make them smaller would pull all others out of
  /// shape.
  bool keep_wall_cells = true;

  /// Whether sites whose cells lie apart from the rest of their owner are taken out, so that cells
  /// are connected. Only where measures are ordered, or shapes in the plane.
  bool connected = true;

  /// Rounds in which the shapes of the cells are brought to those ordered: 10 to 20 do. >= 0; 0:
  /// none, and no body is moved.
  int shape_rounds = 0;

  /// Share of the error of a shape that one round in space takes back [-]. In (0, 2).
  double shape_gain = 0.6;

  /// Share of the way to the centroid of its cell that a body is moved in one round in space [-].
  /// In [0, 1].
  double center_gain = 0.8;
};

/// The options of the published method: circles into the inclusions as they are, nothing else.
[[nodiscard]] constexpr LaguerreOptions published_laguerre() {
  return {.inflate = false, .ordered_measures = false};
}

/// Why a tessellation is what it is. All of these are ordinary outcomes.
enum class LaguerreStop {
  finished,     ///< All that was asked for.
  stalled,      ///< The measures did not come within the tolerance.
  cancelled,    ///< The tessellation is the best so far.
  out_of_time,  ///< The tessellation is the best so far.
};

/// How cells differ from the inclusions that they were made for.
///
/// Measures are compared as shares of the whole: V_g / B_g over sum V / sum B, both sums over the
/// cells that count. Shapes are compared by the ellipses or ellipsoids of equal second moments.
struct LaguerreErrors {
  std::int64_t cells = 0;  ///< That count: in a box with walls those that touched none at first.
  double measure_spread = 0.0;         ///< Standard deviation of the share over that ordered [-].
  double largest_measure_error = 0.0;  ///< Largest |share / ordered - 1| [-].

  std::int64_t elongated = 0;  ///< Cells of inclusions of aspect above 1.05: of these what follows.
  double aspect_mean = 1.0;    ///< Mean of aspect / ordered aspect [-].
  double aspect_spread = 0.0;  ///< Its standard deviation [-].
  double angle_mean = 0.0;     ///< Mean angle between the axes, see angle_between_shapes() [rad].
  double angle_p95 = 0.0;      ///< What 95 % of the angles are below [rad].

  /// Mean distance of the centroid of a cell from the center of its inclusion, over the radius of
  /// the disk or ball of its measure [-], and the largest.
  double offset_mean = 0.0;
  double largest_offset = 0.0;

  std::int64_t empty = 0;     ///< Of all cells: those without measure.
  std::int64_t in_parts = 0;  ///< Of all cells: those that are not connected.
};

/// What a run did.
struct LaguerreReport {
  std::int64_t sites = 0;         ///< Balls.
  std::int64_t hidden_sites = 0;  ///< Those without a cell of their own.
  int shape_rounds = 0;
  int newton_steps = 0;      ///< Over all rounds.
  int diagrams = 0;          ///< Made, over all rounds.
  LaguerreErrors published;  ///< Of the cells that published_laguerre() makes.
  LaguerreErrors made;       ///< Of the cells returned.
};

/// What laguerre_tessellate() produced.
struct LaguerreResult {
  Tessellation tessellation;      ///< One cell per inclusion, in order.
  std::vector<CellShape> shapes;  ///< Of its cells.
  LaguerreStop stop = LaguerreStop::finished;
  LaguerreReport report;
};

/// A Laguerre tessellation of the cell of `packing`, one cell per inclusion.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range, the packing is
///          not well formed or has no inclusion, or an inclusion is of endless length: see
///          check_images().
/// Cost:    some 5 us a ball in 2D and 25 us in 3D; each of Newton's steps half of that again, each
///          round two to four such steps. The same bits for any number of threads.
/// @post    check_well_formed(result.tessellation) passes; the measures sum to that of the cell.
[[nodiscard]] LaguerreResult laguerre_tessellate(const Packing& packing,
                                                 const LaguerreOptions& options = {},
                                                 RunContext run = {});

/// The angle between two shapes [rad], in [0, pi / 2]: between the longest axes, or between the
/// shortest ones where `a` is flat rather than long (b / c > a / b of the semi-axes a >= b >= c).
[[nodiscard]] double angle_between_shapes(int dimension, const CellShape& a,
                                          const CellShape& b) noexcept;

/// The shape of a body, to compare cells with.
[[nodiscard]] CellShape shape_of_body(const Body& body) noexcept;

}  // namespace packstone
