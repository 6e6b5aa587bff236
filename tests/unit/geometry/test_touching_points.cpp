#include "geometry/touching_points.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/gap_ascent.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "support/each_pair.hpp"
#include "support/oracle.hpp"
#include "support/posed_pair.hpp"

namespace packstone {
namespace {

using zoo::gap_along;
using zoo::posed_pair;
using zoo::PosedPair;

// Neither outside its body, but for sides taken to rest on a plane that they are tilted to, nor
// anywhere but across from the other.
void check_points(const zoo::Pair& pair, const PosedPair& p, const Vec3& n,
                  const TouchingPoints& points) {
  constexpr double kTilted = 1e-7;
  const double reach = zoo::size_of(pair);
  REQUIRE(std::abs(dot(n, points.of_a) - support(p.a, n)) <= 1e-13 * reach);
  REQUIRE(std::abs(dot(n, points.of_b) + support(p.b, n)) <= 1e-13 * reach);
  const auto outside = [](const Body& body, const Vec3& point) {
    const double most = circum_radius(body) / in_radius(body);
    return static_cast<double>(oracle::gauge(body, point)) - 1.0 > 2.0 * kTilted * most;
  };
  REQUIRE_FALSE(outside(pair.a, points.of_a));
  REQUIRE_FALSE(outside(pair.b, points.of_b));
  const Vec3 between = pair.r + points.of_b - points.of_a;
  REQUIRE(norm(between - dot(between, n) * n) <= 1e-5 * reach);
}

// A rod touched by another on the stretch of its side from low to high.
struct Stretch {
  double low, high;
};
Stretch stretch_of(const Body& other, const Vec3& center) {
  const PosedPair p = posed_pair({Spherocylinder{1, 3, {0, 0, 1}}, other, center});
  const auto at = [&](double z) {
    return touching_points(p.a, p.b, center, {1, 0, 0}, {0, 0, z}).of_a.z;
  };
  CHECK(at(0.0) == Approx(0.5 * (at(-1.0) + at(1.0))).margin(1e-15));
  return {at(-1.0), at(1.0)};
}

}  // namespace

TEST_CASE("the support point is on the surface, and nothing of the body lies beyond it") {
  zoo::Zoo zoo(2);
  for (int k = 0; k < 6; ++k) {
    for (int trial = 0; trial < 200; ++trial) {
      const Body body = zoo.body(static_cast<ShapeKind>(k), 1.0);
      const PosedBody posed = posed_pair({body, body, {}}).a;
      const Vec3 n = zoo.direction(dimension(kind(body)));
      const Vec3 p = support_point(posed, n);
      CHECK(std::abs(dot(n, p) - support(posed, n)) <= 1e-14 * circum_radius(body));
      // Rounding over the smallest semi-axis, 1/50 to 1/100 of the largest.
      CHECK(static_cast<double>(oracle::gauge(body, p)) == Approx(1.0).epsilon(1e-11));
    }
  }
}

TEST_CASE("on flat sides and straight lines the support point is in the middle") {
  const PosedBody cylinder = posed_pair({Cylinder{1, 3}, Cylinder{1, 3}, {}}).a;
  CHECK(support_point(cylinder, {0, 0, 1}) == Vec3{0, 0, 3});
  CHECK(support_point(cylinder, {1, 0, 0}) == Vec3{1, 0, 0});
  const PosedBody capsule = posed_pair({Spherocylinder{1, 3}, Spherocylinder{1, 3}, {}}).a;
  CHECK(support_point(capsule, {0, 0, -1}) == Vec3{0, 0, -4});
  CHECK(support_point(capsule, {0, 1, 0}) == Vec3{0, 1, 0});
}

TEST_CASE("bodies that nearly touch meet at points of both, across from each other") {
  zoo::Zoo zoo(3);
  zoo::for_each_pair(3, 30, [&](const zoo::Pair& drawn, zoo::PairClass, int k) {
    const double wanted = k < 10 ? 1e-12 : k < 20 ? 1e-9 : 1e-7;
    const zoo::Pair pair = zoo::moved_apart(drawn, wanted * zoo::size_of(drawn));
    if (gap(pair.a, pair.b, pair.r).value > 2.0 * wanted * zoo::size_of(drawn)) return;
    const PosedPair p = posed_pair(pair);
    const Vec3 n = ascend_gap(p.a, p.b, pair.r, normalized(pair.r), 1e-9);
    const Vec3 toward = zoo.direction(3);
    const TouchingPoints middle = touching_points(p.a, p.b, pair.r, n, {});
    const TouchingPoints farthest = touching_points(p.a, p.b, pair.r, n, toward);
    check_points(pair, p, n, middle);
    check_points(pair, p, n, farthest);
    REQUIRE(dot(farthest.of_a - middle.of_a, toward) >= -1e-12 * zoo::size_of(pair));
  });
}

TEST_CASE("parallel sides meet along the stretch that both cover") {
  const Stretch both = stretch_of(Spherocylinder{1, 2, {0, 0, 1}}, {2, 0, 4});
  CHECK(both.low == Approx(2.0));
  CHECK(both.high == Approx(3.0));
  const Stretch inner = stretch_of(Cylinder{1, 0.5, {0, 0, -1}}, {2, 0, -1});
  CHECK(inner.low == Approx(-1.5));
  CHECK(inner.high == Approx(-0.5));
}

TEST_CASE("sides that cross meet where they do") {
  const Stretch point = stretch_of(Cylinder{1, 5, {0, 1, 0}}, {2, 1, 1.25});
  CHECK(point.low == Approx(1.25));
  CHECK(point.high == Approx(1.25));
}

TEST_CASE("a side meets a flat end along the chord that lies on both") {
  // The end of radius 1, its middle 0.6 off the line: half a chord of 0.8.
  const Stretch chord = stretch_of(Cylinder{1, 2, {1, 0, 0}}, {3, 0.6, 1});
  CHECK(chord.low == Approx(0.2));
  CHECK(chord.high == Approx(1.8));
  const Stretch cut = stretch_of(Cylinder{1, 2, {1, 0, 0}}, {3, 0.6, 3});
  CHECK(cut.low == Approx(2.2));
  CHECK(cut.high == Approx(3.0));
}

TEST_CASE("flat ends meet in the lens that they share") {
  const Vec3 n{0, 0, 1}, r{1.2, 0, 4};
  const PosedPair p = posed_pair({Cylinder{1, 2}, Cylinder{1, 2}, r});
  const auto toward = [&](const Vec3& way) { return touching_points(p.a, p.b, r, n, way).of_a; };
  CHECK(norm(toward({}) - Vec3{0.6, 0, 2}) <= 1e-15);
  CHECK(norm(toward({1, 0, 0}) - Vec3{1, 0, 2}) <= 1e-15);
  CHECK(norm(toward({-1, 0, 0}) - Vec3{0.2, 0, 2}) <= 1e-15);
  CHECK(norm(toward({0, 1, 0}) - Vec3{0.6, 0.8, 2}) <= 1e-15);
  CHECK(norm(toward({0.1, -1, 7}) - Vec3{0.6, -0.8, 2}) <= 1e-15);
  // A small end on a large one: all of its own.
  const PosedPair small = posed_pair({Cylinder{4, 2}, Cylinder{1, 2}, r});
  CHECK(norm(touching_points(small.a, small.b, r, n, {0, 1, 0}).of_a - Vec3{1.2, 1, 2}) <= 1e-15);
  CHECK(norm(touching_points(small.a, small.b, r, n, {}).of_a - Vec3{1.2, 0, 2}) <= 1e-15);
}

TEST_CASE("against a wall all of a side is met") {
  const PosedBody rod = posed_pair({Cylinder{1, 3}, Cylinder{1, 3}, {}}).a;
  CHECK(touching_point(rod, {1, 0, 0}, {}) == Vec3{1, 0, 0});
  CHECK(touching_point(rod, {1, 0, 0}, {5, 0, -0.1}) == Vec3{1, 0, -3});
  CHECK(touching_point(rod, {0, 0, 1}, {}) == Vec3{0, 0, 3});
  CHECK(touching_point(rod, {0, 0, 1}, {0, -2, 9}) == Vec3{0, -1, 3});
}

}  // namespace packstone
