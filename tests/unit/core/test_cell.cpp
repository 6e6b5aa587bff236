#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "packstone/core/cell.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

TEST_CASE("the volume of a 2D cell is its area") {
  CHECK(volume(Cell{3, {2, 3, 4}, {true, true, true}}) == 24.0);
  CHECK(volume(cell_2d(2, 3)) == 6.0);
}

TEST_CASE("the shortest period is that of a periodic axis, infinite between walls") {
  CHECK(shortest_period(Cell{3, {2, 3, 4}, {false, true, true}}) == 3.0);
  CHECK(shortest_period(Cell{2, {5, 3, 0}, {true, true, false}}) == 3.0);
  CHECK(std::isinf(shortest_period(Cell{3, {2, 3, 4}, {false, false, false}})));
}

TEST_CASE("a coordinate is wrapped into [0, length) and left alone inside") {
  for (double x : {0.0, 0.3, std::nextafter(1.0, 0.0)}) CHECK(wrapped(x, 1.0) == x);
  CHECK(wrapped(1.0, 1.0) == 0.0);
  CHECK(wrapped(-0.25, 1.0) == 0.75);
  CHECK(wrapped(7.5, 2.0) == 1.5);
  // A tiny negative number rounds to the far end, which is the near end of the next period.
  CHECK(wrapped(-1e-20, 1.0) == 0.0);
  for (double x : {-1e-300, -1e-17, 1e6 / 3.0, -1e6 / 3.0}) {
    const double y = wrapped(x, 0.7);
    CHECK((y >= 0.0 && y < 0.7));
  }
}

TEST_CASE("a point is wrapped along periodic axes only") {
  const Cell cell{3, {1, 2, 4}, {true, false, true}};
  CHECK(wrapped(cell, {1.25, 2.5, -1}) == Vec3{0.25, 2.5, 3});
  CHECK(wrapped(cell_2d(1, 1), {-0.5, 1.5, 0}) == Vec3{0.5, 0.5, 0});
}

TEST_CASE("image shifts are whole periods") {
  const Cell cell{3, {1, 2, 4}, {true, true, true}};
  CHECK(image_shift(cell, {1, -1, 2}) == Vec3{1, -2, 8});
}

TEST_CASE("bad cells are refused with the field and the value") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_NOTHROW(check_cell(Cell{}));
  CHECK_NOTHROW(check_cell(cell_2d(1, 2)));
  CHECK_THROWS_WITH(check_cell(Cell{4, {1, 1, 1}, {}}), Catch::Contains("dimension = 4"));
  CHECK_THROWS_WITH(check_cell(Cell{3, {1, 0, 1}, {}}), Catch::Contains("size[1] = 0"));
  CHECK_THROWS_AS(check_cell(Cell{3, {1, 1, -1}, {}}), InvalidArgument);
  CHECK_THROWS_AS(check_cell(Cell{3, {nan, 1, 1}, {}}), InvalidArgument);
  CHECK_THROWS_AS(check_cell(Cell{2, {1, 1, 1}, {true, true, false}}), InvalidArgument);
  CHECK_THROWS_AS(check_cell(Cell{2, {1, 1, 0}, {true, true, true}}), InvalidArgument);
}

}  // namespace
}  // namespace packstone
