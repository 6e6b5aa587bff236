#include "packstone/io/export_tessellation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <sstream>

#include "io/tessellation/cell_parts.hpp"
#include "packstone/core/error.hpp"
#include "packstone/tessellate/laguerre.hpp"
#include "support/hand_made_cells.hpp"
#include "support/python.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

// The lines of a table without quoted commas, each as heading -> field.
std::vector<std::map<std::string, std::string>> table(const std::filesystem::path& path) {
  std::istringstream lines(test::content_of(path));
  const auto fields = [](const std::string& line) {
    std::vector<std::string> all;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, ',');) all.push_back(field);
    return all;
  };
  std::string line;
  std::getline(lines, line);
  const auto titles = fields(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    const auto row = fields(line);
    REQUIRE(row.size() == titles.size());
    rows.emplace_back();
    for (std::size_t k = 0; k < titles.size(); ++k) rows.back()[titles[k]] = row[k];
  }
  return rows;
}

double sum(const std::vector<std::map<std::string, std::string>>& rows, const std::string& title) {
  double total = 0.0;
  for (const auto& row : rows) total += std::stod(row.at(title));
  return total;
}

void check_with_vtk(const Packing& packing, const Tessellation& t, std::size_t cells) {
  const test::TemporaryFolder folder;
  export_tessellation(folder / "cells.vtu", t, packing);
  std::ostringstream arguments;
  arguments.precision(17);
  arguments << (folder / "cells.vtu").string() << " " << t.box.dimension << " " << cells << " "
            << volume(t.box);
  test::run_python("read_cells_vtu.py", arguments.str());
}

void check_with_gmsh(const Packing& packing, const Tessellation& t) {
  const test::TemporaryFolder folder;
  export_tessellation(folder / "cells.geo", t, packing);
  std::ostringstream arguments;
  arguments.precision(17);
  const auto& per = t.box.periodic;
  arguments << (folder / "cells.geo").string() << " " << t.box.size.x << " " << t.box.size.y << " "
            << (per[0] || per[1] ? "" : "-") << (per[0] ? "x" : "") << (per[1] ? "y" : "");
  for (const CellShape& shape : cell_shapes(t)) arguments << " " << shape.measure;
  test::run_python("mesh_geo.py", arguments.str());
}

void check_tess(const Packing& packing, const Tessellation& t) {
  const test::TemporaryFolder folder;
  export_tessellation(folder / "cells.tess", t, packing);
  std::ostringstream arguments;
  arguments.precision(17);
  const auto& per = t.box.periodic;
  arguments << (folder / "cells.tess").string() << " " << t.box.dimension << " " << t.box.size.x
            << " " << t.box.size.y << " " << t.box.size.z << " -";
  for (std::size_t a = 0; a < 3; ++a) {
    if (per[a] && t.box.size[a] > 0.0) arguments << "xyz"[a];
  }
  arguments << " " << t.cells.size();
  test::run_python("read_tess.py", arguments.str());
}

TEST_CASE("cell_parts: what touches in a corner only is apart") {
  const Tessellation t = test::cells_in_parts();
  CHECK_NOTHROW(check_well_formed(t));
  const auto parts = cell_parts(t);
  REQUIRE(parts.size() == 5);
  const std::array<int, 5> cells{0, 0, 1, 2, 2}, numbers{0, 1, 0, 0, 1};
  const std::array<double, 5> areas{3, 3, 1, 1, 1};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    CHECK(parts[k].cell == cells[k]);
    CHECK(parts[k].number == numbers[k]);
    CHECK(parts[k].measure == Approx(areas[k]));
    CHECK(signed_area(t, with_slits(t, parts[k])) == Approx(areas[k]));
  }
}

TEST_CASE("cell_parts: a hole that touches nothing is joined to the outline by a slit") {
  Tessellation t;
  t.box = cell_2d(4, 3, false, false);
  t.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0},
                {1, 1, 0}, {3, 1, 0}, {3, 2, 0}, {1, 2, 0}};
  t.cells = {{{0.5, 0.5, 0}, 0, 1}, {{2, 1.5, 0}, 0, 1}};
  for (int k = 0; k < 4; ++k) {
    constexpr std::array<int, 4> walls{2, 1, 3, 0};
    test::add_edge(t, {.inner = 0, .wall = walls[static_cast<std::size_t>(k)]}, {k}, {(k + 1) % 4});
    test::add_edge(t, {.inner = 1, .outer = 0}, {4 + k}, {4 + (k + 1) % 4});
  }
  const auto parts = cell_parts(t);
  REQUIRE(parts.size() == 2);
  REQUIRE(parts[0].loops.size() == 2);
  CHECK(parts[0].measure == Approx(10.0));
  const CornerLoop outline = with_slits(t, parts[0]);
  CHECK(outline.size() == 10);
  CHECK(signed_area(t, outline) == Approx(10.0));
}

TEST_CASE("neighbor_counts: images count apart, walls do not") {
  CHECK(neighbor_counts(test::cells_in_parts()) == std::vector<int>{2, 1, 1, 0});
  const Packing one = test::jittered_ellipses(1, true, true);
  CHECK(neighbor_counts(laguerre_tessellate(one).tessellation)[0] >= 4);
}

TEST_CASE("a table of cells has sizes, moments, neighbors and parts; an empty cell has none") {
  const test::TemporaryFolder folder;
  export_tessellation(folder / "cells.csv", test::cells_in_parts(), test::cells_in_parts_packing());
  std::istringstream lines(test::content_of(folder / "cells.csv"));
  std::string line;
  std::getline(lines, line);
  CHECK(line ==
        "inclusion,group,center_x,center_y,area,ordered_area,perimeter,centroid_x,centroid_y,"
        "second_moment_xx,second_moment_yy,second_moment_xy,semi_axis_a,semi_axis_b,aspect,angle,"
        "neighbors,parts");
  std::getline(lines, line);
  std::getline(lines, line);
  CHECK(line.find("1,large,1.5,1.5,1,2.25,4,1.5,1.5,0.083333333333333") == 0);
  CHECK_THAT(line, Catch::EndsWith(",1,1"));
  std::getline(lines, line);
  CHECK(line.find("2,\"small, \"\"odd\"\"\",0.5,0.5,2,2.25,8,") == 0);
  CHECK_THAT(line, Catch::EndsWith(",1,2"));
  std::getline(lines, line);
  CHECK(line == "3,\"small, \"\"odd\"\"\",2,2,0,2.25,,,,,,,,,,,0,0");
}

TEST_CASE("a table of polyhedra sums to the box, and its moments are those of the inclusions") {
  const test::TemporaryFolder folder;
  const Packing packing = test::jittered_bodies(3, {true, true, false});
  const LaguerreResult result = laguerre_tessellate(packing);
  export_tessellation(folder / "cells.csv", result.tessellation, packing);
  const auto rows = table(folder / "cells.csv");
  REQUIRE(rows.size() == 27);
  CHECK(sum(rows, "volume") == Approx(1.0));
  CHECK(sum(rows, "ordered_volume") == Approx(1.0));
  const CellShape& shape = result.shapes[5];
  CHECK(std::stod(rows[5].at("semi_axis_b")) == shape.semi_axes.y);
  CHECK(std::stod(rows[5].at("axis_c_z")) == shape.axes.col_z.z);
  CHECK(std::stod(rows[5].at("second_moment_xy")) == shape.second_moment.xy);
  CHECK(rows[5].at("group") == "rods");
}

TEST_CASE("VTK reads cells in parts") {
  Packing packing = test::cells_in_parts_packing();
  Tessellation t = test::cells_in_parts();
  packing.inclusions.pop_back();  // without the empty one, which has no polygon
  t.cells.pop_back();
  check_with_vtk(packing, t, 3);
}

TEST_CASE("VTK reads polygons whose areas are those of the cells, periodic or between walls") {
  for (const bool periodic : {true, false}) {
    const Packing packing = test::jittered_ellipses(6, true, periodic);
    check_with_vtk(packing, laguerre_tessellate(packing).tessellation, 36);
  }
  const Packing one = test::jittered_ellipses(1, true, true);  // wraps around the box
  check_with_vtk(one, laguerre_tessellate(one).tessellation, 1);
}

TEST_CASE("VTK reads closed polyhedra whose volumes are those of the cells") {
  const Packing packing = test::jittered_bodies(3, {true, true, false});
  check_with_vtk(packing, laguerre_tessellate(packing).tessellation, 27);
  check_with_vtk(packing, laguerre_tessellate(packing, {.connected = false}).tessellation, 27);
}

TEST_CASE("Gmsh meshes polygons to the areas of the cells, opposite faces matched") {
  for (const bool periodic : {true, false}) {
    const Packing packing = test::jittered_ellipses(4, true, periodic);
    check_with_gmsh(packing, laguerre_tessellate(packing).tessellation);
  }
  check_with_gmsh(test::cells_in_parts_packing(), test::cells_in_parts());
}

TEST_CASE("a .tess file keeps what its format promises, in 2D and 3D, periodic or not") {
  for (const bool x : {true, false}) {
    for (const bool y : {true, false}) {
      const Packing flat = test::jittered_ellipses(4, x, y);
      check_tess(flat, laguerre_tessellate(flat).tessellation);
      const Packing solid = test::jittered_bodies(2, {x, y, false});
      check_tess(solid, laguerre_tessellate(solid).tessellation);
    }
  }
  const Packing solid = test::jittered_bodies(3, {true, true, true});
  check_tess(solid, laguerre_tessellate(solid, {.connected = false}).tessellation);
  check_tess(test::cells_in_parts_packing(), test::cells_in_parts());
}

TEST_CASE("exports of tessellations refuse unknown endings and what does not belong together") {
  const test::TemporaryFolder folder;
  const Packing packing = test::cells_in_parts_packing();
  Tessellation t = test::cells_in_parts();
  CHECK_THROWS_WITH(export_tessellation("cells.obj", t, packing),
                    Catch::StartsWith("cells.obj: exports of tessellations end in .vtu"));
  const Packing solid = test::jittered_bodies(2, {true, true, true});
  CHECK_THROWS_WITH(
      export_tessellation(folder / "c.geo", laguerre_tessellate(solid).tessellation, solid),
      Catch::EndsWith(".geo holds polygons; the cells are polyhedra"));
  t.cells.pop_back();
  CHECK_THROWS_WITH(export_tessellation(folder / "cells.csv", t, packing),
                    Catch::Contains("3 cells") && Catch::Contains("4 inclusions"));
  t = test::cells_in_parts();
  t.facets.pop_back();
  CHECK_THROWS_AS(export_tessellation(folder / "cells.csv", t, packing), InvalidArgument);
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace packstone
