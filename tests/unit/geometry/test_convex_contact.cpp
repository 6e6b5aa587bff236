#include "geometry/convex_contact.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "support/oracle.hpp"
#include "support/pair_zoo.hpp"

using namespace packstone;
using zoo::Pair;
using zoo::PairClass;
using zoo::Zoo;

TEST_CASE("the polytope brackets a depth that is known") {
  // Parallel cylinders: M is a cylinder of radius 1.5 and half length 5.
  const MinkowskiSum<Cylinder, Cylinder> sum({1, 2, {0, 0, 1}}, {0.5, 3, {0, 0, 1}});
  const Depth end = search_depth(sum, {0.2, 0.1, 4.5}, 1e-13);
  CHECK(end.inner == Approx(0.5).epsilon(1e-12));
  CHECK(end.outer == Approx(0.5).epsilon(1e-12));
  const Depth side = search_depth(sum, {0.9, 0.0, 0.3}, 1e-13);
  CHECK(side.inner == Approx(0.6).epsilon(1e-12));
  CHECK(side.outer == Approx(0.6).epsilon(1e-12));
  // Coaxial: every direction across the axis ties. The bracket holds, but cannot close.
  const Depth tie = search_depth(sum, {0, 0, 0}, 1e-13);
  CHECK(tie.inner <= 1.5);
  CHECK(tie.outer >= 1.5 * (1 - 1e-14));
  CHECK(tie.outer - tie.inner < 1e-2);
  const Depth flat = search_depth_in_plane(sum, {0, 0, 0}, {{0, 0, 1}, {1, 0, 0}}, 1e-13);
  CHECK(flat.inner == Approx(1.5).epsilon(1e-13));
}

TEST_CASE("the polytope's bracket holds the best direction that a search in long double finds") {
  Zoo zoo(3);
  for (int k = 0; k < 60; ++k) {
    CAPTURE(k);
    Pair p = zoo.pair(ShapeKind::ellipsoid, ShapeKind::cylinder, PairClass::near);
    p.r = 0.6 * p.r;
    const MinkowskiSum<Ellipsoid, Cylinder> sum(std::get<Ellipsoid>(p.a), std::get<Cylinder>(p.b));
    const double rounding = 1e-14 * zoo::size_of(p);
    const Depth depth = search_depth(sum, p.r, 10 * rounding);
    const auto found = oracle::search_gap(p.a, p.b, p.r, 20, k, &depth.normal);
    REQUIRE(depth.inner <= depth.outer + rounding);
    REQUIRE(-static_cast<double>(found) >= depth.inner - rounding);
    REQUIRE(-static_cast<double>(found) <= depth.outer + rounding);
  }
}

TEST_CASE("slivers, flat tetrahedra and repeated corners do not mislead the distance") {
  // The side line of a long thin cylinder next to the end of a wide flat one.
  for (const double distance : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    for (const double tilt : {0.0, 1e-12, 1e-6, 1e-3}) {
      CAPTURE(distance, tilt);
      const Cylinder thin{0.01, 1, normalized(Vec3{1, tilt, 0})};
      const Cylinder flat{50, 0.5, {0, 0, 1}};
      const Gap g = convex::gap(thin, flat, {0.3, 0.2, -0.51 - distance});
      CHECK(g.value == Approx(distance).margin(1e-13));
      CHECK(g.error <= 5e-11);
      const Verdict verdict = convex::decide(thin, flat, {0.3, 0.2, -0.51 - distance}, 0.0).verdict;
      CHECK(verdict == (distance > 1e-11 ? Verdict::separated : verdict));
      CHECK(verdict != Verdict::overlapping);
      CHECK(convex::decide(thin, flat, {0.3, 0.2, -0.51 + 1e-9}, 0.0).verdict ==
            Verdict::overlapping);
    }
  }
}
