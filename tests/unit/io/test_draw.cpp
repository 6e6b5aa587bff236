#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/io/draw.hpp"
#include "support/picture.hpp"

namespace packstone {
namespace {

using Catch::Matchers::Contains;

using test::is_blue;
using test::is_orange;
using test::is_white;
using test::Picture;

std::filesystem::path scratch(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / "packstone_test_draw";
  std::filesystem::create_directories(folder);
  return folder / name;
}

Packing one_ball(double radius, const Vec3& center = {0.5, 0.5, 0.5}) {
  Packing packing;
  packing.groups = {"balls"};
  packing.inclusions = {{center, Sphere{radius}, 0}};
  return packing;
}

Packing two_flats() {
  Packing packing;
  packing.cell = cell_2d(2, 1);
  packing.groups = {"disks", "ellipses"};
  packing.inclusions = {{{0.5, 0.5, 0}, Disk{0.3}, 0},
                        {{1.5, 0.5, 0}, Ellipse{{0.4, 0.2}, 1.0}, 1}};
  return packing;
}

const DrawOptions kSmall{.width = 160, .height = 120, .samples = 2};

TEST_CASE("a ball stands in the middle of its 3D picture, in the color of its group") {
  const auto path = scratch("ball.png");
  draw_packing(path, one_ball(0.3), kSmall);
  const Picture picture(path);
  CHECK(picture.width() == 160);
  CHECK(picture.height() == 120);
  CHECK(is_blue(picture.at(0.5, 0.5)));
  CHECK(is_white(picture.at(0.01, 0.01)));
}

TEST_CASE("a 3D picture is filled by what stands in it, but for a margin") {
  draw_packing(scratch("framed.png"), one_ball(2.0), kSmall);
  const Picture picture(scratch("framed.png"));
  int top = 120, bottom = 0;
  for (int y = 0; y < 120; ++y) {
    if (!is_blue(picture.at(0.5, (y + 0.5) / 120))) continue;
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  // A margin of 2.4 % of 120 rows is 3 rows; dark rims may count as not blue.
  CHECK(top >= 2);
  CHECK(top <= 6);
  CHECK(bottom >= 113);
  CHECK(bottom <= 117);
}

TEST_CASE("a ball at the corner shows at all corners when cut, at one when whole") {
  const auto count_blue = [](const Picture& picture) {
    int blue = 0;
    for (int i = 0; i < 160 * 120; ++i) {
      blue += is_blue(picture.at((i % 160 + 0.5) / 160, (i / 160 + 0.5) / 120)) ? 1 : 0;
    }
    return blue;
  };
  DrawOptions options = kSmall;
  draw_packing(scratch("whole.png"), one_ball(0.2, {0, 0, 0}), options);
  options.cut = true;
  draw_packing(scratch("cut.png"), one_ball(0.2, {0, 0, 0}), options);
  const int whole = count_blue(Picture(scratch("whole.png")));
  const int cut = count_blue(Picture(scratch("cut.png")));
  CHECK(whole > 100);
  CHECK(cut > whole);
}

TEST_CASE("a 3D picture does not depend on the number of threads") {
  const auto bytes = [](const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  };
  draw_packing(scratch("t1.png"), one_ball(0.3), kSmall, RunContext{}.threads(1));
  draw_packing(scratch("t3.png"), one_ball(0.3), kSmall, RunContext{}.threads(3));
  CHECK(bytes(scratch("t1.png")) == bytes(scratch("t3.png")));
}

TEST_CASE("a 2D picture keeps the shape of the cell and puts y upward") {
  Packing packing = two_flats();
  packing.inclusions[0].center.y = 0.7;
  DrawOptions options{.width = 400, .height = 400};
  options.cut = true;
  draw_packing(scratch("flat.png"), packing, options);
  const Picture picture(scratch("flat.png"));
  CHECK(picture.width() == 400);
  CHECK(picture.height() == Approx(212).margin(2));
  CHECK(is_blue(picture.at(0.25, 0.3)));
  CHECK(is_orange(picture.at(0.75, 0.5)));
  CHECK(is_white(picture.at(0.25, 0.85)));
}

TEST_CASE("a 2D packing is drawn as SVG text") {
  draw_packing(scratch("flat.svg"), two_flats());
  std::ostringstream text;
  text << std::ifstream(scratch("flat.svg")).rdbuf();
  CHECK_THAT(text.str(), Contains("<svg") && Contains("</svg>") && Contains("path"));
}

TEST_CASE("colors by size and by orientation differ from those by group") {
  Packing packing = two_flats();
  for (const ColorBy by : {ColorBy::size, ColorBy::orientation}) {
    DrawOptions options{.width = 200, .height = 100, .color_by = by};
    draw_packing(scratch("by.png"), packing, options);
    const Picture picture(scratch("by.png"));
    CHECK_FALSE(is_orange(picture.at(0.75, 0.5)));
  }
}

TEST_CASE("an empty packing has a picture of its cell") {
  Packing packing;
  draw_packing(scratch("empty.png"), packing, kSmall);
  CHECK(Picture(scratch("empty.png")).width() == 160);
}

TEST_CASE("drawing refuses bad options, naming option, value and range") {
  const auto draw = [](const std::string& file, const Packing& packing, DrawOptions options) {
    draw_packing(scratch(file), packing, options);
  };
  CHECK_THROWS_WITH(draw("a.png", one_ball(0.1), {.width = 3}),
                    Contains("width = 3") && Contains("16"));
  CHECK_THROWS_WITH(draw("a.png", one_ball(0.1), {.samples = 0}), Contains("samples = 0"));
  CHECK_THROWS_WITH(draw("a.png", one_ball(0.1), {.elevation = 95.0}), Contains("elevation"));
  CHECK_THROWS_WITH(draw("a.gif", one_ball(0.1), {}), Contains(".gif") && Contains(".png"));
  CHECK_THROWS_WITH(draw("a.svg", one_ball(0.1), {}), Contains("3D") && Contains(".png"));
  Packing endless = one_ball(0.1);
  endless.inclusions[0].body = Spherocylinder{0.1, 1e9, {0, 0, 1}};
  CHECK_THROWS_WITH(draw("a.png", endless, {.cut = true}),
                    Contains("inclusion 0") && Contains("periods"));
  CHECK_THROWS_AS(draw("no/such/folder/a.png", one_ball(0.1), kSmall), FileError);
}

}  // namespace
}  // namespace packstone
