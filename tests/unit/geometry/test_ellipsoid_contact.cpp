#include "packstone/geometry/ellipsoid_contact.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/random.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"
#include "support/contact_properties.hpp"
#include "support/oracle.hpp"
#include "support/validation_seed.hpp"

namespace packstone {
namespace {

struct EllipsoidPair {
  Ellipsoid a, b;
  Vec3 r;
};

double log_uniform(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

// Prolate, oblate or scalene, aspect up to 100.
Ellipsoid random_ellipsoid(RandomStream& random, double size) {
  const double aspect = log_uniform(random, 1.0, 100.0);
  Vec3 axes{1, 1, aspect};
  if (random.below(3) == 0) axes = {1, aspect, aspect};
  if (random.below(3) == 0) axes = {1, log_uniform(random, 1.0, aspect), aspect};
  return {size / std::cbrt(axes.x * axes.y * axes.z) * axes, random_rotation(random)};
}

// r such that both bodies scaled by `scale` touch, up to the bracket's width.
Vec3 at_scale(const Ellipsoid& a, const Ellipsoid& b, const Vec3& direction, double scale) {
  const ContactScale found = contact_scale(a, b, direction);
  return (scale / (0.5 * (found.lower + found.upper))) * direction;
}

// Generic, parallel and similar, coaxial, very different sizes, concentric, far, and tangent within
// 1e-2 to 1e-9.
EllipsoidPair random_pair(RandomStream& random) {
  EllipsoidPair pair{random_ellipsoid(random, 1.0), random_ellipsoid(random, 1.0), {}};
  const Vec3 direction = random_direction(random);
  switch (random.below(5)) {
    case 0:
      pair.b.orientation = pair.a.orientation;
      break;
    case 1:
      pair.b = {0.7 * pair.a.semi_axes, pair.a.orientation};
      break;
    case 2:
      pair.b.semi_axes *= log_uniform(random, 1e-3, 1.0);
      break;
    default:
      break;
  }
  switch (random.below(8)) {
    case 0:
      return pair;
    case 1:
      pair.r = log_uniform(random, 1e-12, 1e-3) * direction;
      return pair;
    case 2:
      pair.r = log_uniform(random, 100.0, 1e6) * direction;
      return pair;
    case 3:
      pair.r =
          at_scale(pair.a, pair.b, rotate(pair.a.orientation, {0, 0, 1}), random.uniform(0.5, 1.5));
      return pair;
    case 4: {
      const double width = std::pow(10.0, -2.0 - static_cast<double>(random.below(8)));
      pair.r = at_scale(pair.a, pair.b, direction, 1.0 + width * random.uniform(-1.0, 1.0));
      return pair;
    }
    default:
      pair.r = at_scale(pair.a, pair.b, direction, random.uniform(0.2, 2.0));
      return pair;
  }
}

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return std::max(circum_radius(a), circum_radius(b));
}

void check_verdicts(std::uint64_t seed, int pairs) {
  RandomStream random(seed, StreamId::test);
  int wrong = 0, far_from_touching = 0;
  for (int i = 0; i < pairs; ++i) {
    const EllipsoidPair p = random_pair(random);
    const Decision decision = decide(p.a, p.b, p.r);
    if (decision.verdict == Verdict::undecided) {
      // Rounding of a point near the thinnest axis: 1e-16 times the aspect, times a size ratio.
      const ContactScale scale = contact_scale(p.a, p.b, p.r);
      far_from_touching += !(scale.lower < 1.0 + 1e-9 && scale.upper > 1.0 - 1e-9);
    } else {
      wrong += !oracle::certified(p.a, p.b, p.r, 0.0, decision);
    }
  }
  CHECK(wrong == 0);
  CHECK(far_from_touching == 0);
}

TEST_CASE("verdicts on 10^5 ellipsoid pairs of every class are proven by their witnesses") {
  check_verdicts(1, 100'000);
}

TEST_CASE("verdicts on 10^7 ellipsoid pairs of every class are proven by their witnesses",
          "[validation]") {
  check_verdicts(validation_seed(2), 10'000'000);
}

TEST_CASE("the bracket of the contact scale is closed to 1e-12 and holds the scale") {
  RandomStream random(3, StreamId::test);
  for (int i = 0; i < 20'000; ++i) {
    const EllipsoidPair p = random_pair(random);
    if (p.r == Vec3{}) continue;
    const ContactScale scale = contact_scale(p.a, p.b, p.r);
    REQUIRE(scale.lower <= scale.upper);
    // Bodies grown past the bracket share a point; shrunk below it they do not.
    const double up = scale.upper * (1 + 1e-9), down = scale.lower * (1 - 1e-9);
    REQUIRE(
        decide({up * p.a.semi_axes, p.a.orientation}, {up * p.b.semi_axes, p.b.orientation}, p.r)
            .verdict != Verdict::separated);
    REQUIRE(decide({down * p.a.semi_axes, p.a.orientation}, {down * p.b.semi_axes, p.b.orientation},
                   p.r)
                .verdict != Verdict::overlapping);
    if (std::max(p.a.semi_axes.x, p.b.semi_axes.x) <
        1e3 * std::min(p.a.semi_axes.x, p.b.semi_axes.x)) {
      REQUIRE(scale.upper - scale.lower <= 1e-12 * scale.upper);
    }
  }
  CHECK(contact_scale(Ellipsoid{{1, 2, 3}, {}}, Ellipsoid{{3, 2, 1}, {}}, {}).upper == 0.0);
}

TEST_CASE("the gap of two ellipsoids is proven to 1e-12 of the larger and attained") {
  RandomStream random(4, StreamId::test);
  int loose = 0;
  const int pairs = 1'000;
  for (int i = 0; i < pairs; ++i) {
    const EllipsoidPair p = random_pair(random);
    const Gap g = gap(p.a, p.b, p.r);
    const double size = size_of(p.a, p.b) + norm(p.r);
    loose += g.error > kGapRoundoff * size_of(p.a, p.b) && norm(p.r) < 100;
    REQUIRE(std::abs(static_cast<double>(oracle::gap_along(p.a, p.b, p.r, g.normal)) - g.value) <=
            g.error);
    REQUIRE(norm(g.normal) == Approx(1.0).epsilon(1e-14));
    // Points sit on the surfaces; their error is that of the direction times the largest radius of
    // curvature, at most 100 sizes at aspect 100.
    CHECK(std::abs(oracle::gauge(p.a, g.point_a) - 1) < 1e-11);
    if (g.value > 0.0) CHECK(norm(g.point_b - g.point_a - g.value * g.normal) < 1e-10 * size);
    for (int k = 0; k < 100; ++k) {
      REQUIRE(oracle::gap_along(p.a, p.b, p.r, random_direction(random)) <= g.value + g.error);
    }
  }
  CHECK(loose == 0);
}

TEST_CASE("contact of ellipsoids does not depend on names, place or unit") {
  RandomStream random(5, StreamId::test);
  for (int i = 0; i < 1'000; ++i) {
    const EllipsoidPair p = random_pair(random);
    if (norm(p.r) < 1e-6 || norm(p.r) > 1e3) continue;
    const double unit = log_uniform(random, 1e-9, 1e9);
    check_gap_invariance(p.a, p.b, p.r, random_rotation(random), unit);

    const ContactScale mu = contact_scale(p.a, p.b, p.r);
    const double mean = 0.5 * (mu.lower + mu.upper);
    CHECK(contact_scale(p.b, p.a, -p.r).lower == Approx(mean).epsilon(1e-9));
    CHECK(contact_scale(p.a, p.b, unit * p.r).lower == Approx(unit * mean).epsilon(1e-9));
  }
}

TEST_CASE("a longer semi-axis never widens the gap nor raises the contact scale") {
  RandomStream random(6, StreamId::test);
  for (int i = 0; i < 500; ++i) {
    const EllipsoidPair p = random_pair(random);
    Ellipsoid longer = p.a;
    longer.semi_axes[random.below(3)] *= random.uniform(1.0, 2.0);
    check_no_wider(gap(p.a, p.b, p.r), gap(longer, p.b, p.r));
    CHECK(contact_scale(longer, p.b, p.r).lower <= contact_scale(p.a, p.b, p.r).upper);
  }
}

TEST_CASE("ellipsoids with equal semi-axes are balls") {
  RandomStream random(7, StreamId::test);
  for (int i = 0; i < 2'000; ++i) {
    const double ra = log_uniform(random, 0.01, 1.0), rb = log_uniform(random, 0.01, 1.0);
    const Ellipsoid a{{ra, ra, ra}, random_rotation(random)};
    const Ellipsoid b{{rb, rb, rb}, random_rotation(random)};
    const double distance = random.uniform(0.0, 2.0);
    const Vec3 r = distance * random_direction(random);
    const Gap g = gap(a, b, r);
    CHECK(std::abs(g.value - (norm(r) - ra - rb)) <= g.error + 1e-15);
    CHECK(g.error <= 1e-13);
    CHECK(contact_scale(a, b, r).upper == Approx(norm(r) / (ra + rb)).epsilon(1e-12));
  }
}

TEST_CASE("decide with a least gap agrees with the gap, and a direction proves it") {
  RandomStream random(8, StreamId::test);
  for (int i = 0; i < 1'000; ++i) {
    const EllipsoidPair p = random_pair(random);
    check_least_gap(p.a, p.b, p.r, log_uniform(random, 1e-6, 1.0));
  }
}

// Ball and ellipsoid: centers anywhere, on the planes of symmetry, at the center, on the surface.
void check_ball_pairs(std::uint64_t seed, int pairs) {
  RandomStream random(seed, StreamId::test);
  int wrong = 0, undecided = 0, loose = 0;
  for (int i = 0; i < pairs; ++i) {
    const Ellipsoid b = random_ellipsoid(random, 1.0);
    const Sphere a{log_uniform(random, 1e-3, 10.0)};
    Vec3 y = log_uniform(random, 1e-3, 3.0) * scale(b.semi_axes, random_direction(random));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (random.below(6) == 0) y[axis] = 0.0;
      if (random.below(30) == 0) y[axis] *= 1e-15;
    }
    Vec3 r = -rotate(b.orientation, y);
    if (random.below(4) == 0) {
      const Vec3 d = random_direction(random);
      const double offset = a.radius + std::pow(10.0, random.uniform(-12.0, -2.0)) *
                                           (random.below(2) == 0 ? 1.0 : -1.0);
      r = -(support_point(b, d) + offset * d);
    }
    const Decision decision = decide(a, b, r);
    const Gap g = gap(a, b, r);
    loose += g.error > kGapRoundoff * std::max(a.radius, circum_radius(b));
    wrong += oracle::gap_along(a, b, r, g.normal) < g.value - g.error ||
             oracle::gap_along(a, b, r, g.normal) > g.value + g.error;
    for (int k = 0; k < 4; ++k) {
      wrong += oracle::gap_along(a, b, r, random_direction(random)) > g.value + g.error;
    }
    if (decision.verdict == Verdict::undecided) {
      undecided += std::abs(g.value) > 1e-11 * std::max(a.radius, circum_radius(b));
    } else {
      wrong += !oracle::certified(a, b, r, 0.0, decision);
    }
  }
  CHECK(wrong == 0);
  CHECK(undecided == 0);
  CHECK(loose == 0);
}

TEST_CASE("ball and ellipsoid: 10^5 verdicts and gaps are proven") { check_ball_pairs(9, 100'000); }

TEST_CASE("ball and ellipsoid: 10^7 verdicts and gaps are proven", "[validation]") {
  check_ball_pairs(validation_seed(10), 10'000'000);
}

TEST_CASE("ball and ellipsoid agree with two ellipsoids") {
  RandomStream random(11, StreamId::test);
  for (int i = 0; i < 500; ++i) {
    const EllipsoidPair p = random_pair(random);
    const double radius = log_uniform(random, 0.1, 2.0);
    const Gap closed = gap(Sphere{radius}, p.b, p.r);
    const Gap searched = gap(Ellipsoid{{radius, radius, radius}, {}}, p.b, p.r);
    CHECK(std::abs(closed.value - searched.value) <= closed.error + searched.error);
  }
}

TEST_CASE("a ball on the axes of an ellipsoid stands where school geometry puts it") {
  const Ellipsoid b{{3, 2, 1}, {}};
  CHECK(gap(Sphere{0.5}, b, {-4, 0, 0}).value == Approx(0.5).epsilon(1e-15));
  CHECK(gap(Sphere{0.5}, b, {0, 0, 5}).value == Approx(3.5).epsilon(1e-15));
  // Inside: the nearest surface is along the short axis.
  CHECK(gap(Sphere{0.5}, b, {0, 0, 0}).value == Approx(-1.5).epsilon(1e-15));
  // On the long axis beyond the center of curvature (3 - 1/3): the vertex is the nearest point.
  CHECK(gap(Sphere{0.1}, b, {-2.9, 0, 0}).value == Approx(-0.2).epsilon(1e-13));
}

}  // namespace
}  // namespace packstone
