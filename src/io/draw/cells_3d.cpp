#include "io/draw/cells_3d.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "io/draw/palette.hpp"
#include "io/tessellation/placed_corners.hpp"

namespace packstone::draw {
namespace {

// A facet that is to be seen, with the cell that it belongs to.
struct OuterFacet {
  std::vector<FacetCorner> corners;
  std::size_t cell = 0;
};

std::vector<OuterFacet> outer_facets_of(const Tessellation& t) {
  std::vector<OuterFacet> list;
  for (const Facet& facet : t.facets) {
    const bool wall = facet.outer == Facet::kWall;
    if (!wall && facet.image == std::array<int, 3>{}) continue;
    list.push_back({placed_facet(t, facet, false), static_cast<std::size_t>(facet.inner)});
    if (wall) continue;
    list.push_back({placed_facet(t, facet, true), static_cast<std::size_t>(facet.outer)});
  }
  return list;
}

// Facets of one cell that meet at less than this are one surface for the eye: cosine of 25 degrees.
constexpr double kSmooth = 0.906;

// What lies to the sides of an edge: so far one facet of `cell`.
struct Sides {
  std::size_t cell = 0;
  Vec3 normal;
  bool shown = true;  // At the rim of all, or between facets that differ.
};

}  // namespace

Triangles outer_facets(const Tessellation& tessellation, ColorBy color_by) {
  const std::vector<Vec3> colors = cell_colors(tessellation, color_by);
  Triangles triangles;
  PlacedCorners points;
  for (const OuterFacet& facet : outer_facets_of(tessellation)) {
    std::vector<unsigned> numbers;
    for (const FacetCorner& corner : facet.corners) {
      numbers.push_back(static_cast<unsigned>(points.number(corner)));
    }
    for (std::size_t k = 2; k < numbers.size(); ++k) {
      triangles.corners.push_back({numbers[0], numbers[k - 1], numbers[k]});
      triangles.colors.push_back(colors[facet.cell]);
    }
  }
  triangles.points = points.positions(tessellation);
  return triangles;
}

std::vector<Solid> outer_edges(const Tessellation& tessellation) {
  const double radius = 0.001 * norm(tessellation.box.size);
  const Vec3 color{0.03, 0.03, 0.035};
  PlacedCorners points;
  std::map<std::pair<std::size_t, std::size_t>, Sides> edges;
  for (const OuterFacet& facet : outer_facets_of(tessellation)) {
    const Vec3 normal = polygon_normal(positions(tessellation, facet.corners));
    for (std::size_t k = 0; k < facet.corners.size(); ++k) {
      const std::size_t a = points.number(facet.corners[k]);
      const std::size_t b = points.number(facet.corners[(k + 1) % facet.corners.size()]);
      const auto [edge, first] =
          edges.try_emplace({std::min(a, b), std::max(a, b)}, Sides{facet.cell, normal});
      if (first) continue;
      Sides& sides = edge->second;
      // The corners run as for the inner cell, so the sign of the normal means nothing.
      sides.shown = sides.cell != facet.cell || std::abs(dot(sides.normal, normal)) < kSmooth;
    }
  }
  const std::vector<Vec3> at = points.positions(tessellation);
  std::vector<Solid> rods;
  for (const auto& [ends, sides] : edges) {
    if (!sides.shown) continue;
    const auto& [a, b] = ends;
    const Vec3 along = at[b] - at[a];
    const double length = norm(along);
    if (length <= 0.0) continue;
    const Spherocylinder rod{radius, 0.5 * length, along / length};
    rods.push_back(make_solid(rod, 0.5 * (at[a] + at[b]), color, false));
  }
  return rods;
}

}  // namespace packstone::draw
