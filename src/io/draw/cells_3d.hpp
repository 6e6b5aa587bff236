#pragma once

/// @file
/// What is to be seen of polyhedra from outside.

#include <vector>

#include "io/draw/solid.hpp"
#include "io/draw/triangles.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone::draw {

/// The facets that have no cell on their other side where the cells stand whole: those at walls,
/// and those to periodic images.
[[nodiscard]] Triangles outer_facets(const Tessellation& tessellation, ColorBy color_by);

/// Edges between facets of different cells, and those where a cell has a marked edge, as thin rods.
[[nodiscard]] std::vector<Solid> outer_edges(const Tessellation& tessellation);

}  // namespace packstone::draw
