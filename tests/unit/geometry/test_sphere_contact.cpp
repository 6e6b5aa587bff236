#include "packstone/geometry/sphere_contact.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/axis_segments.hpp"
#include "geometry/convex_contact.hpp"
#include "support/each_pair.hpp"

using namespace packstone;
using zoo::Pair;
using zoo::PairClass;

namespace {

// The closed forms against the general kernels, on pairs of every class.
template <class A, class B>
void compare_with_general(ShapeKind kind_a, ShapeKind kind_b) {
  zoo::for_each_pair(kind_a, kind_b, 500, 60, [](const Pair& p, PairClass, int) {
    const A& a = std::get<A>(p.a);
    const B& b = std::get<B>(p.b);
    const Gap closed = gap(a, b, p.r);
    // Points and segments that meet have no depth, which the general kernel needs.
    if (closed.value < -0.999 * (margin(a) + margin(b)) && margin(b) > 0.0) return;
    const Gap general = convex::gap(a, b, p.r);
    REQUIRE(std::abs(closed.value - general.value) <= closed.error + general.error);
    REQUIRE(closed.error <= 1e-12 * (zoo::size_of(p) + norm(p.r)));
    const Verdict fast = decide(a, b, p.r, 0.0).verdict;
    const Verdict slow = convex::decide(a, b, p.r, 0.0).verdict;
    const bool open = fast == Verdict::undecided || slow == Verdict::undecided;
    REQUIRE((open || fast == slow));
  });
}

}  // namespace

TEST_CASE("closed forms agree with the general kernels") {
  compare_with_general<Sphere, Sphere>(ShapeKind::sphere, ShapeKind::sphere);
  compare_with_general<Sphere, Spherocylinder>(ShapeKind::sphere, ShapeKind::spherocylinder);
  compare_with_general<Spherocylinder, Spherocylinder>(ShapeKind::spherocylinder,
                                                       ShapeKind::spherocylinder);
  compare_with_general<Sphere, Cylinder>(ShapeKind::sphere, ShapeKind::cylinder);
}

TEST_CASE("sphere and cylinder: side, end, rim, and one inside the other") {
  const Body cylinder = Cylinder{1, 3, {0, 0, 1}};
  const auto gap_at = [&](double radius, const Vec3& center) {
    return gap(cylinder, Sphere{radius}, center).value;
  };
  CHECK(gap_at(0.5, {2, 0, 0}) == Approx(0.5));
  CHECK(gap_at(0.5, {0.3, 0.2, 4}) == Approx(0.5));
  // The rim touches a sphere at (0.3, 0.4): 3-4-5.
  CHECK(gap_at(0.5, {1.3, 0, 3.4}) == Approx(0.0).margin(1e-15));
  CHECK(gap_at(0.49, {1.3, 0, 3.4}) == Approx(0.01));
  // A sphere that swallows the cylinder leaves through the side.
  CHECK(gap_at(10, {0, 0, 0}) == Approx(-11));
  CHECK(gap_at(0.1, {0, 0, 2.8}) == Approx(-0.3));
  CHECK(overlap(cylinder, Sphere{10}, {}) == Verdict::overlapping);
  CHECK(overlap(cylinder, Sphere{0.49}, {1.3, 0, 3.4}) == Verdict::separated);
}

TEST_CASE("spherocylinders with crossing axes overlap by both radii, across both axes") {
  const Spherocylinder a{0.2, 3, {1, 0, 0}};
  const Spherocylinder b{0.3, 2, {0, 1, 0}};
  const Gap crossing = gap(a, b, {0.5, -0.7, 0});
  CHECK(crossing.value == Approx(-0.5));
  CHECK(std::abs(crossing.normal.z) == Approx(1.0));
  CHECK(gap(a, b, {0.5, -0.7, 1e-13}).value == Approx(-0.5));
  CHECK(gap(a, a, {}).value == Approx(-0.4));
  CHECK(gap(a, a, {1, 0, 0}).value == Approx(-0.4));
  CHECK(gap(a, a, {6.4, 0, 0}).value == Approx(0.0).margin(1e-15));
}

TEST_CASE("nearest points of segments stay accurate as the axes become parallel") {
  for (const double angle : {1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0}) {
    CAPTURE(angle);
    // The lines cross at distance 0.25 where both are at 0.4 of their first half.
    const Vec3 u{1, 0, 0}, v{std::cos(angle), std::sin(angle), 0};
    const Vec3 r = 0.4 * u - 0.4 * v + Vec3{0, 0, 0.25};
    const NearestPoints p = nearest_points({1, u}, {1, v}, r);
    CHECK(norm(p.between) == Approx(0.25).epsilon(1e-14));
  }
}
