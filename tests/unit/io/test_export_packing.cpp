#include "packstone/io/export_packing.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>

#include "packstone/core/error.hpp"
#include "packstone/geometry/inscribed_balls.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/io/surface_mesh.hpp"
#include "support/python.hpp"
#include "support/random_packing.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

Packing four_shapes() {
  Packing packing;
  packing.groups = {"round, \"soft\"", "long"};
  packing.inclusions = {{{0.05, 0.5, 0.5}, Sphere{0.1}, 0},
                        {{0.5, 0.5, 0.5}, Ellipsoid{{0.1, 0.2, 0.15}, {0.6, 0, 0.8, 0}}, 0},
                        {{0.5, 0.1, 0.9}, Cylinder{0.05, 0.2, {0.6, 0, 0.8}}, 1},
                        {{0.2, 0.8, 0.5}, Spherocylinder{0.05, 0.1, {0, 0, 1}}, 1}};
  return packing;
}

Packing two_flat_shapes() {
  Packing packing;
  packing.cell = cell_2d(2.0, 1.0);
  packing.groups = {"plates"};
  packing.inclusions = {{{1.95, 0.5, 0}, Disk{0.1}, 0},
                        {{0.5, 0.5, 0}, Ellipse{{0.3, 0.1}, 0.5}, 0}};
  return packing;
}

double total_volume(const Packing& packing) { return fraction(packing) * volume(packing.cell); }

float float_at(const std::string& bytes, std::size_t place) {
  float value = 0.0F;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

TEST_CASE("an STL export is binary, closed and keeps the volume of its meshes") {
  const test::TemporaryFolder folder;
  const Packing packing = four_shapes();
  export_packing(folder / "packing.stl", packing, {.segments = 24});
  const std::string bytes = test::content_of(folder / "packing.stl");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  REQUIRE(bytes.size() == 84 + 50 * static_cast<std::size_t>(count));
  CHECK(bytes.substr(0, 5) != "solid");  // which would announce the text form
  std::size_t expected = 0;
  for (const auto& inclusion : packing.inclusions) {
    expected += triangle_count(kind(inclusion.body), 24);
  }
  CHECK(count == expected);

  using Corner = std::array<float, 3>;
  std::map<std::pair<Corner, Corner>, int> edges;
  double six_volumes = 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<Corner, 4> v;  // the normal, then the corners
    for (std::size_t i = 0; i < 12; ++i) v[i / 3][i % 3] = float_at(bytes, 84 + 50 * t + 4 * i);
    const auto as_vec = [&](std::size_t i) { return Vec3{v[i][0], v[i][1], v[i][2]}; };
    six_volumes += dot(as_vec(1), cross(as_vec(2), as_vec(3)));
    CHECK(dot(as_vec(0), cross(as_vec(2) - as_vec(1), as_vec(3) - as_vec(1))) > 0.0);
    for (std::size_t i = 1; i < 4; ++i) ++edges[{v[i], v[i % 3 + 1]}];
  }
  bool closed = true;
  for (const auto& [edge, times] : edges) {
    closed = closed && times == 1 && edges.count({edge.second, edge.first}) == 1;
  }
  CHECK(closed);
  CHECK(six_volumes / 6.0 < total_volume(packing));
  CHECK(six_volumes / 6.0 == Approx(total_volume(packing)).epsilon(16.5 / (24 * 24)));
}

TEST_CASE("a CSV export has one line per inclusion with every digit") {
  const test::TemporaryFolder folder;
  Packing packing = four_shapes();
  packing.inclusions[0].center.x = 0.1 + 0.2;
  export_packing(folder / "packing.csv", packing);
  std::istringstream lines(test::content_of(folder / "packing.csv"));
  std::string line;
  std::getline(lines, line);
  CHECK(line ==
        "inclusion,group,shape,volume,center_x,center_y,center_z,radius,half_length,axis_x,"
        "axis_y,axis_z,axes_a,axes_b,axes_c,quaternion_w,quaternion_x,quaternion_y,quaternion_z");
  std::getline(lines, line);
  CHECK(line.find("0,\"round, \"\"soft\"\"\",sphere,") == 0);
  CHECK(line.find(",0.30000000000000004,0.5,0.5,0.1,,,,,,,,,,,") != std::string::npos);
  std::getline(lines, line);
  CHECK(line.find(",0.5,0.5,0.5,,,,,,0.1,0.2,0.15,0.6,0,0.8,0") != std::string::npos);
  std::getline(lines, line);
  CHECK(line.find("2,long,cylinder,") == 0);
  CHECK(line.find(",0.5,0.1,0.9,0.05,0.2,0.6,0,0.8,,,,,,,") != std::string::npos);
  std::getline(lines, line);
  CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("a CSV export of a 2D packing lists the images that reach into the cell when asked") {
  const test::TemporaryFolder folder;
  export_packing(folder / "packing.csv", two_flat_shapes(), {.images = true});
  const std::string text = test::content_of(folder / "packing.csv");
  CHECK(text.find("inclusion,group,shape,area,center_x,center_y,radius,axes_a,axes_b,angle,image_x,"
                  "image_y,cuts\n") == 0);
  CHECK(text.find("0,plates,disk,0.031415926535897934,1.95,0.5,0.1,,,,0,0,x+\n") !=
        std::string::npos);
  CHECK(
      text.find("0,plates,disk,0.031415926535897934,-0.050000000000000044,0.5,0.1,,,,-1,0,x-\n") !=
      std::string::npos);
  CHECK(text.find(",0.3,0.1,0.5,0,0,\n") != std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 4);
}

TEST_CASE("balls are exported as a table, inside their bodies") {
  const test::TemporaryFolder folder;
  const Packing packing = two_flat_shapes();
  export_packing(folder / "balls.csv", packing, {.images = true, .ball_spacing = 0.5});
  std::istringstream lines(test::content_of(folder / "balls.csv"));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "inclusion,group,center_x,center_y,radius");
  std::getline(lines, line);
  CHECK(line == "0,plates,1.95,0.5,0.1");
  std::getline(lines, line);
  CHECK(line == "0,plates,-0.050000000000000044,0.5,0.1");
  const auto balls = inscribed_balls(packing.inclusions[1].body, 0.5);
  REQUIRE(balls.size() > 3);
  std::size_t count = 0;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string inclusion, group, x, y, radius;
    for (std::string* field : {&inclusion, &group, &x, &y, &radius})
      std::getline(fields, *field, ',');
    CHECK(inclusion == "1");
    CHECK(std::stod(x) == packing.inclusions[1].center.x + balls[count].center.x);
    CHECK(std::stod(y) == packing.inclusions[1].center.y + balls[count].center.y);
    CHECK(std::stod(radius) == balls[count].radius);
    ++count;
  }
  CHECK(count == balls.size());

  CHECK_THROWS_WITH(export_packing(folder / "balls.vtu", packing, {.ball_spacing = 0.5}),
                    Catch::Contains("balls are a table, which ends in .csv"));
  CHECK_THROWS_WITH(export_packing(folder / "balls.csv", packing, {.ball_spacing = 2.0}),
                    "ball_spacing = 2, allowed are 0.01 to 1");
}

TEST_CASE("a fiber longer than the cell is exported with all images that reach into it") {
  const test::TemporaryFolder folder;
  Packing packing;
  packing.groups = {"long"};
  packing.inclusions = {{{0.5, 0.5, 0.5}, Cylinder{0.1, 2.2, {0, 0, 1}}, 0}};
  export_packing(folder / "packing.csv", packing, {.images = true});
  const std::string text = test::content_of(folder / "packing.csv");
  // Shifts -2 to 2 along z: the box of shift 3 begins at 0.5 + 3 - 2.2 > 1.
  CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 5);
  packing.inclusions[0].body = Cylinder{0.1, 1e9, {0, 0, 1}};
  CHECK_THROWS_WITH(export_packing(folder / "packing.csv", packing, {.images = true}),
                    Catch::Contains("inclusion 0") && Catch::Contains("periods"));
}

TEST_CASE("an image whose box alone reaches into the cell is left out of every export") {
  const test::TemporaryFolder folder;
  Packing packing;
  packing.groups = {"balls"};
  packing.inclusions = {{{0.08, 0.08, 0.5}, Sphere{0.1}, 0}, {{0.5, 0.5, 0.5}, Sphere{0.1}, 0}};
  export_packing(folder / "packing.csv", packing, {.images = true});
  std::istringstream lines(test::content_of(folder / "packing.csv"));
  std::vector<std::string> ends;
  for (std::string line; std::getline(lines, line);) ends.push_back(line.substr(line.size() - 12));
  // Not the image shifted along x and y: its corner of the box is empty.
  REQUIRE(ends.size() == 5);
  CHECK_THAT(ends[0], Catch::EndsWith(",cuts"));
  CHECK_THAT(ends[1], Catch::EndsWith(",0,0,0,x- y-"));
  CHECK_THAT(ends[2], Catch::EndsWith(",0,1,0,y+"));
  CHECK_THAT(ends[3], Catch::EndsWith(",1,0,0,x+"));
  CHECK_THAT(ends[4], Catch::EndsWith(",0,0,0,"));
  export_packing(folder / "packing.stl", packing, {.segments = 8, .images = true});
  const std::string bytes = test::content_of(folder / "packing.stl");
  CHECK(bytes.size() == 84 + 50 * 4 * triangle_count(ShapeKind::sphere, 8));
}

TEST_CASE("VTK reads a 3D export: closed surfaces with the values of each inclusion") {
  const test::TemporaryFolder folder;
  const Packing packing = four_shapes();
  export_packing(folder / "packing.vtu", packing, {.segments = 24});
  std::size_t points = 0, cells = 0;
  for (const auto& inclusion : packing.inclusions) {
    points += point_count(kind(inclusion.body), 24);
    cells += triangle_count(kind(inclusion.body), 24);
  }
  std::ostringstream arguments;
  arguments.precision(17);
  arguments << (folder / "packing.vtu").string() << " 3 " << points << " " << cells << " 4 "
            << total_volume(packing);
  test::run_python("read_vtu.py", arguments.str());
}

TEST_CASE("VTK reads a 2D export: one polygon per disk or ellipse, images included") {
  const test::TemporaryFolder folder;
  const Packing packing = two_flat_shapes();
  export_packing(folder / "packing.vtu", packing, {.segments = 64, .images = true});
  std::ostringstream arguments;
  arguments.precision(17);
  arguments << (folder / "packing.vtu").string() << " 2 192 3 2 "
            << total_volume(packing) + volume(packing.inclusions[0].body);
  test::run_python("read_vtu.py", arguments.str());
}

TEST_CASE("exports refuse unknown endings, flat STL, bad options and bad packings") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(export_packing("packing.obj", four_shapes()),
                    "packing.obj: exports end in .vtu, .stl or .csv");
  CHECK_THROWS_WITH(export_packing(folder / "packing.stl", two_flat_shapes()),
                    "STL holds 3D surfaces; the cell is 2D");
  CHECK_THROWS_AS(export_packing(folder / "packing.vtu", four_shapes(), {.segments = 7}),
                  InvalidArgument);
  Packing bad = four_shapes();
  bad.inclusions[1].body = Sphere{-1.0};
  CHECK_THROWS_AS(export_packing(folder / "packing.csv", bad), InvalidArgument);
  CHECK_THROWS_AS(export_packing(folder / "no" / "packing.csv", four_shapes()), FileError);
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace packstone
