#pragma once

/// @file
/// The cells of a tessellation as closed outlines, whole: each stands where its inclusion does.

#include <cstdint>
#include <vector>

#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// Corners in order; the last is followed by the first.
using CornerLoop = std::vector<FacetCorner>;

/// A connected part of a cell.
///
/// In 2D the loops are outlines: the first one counterclockwise, those that follow are holes in it
/// and run clockwise. In 3D they are the polygons of its surface, counterclockwise for who looks
/// from outside, in the order of the facets; surfaces of cavities are among them.
struct CellPart {
  std::int32_t cell = 0;
  int number = 0;        ///< Among the parts of its cell, from 0.
  double measure = 0.0;  ///< Area [L^2] or volume [L^3].
  std::vector<CornerLoop> loops;
};

/// The parts of all cells, by cell. Empty cells have none. Parts that touch in a vertex only (2D)
/// are apart; in 3D those that touch in an edge are one.
///
/// @pre  The tessellation is well formed.
[[nodiscard]] std::vector<CellPart> cell_parts(const Tessellation& tessellation);

/// Signed area of a loop in the plane, > 0 counterclockwise [L^2].
[[nodiscard]] double signed_area(const Tessellation& tessellation, const CornerLoop& loop);

/// One outline for a part with holes: each hole is joined to what is around it by a slit, a line
/// that is passed in both directions. Its signed area is the measure of the part.
[[nodiscard]] CornerLoop with_slits(const Tessellation& tessellation, const CellPart& part);

/// The number of neighbors of every cell; periodic images count apart, walls do not count.
[[nodiscard]] std::vector<int> neighbor_counts(const Tessellation& tessellation);

}  // namespace packstone
