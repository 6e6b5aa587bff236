#include "packstone/io/draw_tessellation.hpp"

#include <catch2/catch.hpp>

#include "packstone/core/error.hpp"
#include "packstone/tessellate/laguerre.hpp"
#include "support/hand_made_cells.hpp"
#include "support/picture.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

using test::is_blue;
using test::is_orange;
using test::is_white;
using test::Picture;

DrawTessellationOptions small(bool cut) {
  DrawTessellationOptions options;
  options.picture.width = 240;
  options.picture.height = 240;
  options.picture.samples = 2;
  options.picture.cut = cut;
  return options;
}

// Two bands, split at x = 0.35 and at x = 0.85; the second one has the face x = 1 inside.
struct Bands {
  Packing packing{cell_2d(1, 1), {"first", "second"}, {}, {}, {}};
  Tessellation tessellation;

  Bands() {
    packing.inclusions = {{{0.6, 0.5, 0}, Disk{0.1}, 0}, {{0.1, 0.5, 0}, Disk{0.1}, 1}};
    tessellation =
        laguerre_tessellate(packing, {.inflate = false, .ordered_measures = false}).tessellation;
  }
};

TEST_CASE("cells are drawn whole in the color of their group, or cut at the box") {
  const test::TemporaryFolder folder;
  const Bands bands;
  draw_tessellation(folder / "cut.png", bands.tessellation, bands.packing, small(true));
  const Picture cut(folder / "cut.png");
  CHECK(cut.width() == 240);
  CHECK(is_orange(cut.at(0.2, 0.5)));
  CHECK(is_blue(cut.at(0.5, 0.25)));
  CHECK(is_orange(cut.at(0.9, 0.5)));  // the image beyond the face
  draw_tessellation(folder / "whole.png", bands.tessellation, bands.packing, small(false));
  const Picture whole(folder / "whole.png");
  CHECK(is_orange(whole.at(0.1, 0.5)));
  CHECK_FALSE(is_orange(whole.at(0.9, 0.5)));
}

TEST_CASE("inclusions are drawn over their cells when asked for") {
  const test::TemporaryFolder folder;
  const Bands bands;
  DrawTessellationOptions options = small(true);
  draw_tessellation(folder / "plain.png", bands.tessellation, bands.packing, options);
  options.inclusions = true;
  draw_tessellation(folder / "over.png", bands.tessellation, bands.packing, options);
  const auto plain = Picture(folder / "plain.png").at(0.6, 0.5);
  const auto over = Picture(folder / "over.png").at(0.6, 0.5);
  CHECK(over.red > plain.red + 30);
  CHECK(Picture(folder / "over.png").at(0.6, 0.2).red == plain.red);
}

TEST_CASE("cells in the plane are drawn as SVG, by size and by orientation") {
  const test::TemporaryFolder folder;
  const Packing packing = test::jittered_ellipses(3, true, false);
  const Tessellation t = laguerre_tessellate(packing).tessellation;
  DrawTessellationOptions options = small(true);
  std::string before;
  for (const ColorBy by : {ColorBy::group, ColorBy::size, ColorBy::orientation}) {
    options.picture.color_by = by;
    draw_tessellation(folder / "cells.svg", t, packing, options);
    const std::string text = test::content_of(folder / "cells.svg");
    CHECK_THAT(text, Catch::Contains("<svg") && Catch::Contains("</svg>"));
    CHECK(text != before);
    before = text;
  }
}

TEST_CASE("polyhedra stand in the middle of their picture, in the color of their group") {
  const test::TemporaryFolder folder;
  Packing packing{{}, {"one"}, {{{0.5, 0.5, 0.5}, Sphere{0.2}, 0}}, {}, {}};
  const Tessellation t = laguerre_tessellate(packing).tessellation;
  draw_tessellation(folder / "cell.png", t, packing, small(false));
  const Picture picture(folder / "cell.png");
  CHECK(is_blue(picture.at(0.45, 0.6)));
  CHECK(is_white(picture.at(0.01, 0.01)));
  draw_tessellation(folder / "threads.png", t, packing, small(false), RunContext{}.threads(2));
  CHECK(test::content_of(folder / "cell.png") == test::content_of(folder / "threads.png"));
}

TEST_CASE("drawing cells refuses what it cannot do") {
  const test::TemporaryFolder folder;
  const Packing solid = test::jittered_bodies(2, {true, true, true});
  const Tessellation t = laguerre_tessellate(solid).tessellation;
  CHECK_THROWS_WITH(draw_tessellation(folder / "a.svg", t, solid, small(false)),
                    Catch::Contains("cannot draw a 3D tessellation"));
  CHECK_THROWS_WITH(draw_tessellation(folder / "a.png", t, solid, small(true)),
                    Catch::Contains("whole"));
  DrawTessellationOptions options = small(false);
  options.inclusions = true;
  CHECK_THROWS_AS(draw_tessellation(folder / "a.png", t, solid, options), InvalidArgument);
  options.inclusions = false;
  options.picture.width = 3;
  CHECK_THROWS_WITH(draw_tessellation(folder / "a.png", t, solid, options),
                    Catch::Contains("width = 3"));
  CHECK_THROWS_WITH(draw_tessellation(folder / "a.png", t, test::cells_in_parts_packing()),
                    Catch::Contains("4 inclusions"));
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace packstone
