#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "packstone/core/random.hpp"

namespace packstone {
namespace {

TEST_CASE("a stream depends on seed, name, item and trial, and on nothing else") {
  const auto first = [](std::uint64_t seed, StreamId id, std::uint64_t item, std::uint64_t trial) {
    return RandomStream(seed, id, item, trial).bits();
  };
  const std::uint64_t reference = first(1, StreamId::sizes, 2, 3);
  CHECK(first(1, StreamId::sizes, 2, 3) == reference);
  CHECK(first(2, StreamId::sizes, 2, 3) != reference);
  CHECK(first(1, StreamId::aspects, 2, 3) != reference);
  CHECK(first(1, StreamId::sizes, 3, 3) != reference);
  CHECK(first(1, StreamId::sizes, 2, 4) != reference);
}

TEST_CASE("uniform numbers have the moments of the uniform law") {
  RandomStream random(7, StreamId::test);
  const int n = 200'000;
  double sum = 0, square = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    REQUIRE((u >= 0.0 && u < 1.0));
    sum += u;
    square += u * u;
  }
  // Five standard errors.
  CHECK(std::abs(sum / n - 0.5) < 5 * std::sqrt(1.0 / 12 / n));
  CHECK(std::abs(square / n - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / n));
}

TEST_CASE("the normal quantile inverts the distribution function") {
  for (double p : {1e-300, 1e-20, 1e-9, 0.02, 0.1, 0.3, 0.5}) {
    const double x = normal_quantile(p);
    CHECK(0.5 * std::erfc(-x / std::sqrt(2.0)) == Approx(p).epsilon(1e-13));
    if (p > 1e-9) CHECK(normal_quantile(1.0 - p) == Approx(-x).epsilon(1e-6).margin(1e-12));
  }
}

TEST_CASE("random directions and rotations show no preferred axis") {
  RandomStream random(11, StreamId::test);
  const int n = 100'000;
  Vec3 mean, mean_rotated;
  double zz = 0, zz_rotated = 0;
  for (int i = 0; i < n; ++i) {
    const Vec3 u = random_direction(random);
    const Vec3 v = rotate(random_rotation(random), {0, 0, 1});
    mean += u / n;
    mean_rotated += v / n;
    zz += u.z * u.z / n;
    zz_rotated += v.z * v.z / n;
  }
  const double five_sigma = 5 * std::sqrt(1.0 / 3 / n);
  CHECK(norm(mean) < 2 * five_sigma);
  CHECK(norm(mean_rotated) < 2 * five_sigma);
  CHECK(std::abs(zz - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / n));
  CHECK(std::abs(zz_rotated - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / n));
}

TEST_CASE("below(n) reaches every integer under n and none else") {
  RandomStream random(13, StreamId::test);
  std::vector<int> hits(7);
  for (int i = 0; i < 70'000; ++i) ++hits.at(random.below(7));
  for (int h : hits) CHECK(std::abs(h - 10'000) < 500);
}

}  // namespace
}  // namespace packstone
