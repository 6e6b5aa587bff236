#include "geometry/local_gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "support/each_pair.hpp"
#include "support/posed_pair.hpp"

namespace packstone {
namespace {

constexpr double kAnyGap = 1e300;

LocalGap found_for(const zoo::PosedPair& p, const Vec3& r, Vec3 hint = {}) {
  LocalGap found;
  REQUIRE(local_gap(p.a, p.b, r, kAnyGap, hint, found));
  REQUIRE(hint == found.normal);
  return found;
}

}  // namespace

TEST_CASE("a local gap is the gap of bodies that are apart, and never above that of any") {
  int apart = 0, short_of = 0, deeper = 0, overlapping = 0;
  zoo::for_each_pair(41, 60, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    const Gap truth = gap(pair.a, pair.b, pair.r);
    const double size = zoo::size_of(pair);
    const LocalGap found = found_for(zoo::posed_pair(pair), pair.r);
    REQUIRE(found.value <= truth.value + truth.error + 1e-12 * size);
    if (truth.value > 0.0) {
      ++apart;
      short_of += found.value < truth.value - 1e-9 * size;
      return;
    }
    ++overlapping;
    deeper += found.value < truth.value - 1e-6 * size;
  });
  CHECK(apart > 1000);
  CHECK(short_of < apart / 50);
  CHECK(overlapping > 1000);
  // Other maxima than the greatest, or an ascent without an end.
  CHECK(deeper < overlapping / 3);
}

TEST_CASE("points of a local gap lie on both bodies, as far apart as its value") {
  zoo::for_each_pair(42, 40, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    const zoo::PosedPair p = zoo::posed_pair(pair);
    const LocalGap found = found_for(p, pair.r);
    const double size = zoo::size_of(pair);
    REQUIRE(std::abs(norm(found.normal) - 1.0) < 1e-14);
    REQUIRE(std::abs(dot(found.normal, found.point_a) - support(p.a, found.normal)) <=
            1e-12 * size);
    REQUIRE(std::abs(dot(found.normal, found.point_b) + support(p.b, found.normal)) <=
            1e-12 * size);
    const double across = dot(found.normal, pair.r + found.point_b - found.point_a);
    // Of rods whose axes meet, the direction between their nearest points is any.
    REQUIRE(std::abs(across - found.value) <= 2e-9 * size);
  });
}

TEST_CASE("the local gap of rods whose middles cross is the gap, whatever the hint") {
  zoo::Zoo zoo(45);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 u = zoo.direction(3), v = zoo.direction(3), across = zoo.direction(3);
    const double depth = zoo.log_uniform(1e-6, 0.2);
    const Vec3 n = cross(u, v);
    if (norm(n) < 0.3) continue;
    const PosedBody a = posed_body(Cylinder{0.1, 1.0, u}), b = posed_body(Cylinder{0.1, 1.0, v});
    const Vec3 r =
        (0.2 - 0.2 * depth) / norm(n) * n + 0.5 * dot(across, u) * u + 0.5 * dot(across, v) * v;
    Vec3 hint = k % 2 == 0 ? Vec3{} : zoo.direction(3);
    LocalGap found;
    REQUIRE(local_gap(a, b, r, kAnyGap, hint, found));
    const Gap truth = gap(Cylinder{0.1, 1.0, u}, Cylinder{0.1, 1.0, v}, r);
    REQUIRE(std::abs(found.value - truth.value) < 1e-12);
    REQUIRE(hint == found.normal);
  }
}

TEST_CASE("a local gap that is not below the limit is told so, from whatever hint") {
  zoo::for_each_pair(43, 40, [&](const zoo::Pair& pair, zoo::PairClass, int k) {
    const zoo::PosedPair p = zoo::posed_pair(pair);
    const double value = found_for(p, pair.r).value;
    const double size = zoo::size_of(pair);
    Vec3 hint = k % 2 == 0 ? Vec3{} : found_for(p, pair.r).normal;
    LocalGap found;
    REQUIRE_FALSE(local_gap(p.a, p.b, pair.r, value - 1e-6 * size, hint, found));
  });
}

TEST_CASE("a local gap changes as its normal and points say when a body moves or turns") {
  zoo::Zoo zoo(44);
  int off = 0, tried = 0;
  zoo::for_each_pair(44, 200, [&](const zoo::Pair& pair, zoo::PairClass where, int) {
    // In the others the gap has an edge, or nearly: several directions are as good.
    if (where != zoo::PairClass::generic && where != zoo::PairClass::near) return;
    zoo::PosedPair p = zoo::posed_pair(pair);
    const double size = zoo::size_of(pair);
    const LocalGap here = found_for(p, pair.r);
    const Vec3 step = 1e-6 * size * zoo.direction(dimension(kind(pair.a)));
    const LocalGap there = found_for(p, pair.r + step, here.normal);
    ++tried;
    off += std::abs(there.value - here.value - dot(here.normal, step)) > 1e-2 * norm(step);
  });
  CHECK(tried > 1000);
  CHECK(off < tried / 50);
}

}  // namespace packstone
