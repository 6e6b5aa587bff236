#include "packstone/geometry/bounds.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/geometry/support.hpp"
#include "support/oracle.hpp"
#include "support/pair_zoo.hpp"

using namespace packstone;
using zoo::Zoo;

namespace {

template <class Check>
void for_bodies(std::uint64_t seed, int count, Check&& check) {
  for (int i = 0; i < 6; ++i) {
    const auto kind = static_cast<ShapeKind>(i);
    Zoo zoo(seed + i);
    for (int k = 0; k < count; ++k) {
      CAPTURE(name(kind), k);
      check(zoo.body(kind, 1.0), dimension(kind), zoo);
    }
  }
}

}  // namespace

TEST_CASE("every point of the surface lies between the inner and the outer radius") {
  for_bodies(1, 3000, [](const Body& body, int dim, Zoo& zoo) {
    const Vec3 d = zoo.direction(dim);
    const double distance = 1.0 / static_cast<double>(oracle::gauge(body, d));
    REQUIRE(distance >= in_radius(body) * (1.0 - 1e-14));
    REQUIRE(distance <= circum_radius(body) * (1.0 + 1e-14));
  });
}

TEST_CASE("the radii are attained") {
  CHECK(in_radius(Cylinder{2.0, 0.5}) == 0.5);
  CHECK(in_radius(Cylinder{0.5, 2.0}) == 0.5);
  CHECK(circum_radius(Cylinder{3.0, 4.0}) == 5.0);
  CHECK(circum_radius(Spherocylinder{3.0, 4.0}) == 7.0);
  CHECK(in_radius(Spherocylinder{3.0, 0.5}) == 3.0);
  CHECK(in_radius(Ellipsoid{{3.0, 1.0, 2.0}}) == 1.0);
  CHECK(circum_radius(Ellipsoid{{1.0, 3.0, 2.0}}) == 3.0);
  CHECK(in_radius(Ellipse{{3.0, 1.0}}) == 1.0);
  CHECK(circum_radius(Ellipse{{1.0, 3.0}}) == 3.0);
  CHECK(circum_radius(Sphere{2.0}) == in_radius(Sphere{2.0}));
  CHECK(circum_radius(Disk{2.0}) == in_radius(Disk{2.0}));
}

TEST_CASE("the box holds the body for certain and is tight") {
  for_bodies(2, 3000, [](const Body& body, int dim, Zoo& zoo) {
    const Vec3 half = half_extents(body);
    const Vec3 p = support_point(body, zoo.direction(dim));
    for (int axis = 0; axis < dim; ++axis) {
      Vec3 d;
      d[axis] = 1.0;
      const auto exact = oracle::support(body, d);
      REQUIRE(half[axis] >= exact);
      REQUIRE(half[axis] <= exact + 1e-14L * circum_radius(body));
      REQUIRE(std::abs(p[axis]) <= half[axis] * (1.0 + 1e-14));
    }
    if (dim == 2) REQUIRE(half.z == 0.0);
  });
}
