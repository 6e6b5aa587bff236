#pragma once

/// @file
/// Tessellations made by hand, for what random ones hardly ever show, and packings to make them of.

#include <utility>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone::test {

/// Adds an edge to a tessellation of the plane.
inline void add_edge(Tessellation& t, Facet facet, const FacetCorner& from, const FacetCorner& to) {
  facet.first_corner = static_cast<std::int64_t>(t.corners.size());
  facet.corner_count = 2;
  t.corners.push_back(from);
  t.corners.push_back(to);
  t.facets.push_back(facet);
}

/// A box of 3 by 3 with walls, of unit squares. Cell 1 is the one in the middle; cell 2 has those
/// at (0, 0) and at (2, 2), which touch cell 1 in a corner; cell 0 has two parts of three squares
/// each. Cell 3 is empty.
inline Tessellation cells_in_parts() {
  Tessellation t;
  t.box = cell_2d(3, 3, false, false);
  t.vertices = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {3, 2, 0}, {3, 3, 0}, {2, 3, 0},
                {0, 3, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  t.cells = {
      {{0.5, 2.5, 0}, 0, 1}, {{1.5, 1.5, 0}, 0, 1}, {{0.5, 0.5, 0}, 1, 2}, {{2, 2, 0}, 1, 0}};
  const auto edge = [&](std::int32_t inner, std::int32_t outer, int wall, int from, int to) {
    add_edge(t, {.inner = inner, .outer = outer, .wall = wall}, {from}, {to});
  };
  const std::int32_t none = Facet::kWall;
  edge(0, none, 2, 1, 2);
  edge(0, none, 1, 2, 3);
  edge(0, 2, -1, 3, 10);
  edge(0, 2, -1, 10, 5);
  edge(0, none, 3, 5, 6);
  edge(0, none, 0, 6, 7);
  edge(0, 2, -1, 7, 8);
  edge(0, 2, -1, 8, 1);
  edge(1, 0, -1, 8, 9);
  edge(1, 0, -1, 9, 10);
  edge(1, 0, -1, 10, 11);
  edge(1, 0, -1, 11, 8);
  edge(2, none, 2, 0, 1);
  edge(2, none, 0, 7, 0);
  edge(2, none, 1, 3, 4);
  edge(2, none, 3, 4, 5);
  return t;
}

/// Disks that stand where the cells of cells_in_parts() do.
inline Packing cells_in_parts_packing() {
  const Tessellation t = cells_in_parts();
  Packing packing{t.box, {"large", "small, \"odd\""}, {}, {}, {}};
  for (const TessellationCell& cell : t.cells) {
    packing.inclusions.push_back({cell.center, Disk{0.3}, cell.group});
  }
  return packing;
}

/// Ellipses on a jittered square lattice in the unit square, n by n, turned at random.
inline Packing jittered_ellipses(int n, bool periodic_x, bool periodic_y) {
  RandomStream random(3, StreamId::test, 0);
  Packing packing{cell_2d(1, 1, periodic_x, periodic_y), {"grains", "others"}, {}, {}, {}};
  for (int i = 0; i < n * n; ++i) {
    const double a = 0.5 / n * random.uniform(0.5, 0.8);
    const double slack = 0.5 / n - a;
    const Vec3 at{(i % n + 0.5) / n + slack * random.uniform(-1, 1),
                  (i / n + 0.5) / n + slack * random.uniform(-1, 1), 0};
    packing.inclusions.push_back({at, Ellipse{{a, a / 2}, random.uniform(-3, 3)}, i % 2});
  }
  return packing;
}

/// Spheres and spherocylinders on a jittered cubic lattice in the unit cube, n by n by n.
inline Packing jittered_bodies(int n, const std::array<bool, 3>& periodic) {
  RandomStream random(4, StreamId::test, 0);
  Packing packing{Cell{3, {1, 1, 1}, periodic}, {"balls", "rods"}, {}, {}, {}};
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 lattice{i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5};
    const Vec3 jitter{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                      random.uniform(-0.1, 0.1)};
    const double r = 0.35 / n * random.uniform(0.5, 1.0);
    const Body body =
        i % 2 == 0 ? Body{Sphere{r}} : Body{Spherocylinder{r / 2, r / 2, {0, 0.6, 0.8}}};
    packing.inclusions.push_back({(lattice + jitter) / n, body, i % 2});
  }
  return packing;
}

}  // namespace packstone::test
