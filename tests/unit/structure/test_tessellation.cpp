#include "packstone/structure/tessellation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/error.hpp"

using namespace packstone;

namespace {

// A rectangle of 3 by 1 with walls above and below, cut at x = 1 into two cells; periodic along x.
Tessellation two_rectangles() {
  Tessellation t;
  t.box = cell_2d(3, 1, true, false);
  t.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  t.cells = {{{0.5, 0.5, 0}, 0, 1}, {{2, 0.5, 0}, 0, 1}};
  const auto edge = [&](Facet facet, const FacetCorner& from, const FacetCorner& to) {
    facet.first_corner = static_cast<std::int64_t>(t.corners.size());
    facet.corner_count = 2;
    t.corners.push_back(from);
    t.corners.push_back(to);
    t.facets.push_back(facet);
  };
  edge({.inner = 0, .wall = 2}, {0}, {1});
  edge({.inner = 0, .outer = 1}, {1}, {2});
  edge({.inner = 0, .wall = 3}, {2}, {3});
  edge({.inner = 0, .outer = 1, .image = {-1, 0, 0}}, {3}, {0});
  edge({.inner = 1, .wall = 2}, {1}, {0, {1, 0, 0}});
  edge({.inner = 1, .wall = 3}, {3, {1, 0, 0}}, {2});
  return t;
}

}  // namespace

TEST_CASE("cell_shapes: area, centroid and axes of rectangles across a periodic face") {
  const Tessellation t = two_rectangles();
  CHECK_NOTHROW(check_well_formed(t));
  const auto shapes = cell_shapes(t);
  CHECK(shapes[0].measure == Approx(1.0));
  CHECK(shapes[1].measure == Approx(2.0));
  CHECK(shapes[1].boundary == Approx(6.0));
  CHECK(shapes[1].centroid.x == Approx(2.0));
  CHECK(shapes[1].centroid.y == Approx(0.5));
  CHECK(shapes[1].aspect == Approx(2.0));
  // Integral of x^2 over 2 by 1 is 2 / 3; an ellipse has A a^2 / 4.
  CHECK(shapes[1].second_moment.xx == Approx(2.0 / 3.0));
  CHECK(shapes[1].semi_axes.x == Approx(2.0 / std::sqrt(3.0)));
  CHECK(std::abs(shapes[1].axes.col_x.x) == Approx(1.0));
  CHECK(inertia_tensor(shapes[1]).zz == Approx(2.0 / 3.0 + 1.0 / 6.0));
  CHECK(inertia_tensor(shapes[1]).xx == Approx(1.0 / 6.0));
}

TEST_CASE("cell_contacts lists each pair and image once") {
  const auto contacts = cell_contacts(two_rectangles());
  REQUIRE(contacts.size() == 6);
  CHECK(contacts[0].wall == 2);
  CHECK(contacts[2].b == 1);
  CHECK(contacts[2].image == std::array<int, 3>{-1, 0, 0});
  CHECK(contacts[3].image == std::array<int, 3>{0, 0, 0});
  CHECK(contacts[3].measure == Approx(1.0));
}

TEST_CASE("check_well_formed names what is wrong") {
  const auto refused = [](const auto& spoil, const std::string& part) {
    Tessellation t = two_rectangles();
    spoil(t);
    CHECK_THROWS_WITH(check_well_formed(t), Catch::Contains(part));
  };
  refused([](Tessellation& t) { t.facets.pop_back(); }, "open in 2 places");
  refused([](Tessellation& t) { std::swap(t.corners[0], t.corners[1]); }, "open");
  refused([](Tessellation& t) { t.facets[1].outer = 2; }, "facet 1: names a cell");
  refused([](Tessellation& t) { t.facets[1].outer = 0; }, "same cell on both sides");
  refused([](Tessellation& t) { t.facets[0].wall = 0; }, "wall is 0");
  refused([](Tessellation& t) { t.facets[2].corner_count = 3; }, "facet 2: has 3 corners");
  refused([](Tessellation& t) { t.corners[3].vertex = 4; }, "vertex 4");
  refused([](Tessellation& t) { t.box.size.x = 0; }, "size");
}

TEST_CASE("shape_of_moments gives back the semi-axes of an ellipsoid") {
  const Vec3 semi{3, 2, 1};
  const double volume = 8.0 * std::acos(-1.0);
  const SymMat3 moment = volume / 5.0 * SymMat3{1, 4, 9, 0, 0, 0};
  const CellShape shape = shape_of_moments(3, volume, {1, 2, 3}, moment);
  CHECK(shape.semi_axes.x == Approx(semi.x));
  CHECK(shape.semi_axes.z == Approx(semi.z));
  CHECK(shape.aspect == Approx(3.0));
  CHECK(std::abs(shape.axes.col_x.z) == Approx(1.0));
}
