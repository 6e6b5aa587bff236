#pragma once

/// @file
/// Laguerre diagrams (power diagrams) of weighted points, their cells merged by owner.
///
/// The power of a point x with regard to a site i at p_i with weight w_i is
///
///     pow_i(x) = |x - p_i|^2 - w_i                                                         (1)
///
/// and its cell is where this is least among all sites and all their periodic images. The cells are
/// convex. Sites with a ball of radius r have w = r^2; disjoint balls lie in their own cells. A
/// site may be hidden, its cell empty. Adding one number to all weights changes nothing.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// A weighted point, one of those that an owner has.
struct LaguerreSite {
  Vec3 at;                 ///< Anywhere along periodic axes [L]; z = 0 in 2D.
  double weight = 0.0;     ///< [L^2]; r^2 of a ball. Any finite number.
  std::int32_t owner = 0;  ///< Whose cell this site's cell is a part of. >= 0.
};

/// The power diagram of `sites`, with the cells of one owner made one.
///
/// An owner stands where its sites do, unwrapped: facets between its sites vanish, those to its own
/// periodic images stay. The box is tiled whatever the sites are; an owner may get a cell that is
/// not convex, in parts, wrapped around the box, or empty.
///
/// Errors:  throws InvalidArgument if the box is not one, there is no site, a site is not finite
///          or an owner is not in [0, owners.size()).
/// Cost:    some 3 us a site in 2D, 15 us in 3D; parallel over sites, the same bits for any number
///          of threads.
/// @post    check_well_formed() passes: see docs/algorithms/laguerre.md for how vertices in one
///          place are found. The measures of all cells sum to that of the box to rounding.
///
/// @param owners  Center and group of each owner; parts is filled in.
[[nodiscard]] Tessellation power_diagram(const Cell& box, const std::vector<LaguerreSite>& sites,
                                         const std::vector<TessellationCell>& owners,
                                         const RunContext& run = {});

}  // namespace packstone
