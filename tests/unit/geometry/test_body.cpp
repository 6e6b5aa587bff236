#include "packstone/geometry/body.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"

using namespace packstone;
using Catch::Matchers::Contains;

TEST_CASE("check_body takes sound bodies") {
  const Body bodies[] = {Sphere{1e-300},
                         Ellipsoid{{1, 2, 3}},
                         Cylinder{1, 2, {0, 1, 0}},
                         Spherocylinder{1, 2, {1, 0, 0}},
                         Disk{1e300},
                         Ellipse{{1, 2}, -40.0}};
  for (const Body& body : bodies) CHECK_NOTHROW(check_body(body));
}

TEST_CASE("check_body names the field, the value and what is allowed") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(check_body(Sphere{0.0}), Contains("radius = 0") && Contains("> 0"));
  CHECK_THROWS_WITH(check_body(Sphere{-1.5}), Contains("radius = -1.5"));
  CHECK_THROWS_WITH(check_body(Disk{nan}), Contains("radius"));
  CHECK_THROWS_WITH(check_body(Cylinder{1, infinity}), Contains("half_length"));
  CHECK_THROWS_WITH(check_body(Cylinder{1, 1, {0, 0, 1.1}}), Contains("axis"));
  CHECK_THROWS_WITH(check_body(Spherocylinder{1, 1, {0, 0, nan}}), Contains("axis"));
  CHECK_THROWS_WITH(check_body(Ellipsoid{{1, -2, 1}}), Contains("axes[1]"));
  CHECK_THROWS_WITH(check_body(Ellipsoid{{1, 1, 1}, {0.5, 0, 0, 0}}), Contains("quaternion"));
  CHECK_THROWS_WITH(check_body(Ellipse{{1, 1}, infinity}), Contains("angle"));
  CHECK_THROWS_AS(check_body(Ellipse{{0, 1}}), InvalidArgument);
}

TEST_CASE("names and dimensions follow the order of Body") {
  CHECK(name(kind(Body(Sphere{}))) == "sphere");
  CHECK(name(kind(Body(Spherocylinder{}))) == "spherocylinder");
  CHECK(name(kind(Body(Ellipse{}))) == "ellipse");
  CHECK(dimension(kind(Body(Cylinder{}))) == 3);
  CHECK(dimension(kind(Body(Disk{}))) == 2);
}

TEST_CASE("the symmetry axis is that of revolution, or the longest") {
  CHECK(symmetry_axis({1, 1, 3}) == 2);
  CHECK(symmetry_axis({1, 1, 0.2}) == 2);
  CHECK(symmetry_axis({2, 1, 1}) == 0);
  CHECK(symmetry_axis({0.3, 1, 1}) == 0);
  CHECK(symmetry_axis({1, 2, 1}) == 1);
  CHECK(symmetry_axis({1, 2, 3}) == 2);
  CHECK(symmetry_axis({3, 2, 1}) == 0);
  CHECK(symmetry_axis({2, 3, 1}) == 1);
  CHECK(symmetry_axis({1, 1, 1}) == 2);
}

TEST_CASE("the axis of a body: revolution, else the longest; none of round ones") {
  const Quaternion turn = normalized(Quaternion{0.3, -0.5, 0.1, 0.8});
  const Mat3 frame = to_matrix(turn);
  CHECK(symmetry_axis(Body(Ellipsoid{{1, 3, 1}, turn})) == frame.col_y);
  CHECK(symmetry_axis(Body(Ellipsoid{{2, 2, 1}, turn})) == frame.col_z);
  CHECK(symmetry_axis(Body(Ellipsoid{{3, 2, 1}, turn})) == frame.col_x);
  CHECK(symmetry_axis(Body(Cylinder{1, 0.1, {0, 1, 0}})) == Vec3{0, 1, 0});
  CHECK(symmetry_axis(Body(Spherocylinder{1, 2, {1, 0, 0}})) == Vec3{1, 0, 0});
  CHECK(symmetry_axis(Body(Ellipse{{2, 1}, 0.3})) == Vec3{std::cos(0.3), std::sin(0.3), 0});
  const Vec3 upright = *symmetry_axis(Body(Ellipse{{1, 2}, 0.0}));
  CHECK(upright.y == 1.0);
  CHECK_FALSE(symmetry_axis(Body(Sphere{})).has_value());
  CHECK_FALSE(symmetry_axis(Body(Disk{})).has_value());
}
