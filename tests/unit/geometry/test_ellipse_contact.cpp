#include "packstone/geometry/ellipse_contact.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "packstone/core/random.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"
#include "support/contact_properties.hpp"
#include "support/oracle.hpp"
#include "support/validation_seed.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

struct EllipsePair {
  Ellipse a, b;
  Vec3 r;
};

double log_uniform(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

Vec3 plane_direction(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }
Vec3 random_plane_direction(RandomStream& random) {
  return plane_direction(random.uniform(-pi, pi));
}

// Aspect 0.01 to 100.
Ellipse random_ellipse(RandomStream& random, double size) {
  const double root = std::sqrt(log_uniform(random, 0.01, 100.0));
  return {{size * root, size / root}, random.uniform(-pi, pi)};
}

// Generic, parallel, similar, very different sizes; concentric, far, tangent within 1e-2 to 1e-9.
EllipsePair random_pair(RandomStream& random) {
  EllipsePair pair{random_ellipse(random, 1.0), random_ellipse(random, 1.0), {}};
  switch (random.below(6)) {
    case 0:
      pair.b.angle = pair.a.angle;
      break;
    case 1:
      pair.b = {{0.7 * pair.a.semi_axes.x, 0.7 * pair.a.semi_axes.y}, pair.a.angle};
      break;
    case 2:
      pair.b = random_ellipse(random, log_uniform(random, 1e-3, 1.0));
      break;
    case 3:
      pair.a.semi_axes.y = pair.a.semi_axes.x;
      break;
    default:
      break;
  }
  const Vec3 d = random_plane_direction(random);
  const ContactScale found = contact_scale(pair.a, pair.b, d);
  const double touching = 2.0 / (found.lower + found.upper);
  switch (random.below(6)) {
    case 0:
      return pair;
    case 1:
      pair.r = log_uniform(random, 1e-12, 1e-3) * d;
      return pair;
    case 2:
      pair.r = log_uniform(random, 100.0, 1e6) * d;
      return pair;
    case 3: {
      const double width = std::pow(10.0, -2.0 - static_cast<double>(random.below(8)));
      pair.r = touching * (1.0 + width * random.uniform(-1.0, 1.0)) * d;
      return pair;
    }
    default:
      pair.r = touching * random.uniform(0.2, 2.0) * d;
      return pair;
  }
}

double size_of(const Body& a, const Body& b) {
  return std::max(circum_radius(a), circum_radius(b));
}

template <class A>
void check_verdicts(std::uint64_t seed, int pairs, A&& first_of) {
  RandomStream random(seed, StreamId::test);
  int wrong = 0, far_from_touching = 0;
  for (int i = 0; i < pairs; ++i) {
    const EllipsePair p = random_pair(random);
    const auto a = first_of(p.a);
    const Decision decision = decide(a, p.b, p.r);
    wrong += !oracle::certified(a, p.b, p.r, 0.0, decision);
    if (decision.verdict == Verdict::undecided) {
      far_from_touching += std::abs(gap(a, p.b, p.r).value) > 1e-12 * size_of(a, p.b);
    }
  }
  CHECK(wrong == 0);
  CHECK(far_from_touching == 0);
}

const auto kSame = [](const Ellipse& e) { return e; };
const auto kAsDisk = [](const Ellipse& e) { return Disk{e.semi_axes.x}; };

TEST_CASE("verdicts on 10^5 pairs of ellipses are proven by their witnesses") {
  check_verdicts(1, 100'000, kSame);
}

TEST_CASE("verdicts on 10^5 pairs of disk and ellipse are proven by their witnesses") {
  check_verdicts(2, 100'000, kAsDisk);
}

TEST_CASE("verdicts on 10^7 pairs of ellipses and of disk and ellipse are proven", "[validation]") {
  check_verdicts(validation_seed(3), 10'000'000, kSame);
  check_verdicts(validation_seed(4), 10'000'000, kAsDisk);
}

template <class A>
void check_gap(const A& a, const Ellipse& b, const Vec3& r) {
  const Gap g = gap(a, b, r);
  const double size = size_of(a, b);
  CAPTURE(r.x, r.y, g.value, g.error);
  if (norm(r) < 100.0) REQUIRE(g.error <= kGapRoundoff * size);
  REQUIRE(std::abs(static_cast<double>(oracle::gap_along(a, b, r, g.normal)) - g.value) <= g.error);
  for (int k = 0; k < 360; ++k) {
    REQUIRE(oracle::gap_along(a, b, r, plane_direction(k * pi / 180)) <= g.value + g.error);
  }
  // Rounding of point_b - r over the least semi-axis, 0.1 to 1e-3 here.
  if (norm(r) < 100.0) CHECK(std::abs(oracle::gauge(b, g.point_b - r) - 1) < 1e-9);
  if (g.value > 0.0)
    CHECK(norm(g.point_b - g.point_a - g.value * g.normal) < 1e-10 * (size + norm(r)));
}

TEST_CASE("the gap in the plane is proven to 1e-12 of the larger body and not beaten by a scan") {
  RandomStream random(5, StreamId::test);
  for (int i = 0; i < 2'000; ++i) {
    const EllipsePair p = random_pair(random);
    check_gap(p.a, p.b, p.r);
    check_gap(kAsDisk(p.a), p.b, p.r);
  }
}

TEST_CASE("contact of ellipses does not depend on names, place or unit") {
  RandomStream random(6, StreamId::test);
  for (int i = 0; i < 5'000; ++i) {
    const EllipsePair p = random_pair(random);
    const Quaternion turn = from_axis_angle({0, 0, 1}, random.uniform(-pi, pi));
    check_gap_invariance(p.a, p.b, p.r, turn, log_uniform(random, 1e-9, 1e9));
  }
}

TEST_CASE("ellipses touch at the scale at which ellipsoids over them touch") {
  RandomStream random(7, StreamId::test);
  const auto over = [&](const Ellipse& e) {
    return Ellipsoid{{e.semi_axes.x, e.semi_axes.y, random.uniform(0.5, 2.0)},
                     from_axis_angle({0, 0, 1}, e.angle)};
  };
  for (int i = 0; i < 20'000; ++i) {
    const EllipsePair p = random_pair(random);
    const ContactScale plane = contact_scale(p.a, p.b, p.r);
    const ContactScale space = contact_scale(over(p.a), over(p.b), p.r);
    // The rotation of the ellipsoid is rounded differently; at aspect 100 that is 1e-14 of a level,
    // times the ratio of sizes.
    CHECK(plane.lower <= space.upper * (1 + 1e-10));
    CHECK(space.lower <= plane.upper * (1 + 1e-10));
    CHECK(plane.upper - plane.lower <= 1e-12 * plane.upper);
  }
}

TEST_CASE("a longer semi-axis never widens the gap of ellipses") {
  RandomStream random(8, StreamId::test);
  for (int i = 0; i < 5'000; ++i) {
    const EllipsePair p = random_pair(random);
    Ellipse longer = p.a;
    (random.below(2) == 0 ? longer.semi_axes.x : longer.semi_axes.y) *= random.uniform(1.0, 2.0);
    check_no_wider(gap(p.a, p.b, p.r), gap(longer, p.b, p.r));
  }
}

TEST_CASE("disks are closed, and ellipses with equal semi-axes are disks") {
  RandomStream random(9, StreamId::test);
  for (int i = 0; i < 5'000; ++i) {
    const Disk a{log_uniform(random, 0.01, 1.0)}, b{log_uniform(random, 0.01, 1.0)};
    const Ellipse a_round{{a.radius, a.radius}, random.uniform(-pi, pi)};
    const Ellipse b_round{{b.radius, b.radius}, random.uniform(-pi, pi)};
    const Vec3 r = random.uniform(0.0, 2.0) * random_plane_direction(random);
    const Gap closed = gap(a, b, r);
    CHECK(closed.value == Approx(norm(r) - a.radius - b.radius).margin(1e-15));
    const Gap mixed = gap(a, b_round, r), searched = gap(a_round, b_round, r);
    CHECK(std::abs(mixed.value - closed.value) <= mixed.error + closed.error);
    CHECK(std::abs(searched.value - closed.value) <= searched.error + closed.error);
    REQUIRE(oracle::certified(a, b, r, 0.0, decide(a, b, r)));
    CHECK((decide(a, b, r).verdict == Verdict::separated) == (closed.value > 0.0));
  }
  CHECK(decide(Disk{1}, Disk{1}, {2, 0, 0}).verdict == Verdict::undecided);
  CHECK(decide(Disk{1}, Disk{2}, {0, 0, 0}).verdict == Verdict::overlapping);
}

TEST_CASE("decide in the plane with a least gap agrees with the gap") {
  RandomStream random(10, StreamId::test);
  for (int i = 0; i < 10'000; ++i) {
    const EllipsePair p = random_pair(random);
    check_least_gap(p.a, p.b, p.r, log_uniform(random, 1e-6, 1.0));
  }
}

TEST_CASE("crossed ellipses are as deep as the nearer way out") {
  // A cross of two 10:1 ellipses: the way out is along either long axis, 10 + 1 far.
  const Ellipse flat{{10, 1}, 0.0}, upright{{10, 1}, 0.5 * pi};
  CHECK(gap(flat, upright, {0, 0, 0}).value <= -10.0);
  // Side by side they leave each other across the short axes.
  CHECK(gap(flat, flat, {0, 0, 0}).value == Approx(-2.0).epsilon(1e-13));
  CHECK(gap(flat, flat, {0, 0.5, 0}).value == Approx(-1.5).epsilon(1e-13));
}

}  // namespace
}  // namespace packstone
