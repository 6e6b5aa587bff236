#include "spatial/curve_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "packstone/core/random.hpp"

namespace packstone {
namespace {

// Also outside the cell.
std::vector<Vec3> scattered_points(const Cell& cell, int count) {
  RandomStream random(5, StreamId::test, static_cast<std::uint64_t>(count));
  std::vector<Vec3> points(static_cast<std::size_t>(count));
  for (Vec3& p : points) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
      p[a] = random.uniform(-1.0, 2.0) * cell.size[a];
    }
  }
  return points;
}

double path_length(const std::vector<Vec3>& points, const std::vector<std::int32_t>& order,
                   const Cell& cell) {
  double length = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    Vec3 step =
        points[static_cast<std::size_t>(order[k])] - points[static_cast<std::size_t>(order[k - 1])];
    for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
      step[a] = std::remainder(step[a], cell.size[a]);
    }
    length += norm(step);
  }
  return length;
}

TEST_CASE("the order along a curve names every point once, and neighbors after each other") {
  for (const Cell& cell : {Cell{3, {2.0, 3.0, 5.0}, {true, true, true}}, cell_2d(1.0, 2.0)}) {
    for (const int count : {0, 1, 2, 4000}) {
      const std::vector<Vec3> points = scattered_points(cell, count);
      std::vector<std::int32_t> order = curve_order(points, cell);
      std::vector<std::int32_t> as_given(order.size());
      std::iota(as_given.begin(), as_given.end(), 0);
      if (count > 2) {
        CHECK(path_length(points, order, cell) < 0.3 * path_length(points, as_given, cell));
      }
      std::sort(order.begin(), order.end());
      CHECK(order == as_given);
    }
  }
}

TEST_CASE("points at one place stay in the order given") {
  const std::vector<Vec3> points(5, Vec3{0.5, 0.25, 0.125});
  CHECK(curve_order(points, Cell{}) == std::vector<std::int32_t>{0, 1, 2, 3, 4});
}

}  // namespace
}  // namespace packstone
