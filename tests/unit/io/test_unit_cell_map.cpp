#include "io/tessellation/unit_cell_map.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/tessellate/laguerre.hpp"
#include "packstone/tessellate/power_diagram.hpp"
#include "support/hand_made_cells.hpp"

namespace packstone {
namespace {

std::vector<double> areas(const UnitCellMap& map, std::size_t cells) {
  std::vector<double> sums(cells, 0.0);
  for (const MapFace& face : map.faces) sums[static_cast<std::size_t>(face.cell)] += face.area;
  return sums;
}

// The faces tile the box, each cell has its area, each step ends where the next begins, and what
// lies on opposite sides of the box is the same up to a period.
void check_map(const Tessellation& t) {
  const UnitCellMap map = unit_cell_map(t);
  const auto sums = areas(map, t.cells.size());
  const auto shapes = cell_shapes(t);
  for (std::size_t c = 0; c < sums.size(); ++c) {
    CHECK(sums[c] == Approx(shapes[c].measure).margin(1e-12));
  }
  std::vector<int> passed(map.edges.size(), 0);
  for (const MapFace& face : map.faces) {
    for (const auto& loop : face.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const MapStep &step = loop[k], &next = loop[(k + 1) % loop.size()];
        const MapEdge &a = map.edges[step.edge], &b = map.edges[next.edge];
        CHECK((step.backward ? a.from : a.to) == (next.backward ? b.to : b.from));
        ++passed[step.edge];
      }
    }
  }
  for (std::size_t e = 0; e < map.edges.size(); ++e) {
    const Vec3 &a = map.nodes[map.edges[e].from], &b = map.nodes[map.edges[e].to];
    bool at_face = false;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const double side : {0.0, t.box.size[axis]}) {
        at_face = at_face || (a[axis] == side && b[axis] == side);
      }
    }
    CHECK(passed[e] == (at_face ? 1 : 2));
    CHECK(norm(b - a) > 0.0);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    CHECK(map.pairs[axis].empty() == !t.box.periodic[axis]);
    double length = 0.0;
    for (const MapPair& pair : map.pairs[axis]) {
      Vec3 period;
      period[axis] = t.box.size[axis];
      const MapEdge &low = map.edges[pair.low], &high = map.edges[pair.high];
      CHECK(map.nodes[low.from] + period == map.nodes[high.from]);
      CHECK(map.nodes[low.to] + period == map.nodes[high.to]);
      length += norm(map.nodes[low.to] - map.nodes[low.from]);
    }
    if (t.box.periodic[axis]) CHECK(length == Approx(t.box.size[1 - axis]));
  }
}

TEST_CASE("unit_cell_map tiles the box, periodic or between walls") {
  for (const int n : {1, 2, 6}) {
    for (const bool x : {true, false}) {
      for (const bool y : {true, false}) {
        check_map(laguerre_tessellate(test::jittered_ellipses(n, x, y)).tessellation);
        check_map(laguerre_tessellate(test::jittered_ellipses(n, x, y), published_laguerre())
                      .tessellation);
      }
    }
  }
}

TEST_CASE("unit_cell_map takes cells in parts, empty cells, and cells that touch in corners") {
  check_map(test::cells_in_parts());
}

TEST_CASE("unit_cell_map: cells that end at the faces of the box, or within rounding of them") {
  for (const double shift : {0.0, 1e-16, 1e-12, -1e-12, 1e-7, 0.1}) {
    Packing packing{cell_2d(1, 1), {"squares"}, {}, {}, {}};
    for (int i = 0; i < 9; ++i) {
      const Vec3 at{(i % 3 + 0.5) / 3.0 + shift, (i / 3 + 0.5) / 3.0 - shift, 0};
      packing.inclusions.push_back({at, Disk{0.1}, 0});
    }
    check_map(laguerre_tessellate(packing).tessellation);
  }
  Packing one{cell_2d(1, 1), {"square"}, {{{0.5, 0.5, 0}, Disk{0.1}, 0}}, {}, {}};
  check_map(laguerre_tessellate(one).tessellation);
}

TEST_CASE("unit_cell_map: a cell around all others at the faces of the box") {
  // Sites of owner 0 in a ring around one of owner 1, in a box that they leave nowhere.
  std::vector<LaguerreSite> sites{{{0.5, 0.5, 0}, 0.0, 1}};
  for (int k = 0; k < 16; ++k) {
    const int i = k % 4, j = k / 4;
    if ((i == 1 || i == 2) && (j == 1 || j == 2)) continue;
    sites.push_back({{(i + 0.5) / 4, (j + 0.5) / 4, 0}, 0.0, 0});
  }
  const std::vector<TessellationCell> owners{{{0.1, 0.1, 0}, 0, 1}, {{0.5, 0.5, 0}, 0, 1}};
  const Tessellation t = power_diagram(cell_2d(1, 1), sites, owners);
  check_map(t);
  const UnitCellMap map = unit_cell_map(t);
  CHECK(map.faces.size() == 2);
}

}  // namespace
}  // namespace packstone
