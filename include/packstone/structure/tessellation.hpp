#pragma once

/// @file
/// Tessellation: a cell divided among cells of polygons or polyhedra, without gap or overlap.
///
/// "The box" is here what a Cell is elsewhere, so that "cell" may be one part of the tessellation.
///
/// In 2D the boundary between two cells consists of edges, in 3D of plane polygons; both are called
/// facets. Each facet is stored once, with the cells on its two sides, and each vertex once. Where
/// the box is periodic, a vertex stands inside it and a facet says in which image of the box each
/// of its corners is: cells that cross a face of the box, meet several images of one neighbor, or
/// wrap around the box, need no special case.

#include <array>
#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A vertex as one corner of a facet.
struct FacetCorner {
  std::int32_t vertex = 0;            ///< Index into Tessellation::vertices.
  std::array<int, 3> image{0, 0, 0};  ///< Periods by which it is shifted, for the inner cell.

  friend constexpr bool operator==(const FacetCorner&, const FacetCorner&) = default;
};

/// An edge (2D) or a plane polygon (3D) between two cells, or between a cell and a wall.
///
/// The corners stand where the inner cell stands. In 2D there are two, and the inner cell lies to
/// the left on the way from the first to the second; in 3D they run counterclockwise for who looks
/// at the inner cell from outside.
struct Facet {
  static constexpr std::int32_t kWall = -1;

  std::int32_t inner = 0;             ///< Index of the cell on one side.
  std::int32_t outer = kWall;         ///< Of the cell on the other side, kWall: none.
  std::array<int, 3> image{0, 0, 0};  ///< Periods by which the outer cell is shifted.
  int wall = -1;  ///< Where outer is kWall: 2 axis + (0 the low one, 1 the high one); else -1.
  std::int64_t first_corner = 0;  ///< Index into Tessellation::corners.
  std::int32_t corner_count = 0;

  friend constexpr bool operator==(const Facet&, const Facet&) = default;
};

/// One part of a tessellation.
struct TessellationCell {
  Vec3 center;    ///< Of the inclusion that it belongs to, inside the box [L].
  int group = 0;  ///< Of that inclusion.
  int parts = 1;  ///< Connected parts; 0: the cell is empty.

  friend constexpr bool operator==(const TessellationCell&, const TessellationCell&) = default;
};

/// A box divided among cells.
struct Tessellation {
  Cell box;
  std::vector<Vec3> vertices;  ///< Inside the box [L]; z = 0 in 2D.
  std::vector<FacetCorner> corners;
  std::vector<Facet> facets;            ///< By inner cell.
  std::vector<TessellationCell> cells;  ///< One per inclusion, in the order of the packing.
};

/// Where a corner of a facet stands [L].
[[nodiscard]] Vec3 position(const Tessellation& tessellation, const FacetCorner& corner) noexcept;

/// Throws InvalidArgument, naming what is wrong, when an index is out of range, a facet has too few
/// corners or a wall that is none, or the boundary of a cell is not closed: in 2D every vertex of a
/// cell must be the start of as many of its edges as it is the end of, in 3D every edge must be
/// passed in both directions equally often.
void check_well_formed(const Tessellation& tessellation);

/// The number of places where the boundary of a cell is not closed; 0 when check_well_formed()
/// passes.
[[nodiscard]] std::int64_t open_ridges(const Tessellation& tessellation);

/// The facets of every cell.
struct CellFacets {
  /// A facet as one cell sees it.
  struct Entry {
    std::int64_t facet = 0;
    bool outer = false;  ///< The cell is the outer one: orientation and images turn about.
  };
  std::vector<std::int64_t> first;  ///< Of cell c: entries[first[c]] to entries[first[c + 1] - 1].
  std::vector<Entry> entries;       ///< A facet between a cell and its own image comes twice.
};
[[nodiscard]] CellFacets facets_of_cells(const Tessellation& tessellation);

/// Two cells that share facets, or a cell at a wall.
struct CellContact {
  std::int32_t a = 0;
  std::int32_t b = Facet::kWall;      ///< a <= b, or kWall.
  std::array<int, 3> image{0, 0, 0};  ///< Periods by which b is shifted.
  int wall = -1;                      ///< As in Facet.
  double measure = 0.0;               ///< Length (2D) or area (3D) in common [L] or [L^2].
  std::int64_t facets = 0;            ///< In common.
};

/// Who touches whom: each pair of cells and image once, ordered by (a, b, image, wall).
[[nodiscard]] std::vector<CellContact> cell_contacts(const Tessellation& tessellation);

/// What a cell is like, from the exact moments of its polygon or polyhedron.
struct CellShape {
  double measure = 0.0;   ///< Volume [L^3], in 2D area [L^2].
  double boundary = 0.0;  ///< Surface [L^2], in 2D perimeter [L]; with the walls.
  Vec3 centroid;          ///< Where the cell stands, so maybe outside the box [L].
  SymMat3 second_moment;  ///< Integral of x x^T about the centroid [L^5], in 2D [L^4].
  Vec3 semi_axes;  ///< Of the ellipsoid (ellipse) with this second_moment / measure, descending;
                   ///< 0 along z in 2D [L].
  Mat3 axes;       ///< Columns: their directions; in 2D the third is z. Signs mean nothing.
  double aspect = 1.0;  ///< Longest over shortest semi-axis [-].
};

/// The shape of a body with these moments about its center.
[[nodiscard]] CellShape shape_of_moments(int dimension, double measure, const Vec3& centroid,
                                         const SymMat3& second_moment) noexcept;

/// The shapes of all cells, in order. Of an empty cell all sizes are 0.
[[nodiscard]] std::vector<CellShape> cell_shapes(const Tessellation& tessellation);

/// Inertia tensor at density 1 about the centroid: trace(M) I - M [L^5]; in 2D [L^4], where zz is
/// the polar moment.
[[nodiscard]] SymMat3 inertia_tensor(const CellShape& shape) noexcept;

}  // namespace packstone
