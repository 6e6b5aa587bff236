#include "geometry/posed_body.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/support.hpp"
#include "support/each_pair.hpp"

namespace packstone {
namespace {

// Mean of x x^T over the body about its center, by counting points of a lattice.
SymMat3 lattice_moments(const Body& body, int per_axis) {
  const Vec3 half = half_extents(body);
  const bool plane = dimension(kind(body)) == 2;
  SymMat3 sum{};
  double count = 0.0;
  const auto at = [&](int k, double h) { return h * ((2.0 * k + 1.0) / per_axis - 1.0); };
  for (int i = 0; i < per_axis; ++i) {
    for (int j = 0; j < per_axis; ++j) {
      for (int k = 0; k < (plane ? 1 : per_axis); ++k) {
        const Vec3 x{at(i, half.x), at(j, half.y), plane ? 0.0 : at(k, half.z)};
        if (!contains(body, x)) continue;
        sum = sum + dyad(x);
        count += 1.0;
      }
    }
  }
  return (1.0 / count) * sum;
}

double inertia_about(const SymMat3& moments, const Vec3& axis) {
  return moments.xx + moments.yy + moments.zz - dot(axis, moments * axis);
}

}  // namespace

TEST_CASE("a posed body has the support function of the body, and turns back into it") {
  RandomStream random(31, StreamId::test);
  zoo::for_each_pair(31, 40, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    const PosedBody posed = posed_body(pair.a, {1, 2, 3});
    REQUIRE(posed.pose.center == Vec3{1, 2, 3});
    const Body again = turned_body(pair.a, posed.pose);
    const bool plane = dimension(kind(pair.a)) == 2;
    for (int k = 0; k < 5; ++k) {
      Vec3 d = random_direction(random);
      if (plane) d = normalized(Vec3{d.x, d.y, 0.0});
      const double right = support(pair.a, d);
      REQUIRE(std::abs(support(posed, d) - right) <= 1e-13 * right);
      REQUIRE(std::abs(support(again, d) - right) <= 1e-13 * right);
    }
  });
}

TEST_CASE("a turned body has the axes that it was turned to") {
  RandomStream random(32, StreamId::test);
  for (const Body& shape : {Body{Ellipsoid{{3, 1, 1}}}, Body{Ellipsoid{{1, 2, 3}}},
                            Body{Cylinder{1, 2}}, Body{Spherocylinder{1, 2}}}) {
    for (int k = 0; k < 20; ++k) {
      Pose pose;
      pose.axis = random_direction(random);
      pose.second = any_perpendicular(pose.axis);
      const PosedBody posed = posed_body(turned_body(shape, pose));
      CHECK(std::abs(dot(posed.pose.axis, pose.axis)) == Approx(1.0).epsilon(1e-14));
      if (posed.form != Form::scalene) continue;
      CHECK(std::abs(dot(posed.pose.second, pose.second)) == Approx(1.0).epsilon(1e-14));
    }
  }
  const PosedBody ellipse = posed_body(turned_body(Ellipse{{2, 1}}, {{}, {0, 1, 0}, {}}));
  CHECK(ellipse.pose.axis.y == Approx(1.0));
}

TEST_CASE("moments of inertia are those of a lattice of points in the body") {
  for (const Body& body :
       {Body{Ellipsoid{{3, 1, 1}}}, Body{Ellipsoid{{1, 2, 3}}}, Body{Cylinder{1, 2}},
        Body{Spherocylinder{1, 2}}, Body{Ellipse{{2, 1}}}}) {
    CAPTURE(name(kind(body)));
    const SymMat3 moments = lattice_moments(body, 160);
    const PosedBody posed = posed_body(body);
    const Vec3 inertia = specific_inertia(body);
    const bool plane = dimension(kind(body)) == 2;
    const Vec3 second = plane                         ? Vec3{0, 0, 1}
                        : posed.form == Form::scalene ? posed.pose.second
                                                      : any_perpendicular(posed.pose.axis);
    CHECK(inertia.y == Approx(inertia_about(moments, second)).epsilon(3e-3));
    if (posed.form != Form::scalene) continue;
    CHECK(inertia.x == Approx(inertia_about(moments, posed.pose.axis)).epsilon(3e-3));
    CHECK(inertia.z ==
          Approx(inertia_about(moments, cross(posed.pose.axis, second))).epsilon(3e-3));
  }
  CHECK(specific_inertia(Sphere{2}) == Vec3{});
  CHECK(specific_inertia(Ellipsoid{{2, 2, 2}}) == Vec3{});
  CHECK(specific_inertia(Disk{2}) == Vec3{});
}

}  // namespace packstone
