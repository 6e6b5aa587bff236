#include "geometry/chord_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "support/oracle.hpp"
#include "support/pair_zoo.hpp"

using namespace packstone;
using zoo::Zoo;

namespace {

SymMat3 random_symmetric(Zoo& zoo) {
  const Vec3 values{zoo.uniform(-1, 1), zoo.uniform(-1, 1), zoo.uniform(-1, 1)};
  return rotated_diagonal(to_matrix(zoo.rotation()), values);
}

void check_least(const SphereQuadratic& f, Zoo& zoo) {
  const LeastOnSphere least = least_on_sphere(f);
  const double rounding = 1e-14 * (1.0 + norm(f.g));
  REQUIRE(norm(least.at) == Approx(1.0).epsilon(1e-14));
  REQUIRE(std::abs(f.at(least.at) - least.bound) <= rounding);
  for (int k = 0; k < 50; ++k) {
    const Vec3 d = zoo.direction(3);
    const double rise = 0.5 * least.stiffness * norm_sq(d - least.at);
    REQUIRE(f.at(d) >= least.bound + rise - rounding);
  }
}

Interval random_interval(const Interval& range, Zoo& zoo) {
  double low = zoo.uniform(range.low, range.high), high = zoo.uniform(range.low, range.high);
  if (low > high) std::swap(low, high);
  // Intervals at the ends and narrow ones, where the minorants are of another kind.
  if (zoo.uniform(0, 1) < 0.4) low = range.low;
  if (zoo.uniform(0, 1) < 0.4) high = range.high;
  if (zoo.uniform(0, 1) < 0.3) high = low + zoo.log_uniform(1e-6, 1e-2) * (range.high - low);
  return {low, high};
}

// Is the minorant below S wherever the parameter lies in the interval, for whatever it is fitted
// to?
template <class Chords>
void check_minorants(const Chords& chords, const Body& body, Zoo& zoo) {
  const Interval i = random_interval(chords.range(), zoo);
  const double size = circum_radius(body);
  const double part = zoo.uniform(0, 1) < 0.3 ? 10.0 : 0.3;
  const Fit fit{{(part * size) * random_symmetric(zoo), (part * size) * zoo.direction(3), 0.0},
                zoo.direction(3),
                size * std::round(zoo.uniform(-2, 2))};
  const SphereQuadratic m = chords.minorant(i, fit);
  for (int k = 0; k < 200; ++k) {
    // Towards the kinks too, which random directions all but never meet.
    Vec3 d = zoo.direction(3);
    if constexpr (std::is_base_of_v<RodChords, Chords>) {
      const double angle = zoo.uniform(i.low, i.high);
      const Vec3 across = normalized(part_across(chords.axis(), d));
      const double sign = k % 2 == 0 ? 1.0 : -1.0;
      d = sign * std::sin(angle) * chords.axis() + std::cos(angle) * across;
    }
    const double p = chords.parameter(d);
    if (p < i.low || p > i.high) continue;
    REQUIRE(m.at(d) <= static_cast<double>(oracle::support(body, d)) + 1e-13 * part * size);
  }
}

}  // namespace

TEST_CASE("the least value of a quadratic function on the sphere is bounded and attained") {
  Zoo zoo(1);
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    const SymMat3 q = random_symmetric(zoo);
    check_least({q, zoo.log_uniform(1e-12, 10) * zoo.direction(3), 0.0}, zoo);
    // No linear part, two equal eigenvalues, and a linear part across the least ones.
    check_least({q, {}, 0.5}, zoo);
    const Vec3 u = zoo.direction(3);
    check_least({dyad(u), zoo.log_uniform(1e-12, 10) * u, 0.0}, zoo);
    check_least({-1.0 * dyad(u), zoo.uniform(0, 2) * any_perpendicular(u), 0.0}, zoo);
  }
}

TEST_CASE("quadratic minorants lie below the support functions on their intervals") {
  Zoo zoo(2);
  for (int k = 0; k < 3000; ++k) {
    CAPTURE(k);
    const Body ellipsoid = zoo.body(ShapeKind::ellipsoid, 1.0);
    check_minorants(SupportChords<Ellipsoid>(std::get<Ellipsoid>(ellipsoid)), ellipsoid, zoo);
    const Body cylinder = zoo.body(ShapeKind::cylinder, 1.0);
    check_minorants(SupportChords<Cylinder>(std::get<Cylinder>(cylinder)), cylinder, zoo);
  }
}

TEST_CASE("planes under the side lines of parallel rods lie below both of them together") {
  Zoo zoo(3);
  for (int k = 0; k < 3000; ++k) {
    CAPTURE(k);
    const double tilt = zoo.log_uniform(1e-12, 1e-2);
    const Vec3 u = zoo.direction(3);
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    const Vec3 v = sign * normalized(u + tilt * any_perpendicular(u));
    const Cylinder a{1.0, zoo.log_uniform(0.1, 10), u}, b{1.0, zoo.log_uniform(0.1, 10), v};
    const SupportChords<Cylinder> chords_a(a), chords_b(b);
    const double reach = a.half_length + b.half_length;
    const Vec3 r = zoo.uniform(-1, 1) * reach * u + zoo.log_uniform(1e-12, 1) * zoo.direction(3);
    const ParallelSides sides(chords_a, chords_b, r);
    const Interval i{0.0, zoo.log_uniform(1e-6, 0.1)};
    const SphereQuadratic sum = chords_a.minorant(i, {{}, u, 0.0, &sides.together[0]}) +
                                chords_b.minorant(i, {{}, u, 0.0, &sides.together[1]});
    for (int n = 0; n < 100; ++n) {
      const double angle = zoo.uniform(-i.high, i.high) * (n % 2 == 0 ? 1.0 : 1e-6);
      const Vec3 across = normalized(part_across(u, zoo.direction(3)));
      const Vec3 d = std::sin(angle) * u + std::cos(angle) * across;
      if (chords_b.parameter(d) > i.high) continue;
      REQUIRE(sum.at(d) <= chords_a.support(d) + chords_b.support(d) + 1e-14 * (2 + reach));
    }
  }
}

TEST_CASE("the gap is proven to 1e-12 where a curve of directions all but ties") {
  Zoo zoo(4);
  const auto check = [](const Body& a, const Body& b, const Vec3& r) {
    const Gap g = gap(a, b, r);
    REQUIRE(g.error <= kGapRoundoff * std::max(circum_radius(a), circum_radius(b)));
    const auto found = oracle::search_gap(a, b, r, 4, 1, &g.normal);
    REQUIRE(static_cast<double>(found - g.value) <= g.error);
  };
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    const double uneven = k % 4 == 0 ? 0.0 : zoo.log_uniform(1e-12, 0.1);
    const Quaternion q = zoo.rotation();
    const Vec3 axis = to_matrix(q).col_z;
    const double shift = k % 3 == 0 ? 0.0 : zoo.log_uniform(1e-9, 1.0);
    const Vec3 r = shift * (axis + uneven * zoo.direction(3));
    const Ellipsoid round{{1, 1 + uneven, zoo.log_uniform(0.1, 10)}, q};
    const Ellipsoid long_one{{0.8, 0.8, zoo.log_uniform(1, 30)}, q};
    const double length = zoo.log_uniform(0.1, 10);
    check(round, long_one, r);
    check(round, Cylinder{0.9, length, axis}, r);
    check(round, Spherocylinder{0.9, length, axis}, r);
    const Vec3 nearly = normalized(axis + 1e-6 * uneven * zoo.direction(3));
    check(Cylinder{0.9, length, axis}, Cylinder{1.1, 2.0, nearly}, r);
    check(Cylinder{0.9, length, axis}, Spherocylinder{1.1, 2.0, nearly}, r);
  }
}
