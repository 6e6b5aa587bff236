#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "support/contact_properties.hpp"
#include "support/each_pair.hpp"
#include "support/oracle.hpp"
#include "support/validation_seed.hpp"

using namespace packstone;
using zoo::Pair;
using zoo::PairClass;
using zoo::Zoo;

namespace {

double larger_radius(const Pair& p) { return std::max(circum_radius(p.a), circum_radius(p.b)); }

// How far x is from the surface of the body, at most, for x near it.
double off_surface(const Body& body, const Vec3& x) {
  return std::abs(static_cast<double>(oracle::gauge(body, x)) - 1.0) * in_radius(body);
}

Quaternion any_turn(const Pair& p, Zoo& zoo) {
  return dimension(kind(p.a)) == 2 ? from_axis_angle({0, 0, 1}, zoo.uniform(-3, 3))
                                   : zoo.rotation();
}

}  // namespace

TEST_CASE("gap is attained along its normal within its error, in long double") {
  zoo::for_each_pair(11, 60, [](const Pair& p, PairClass, int) {
    const Gap g = gap(p.a, p.b, p.r);
    REQUIRE(std::abs(norm(g.normal) - 1.0) < 1e-15);
    const auto along = oracle::gap_along(p.a, p.b, p.r, g.normal);
    REQUIRE(std::abs(static_cast<double>(along - g.value)) <= g.error);
  });
}

TEST_CASE("gap is no less than a search in long double finds, within its error") {
  zoo::for_each_pair(12, 2, [](const Pair& p, PairClass, int k) {
    const Gap g = gap(p.a, p.b, p.r);
    const auto found = oracle::search_gap(p.a, p.b, p.r, 5, 100 + k, &g.normal);
    REQUIRE(static_cast<double>(found - g.value) <= g.error);
  });
}

TEST_CASE("the error of gap is below 1e-12 of the larger body") {
  zoo::for_each_pair(13, 60, [&](const Pair& p, PairClass, int) {
    REQUIRE(gap(p.a, p.b, p.r).error <= kGapRoundoff * larger_radius(p));
  });
}

TEST_CASE("the depth of nearly parallel cylinders side by side keeps within its storage") {
  // Many thin faces, few of which live: the polytope once outgrew its list of them here.
  const Body a = Cylinder{0x1.ecd883a1d6b6dp-2,
                          0x1.14490c01ff2abp+2,
                          {0x1.8c57bc1cfb3f8p-1, -0x1.cbafca0d8d5c2p-2, 0x1.c912323664768p-2}};
  const Body b = Cylinder{0x1.12f1b5fef41c5p-2,
                          0x1.a8e39028f7567p+4,
                          {0x1.8c57bc1cfa1e4p-1, -0x1.cbafca0d8fa63p-2, 0x1.c91232366614cp-2}};
  const Vec3 r{-0x1.d393762ef4c05p-1, -0x1.37b50c82fb815p-2, -0x1.6f82de9e90f3p-4};
  const Gap found = gap(a, b, r);
  CHECK(found.error < 1e-12 * circum_radius(b));
  CHECK(std::abs(found.value) < 1e-11);
}

TEST_CASE("gap has the sign that decide proves") {
  zoo::for_each_pair(14, 60, [](const Pair& p, PairClass, int) {
    const Verdict verdict = overlap(p.a, p.b, p.r);
    const Gap g = gap(p.a, p.b, p.r);
    if (verdict == Verdict::separated) REQUIRE(g.value + g.error > 0.0);
    if (verdict == Verdict::overlapping) REQUIRE(g.value - g.error < 0.0);
  });
}

TEST_CASE("contact points lie on both surfaces and differ by value times normal") {
  zoo::for_each_pair(15, 30, [](const Pair& p, PairClass, int) {
    const Gap g = gap(p.a, p.b, p.r);
    const double size = larger_radius(p) + norm(p.r);
    REQUIRE(norm(g.point_b - g.point_a - g.value * g.normal) <= kGapRoundoff * size);
    // A direction good to the square root of the rounding of its value.
    const double tolerance = 2e-6 * size + 1e3 * g.error;
    REQUIRE(off_surface(p.a, g.point_a) <= tolerance);
    REQUIRE(off_surface(p.b, g.point_b - p.r) <= tolerance);
  });
}

TEST_CASE("gap does not depend on the names of the bodies, a turn, or the unit of length") {
  Zoo zoo(17);
  zoo::for_each_pair(16, 60, [&](const Pair& p, PairClass, int k) {
    check_gap_invariance(p.a, p.b, p.r, any_turn(p, zoo), k % 2 == 0 ? 1024.0 : 3e-5);
  });
}

TEST_CASE("quick_gap_bound is a bound, and the gap itself for round bodies") {
  const auto round = [](ShapeKind k) {
    return k == ShapeKind::sphere || k == ShapeKind::spherocylinder || k == ShapeKind::disk;
  };
  zoo::for_each_pair(19, 60, [&](const Pair& p, PairClass, int) {
    const Gap g = gap(p.a, p.b, p.r);
    const double bound = quick_gap_bound(p.a, p.b, p.r);
    REQUIRE(bound <= g.value + g.error);
    if (!round(kind(p.a)) || !round(kind(p.b))) return;
    REQUIRE(bound >= g.value - g.error - 1e-13 * (larger_radius(p) + norm(p.r)));
  });
}

TEST_CASE("contact_scale brackets the scale at which decide changes its verdict") {
  int pairs = 0, wide = 0;
  zoo::for_each_pair(20, 100, [&](const Pair& p, PairClass, int) {
    const ContactScale mu = contact_scale(p.a, p.b, p.r);
    REQUIRE(mu.lower <= mu.upper);
    if (norm_sq(p.r) == 0.0) return;
    const double ratio =
        (circum_radius(p.a) + circum_radius(p.b) + norm(p.r)) / (in_radius(p.a) + in_radius(p.b));
    const double promised = std::max(1e-12, 2e-14 * ratio);
    ++pairs;
    wide += mu.upper - mu.lower > promised * mu.upper;
    REQUIRE(mu.upper - mu.lower <= 1e3 * promised * mu.upper);
    const double below = mu.lower * (1.0 - 1e-9), above = mu.upper * (1.0 + 1e-9);
    REQUIRE(overlap(scaled(p.a, below), scaled(p.b, below), p.r) != Verdict::overlapping);
    REQUIRE(overlap(scaled(p.a, above), scaled(p.b, above), p.r) != Verdict::separated);
  });
  // Rods with nearly parallel axes, whose portals are slivers.
  CAPTURE(wide, pairs);
  CHECK(wide <= pairs / 1000);
}

TEST_CASE("decide with a least gap agrees with gap") {
  Zoo zoo(21);
  zoo::for_each_pair(21, 60, [&](const Pair& p, PairClass, int) {
    const Gap g = gap(p.a, p.b, p.r);
    const double size = zoo::size_of(p) + norm(p.r);
    // Half of the gaps asked for are close to the true one.
    const double least = zoo.uniform(0, 1) < 0.5
                             ? std::abs(g.value) * zoo.uniform(0.2, 2.0) + 1e-9 * size
                             : std::max(g.value, 1e-6 * size) * (1.0 + zoo.uniform(-1e-9, 1e-9));
    const Decision decision = decide(p.a, p.b, p.r, least);
    if (decision.verdict == Verdict::separated) {
      REQUIRE(oracle::certified(p.a, p.b, p.r, least, decision));
    }
    if (decision.verdict == Verdict::overlapping) REQUIRE(g.value - g.error <= least);
    if (decision.verdict == Verdict::undecided) {
      REQUIRE(std::abs(g.value - least) <= 1e-12 * size + g.error);
    }
  });
}

TEST_CASE("validation: the error of gap holds on many pairs", "[validation]") {
  long pairs = 0, wide = 0;
  double worst = 0.0;
  zoo::for_each_pair(validation_seed(31), 2000, [&](const Pair& p, PairClass, int k) {
    const Gap g = gap(p.a, p.b, p.r);
    const auto along = oracle::gap_along(p.a, p.b, p.r, g.normal);
    REQUIRE(std::abs(static_cast<double>(along - g.value)) <= g.error);
    ++pairs;
    wide += g.error > kGapRoundoff * larger_radius(p);
    worst = std::max(worst, g.error / larger_radius(p));
    if (k % 20 != 0) return;
    const auto found = oracle::search_gap(p.a, p.b, p.r, 6, 1000 + k, &g.normal);
    REQUIRE(static_cast<double>(found - g.value) <= g.error);
  });
  WARN(pairs << " gaps, " << wide << " with an error above 1e-12, worst " << worst);
}
