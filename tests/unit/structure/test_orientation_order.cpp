#include "packstone/structure/orientation_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "packstone/core/error.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/orientation_law.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

TEST_CASE("the order of known tensors") {
  const auto order = [](const SymMat3& t) { return orientation_order(t, 3); };
  const double third = 1.0 / 3;
  CHECK(order({third, third, third, 0, 0, 0}).nematic == Approx(0.0).margin(1e-15));
  CHECK(order({third, third, third, 0, 0, 0}).rho == Approx(1.0));
  CHECK(order({0, 1, 0, 0, 0, 0}).nematic == 1.0);
  CHECK(std::isinf(order({0, 1, 0, 0, 0, 0}).rho));
  CHECK(order({0.5, 0, 0.5, 0, 0, 0}).nematic == 0.25);
  CHECK(std::isinf(order({0.5, 0, 0.5, 0, 0, 0}).rho));

  const Mat3 turn = to_matrix(normalized(Quaternion{0.3, -0.5, 0.1, 0.8}));
  const OrientationOrder turned = order(rotated_diagonal(turn, {0.2, 0.7, 0.1}));
  CHECK(turned.eigenvalues.x == Approx(0.7).epsilon(1e-14));
  CHECK(turned.eigenvalues.y == Approx(0.2).epsilon(1e-14));
  CHECK(turned.eigenvalues.z == Approx(0.1).epsilon(1e-14));
  CHECK(turned.nematic == Approx(0.55).epsilon(1e-14));
  CHECK(turned.rho == Approx(7.0).epsilon(1e-13));
}

TEST_CASE("the order in the plane leaves out the third axis") {
  const OrientationOrder even = orientation_order({0.5, 0.5, 0, 0, 0, 0}, 2);
  CHECK(even.nematic == 0.0);
  CHECK(even.rho == 1.0);
  CHECK(even.eigenvalues == Vec3{0.5, 0.5, 0});
  // Axes at +-20 degrees about one at 35 degrees: S is the length of the mean of exp(2 i angle).
  std::vector<Vec3> axes;
  for (const double degrees : {15.0, 55.0}) {
    axes.push_back({std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0});
  }
  const OrientationOrder fan = orientation_order(orientation_tensor(axes), 2);
  const double s = std::cos(40 * pi / 180);
  CHECK(fan.nematic == Approx(s).epsilon(1e-14));
  CHECK(fan.rho == Approx((1 + s) / (1 - s)).epsilon(1e-13));
}

TEST_CASE("one or two axes have an infinite rho, whatever rounding says") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> axes;
    for (int i = 0; i < 2; ++i) {
      axes.push_back(normalized(Vec3{normal(random), normal(random), normal(random)}));
      CHECK(std::isinf(orientation_order(orientation_tensor(axes), 3).rho));
    }
  }
}

TEST_CASE("the symmetry axes of a group; none of round ones") {
  Packing packing;
  packing.groups = {"rods", "balls", "none"};
  packing.inclusions = {{{}, Cylinder{0.1, 0.2, {1, 0, 0}}, 0},
                        {{}, Sphere{0.1}, 1},
                        {{}, Cylinder{0.1, 0.2, {0, 1, 0}}, 0}};
  CHECK(symmetry_axes(packing, 0) == std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}});
  CHECK(symmetry_axes(packing, 1).empty());
  CHECK(symmetry_axes(packing, 2).empty());
}

TEST_CASE("random axes without a mean of rho, and the limit of many, are what theory says") {
  const double none = std::numeric_limits<double>::infinity();
  for (const int dimension : {2, 3}) {
    for (int count = 1; count <= 30; ++count) {
      const RandomOrder order = random_order(count, dimension);
      // Nearly coplanar samples: rho > x with probability x^-(N-2)/2, in the plane x^-(N-1)/2.
      const double exponent = 0.5 * (count - dimension + 1);
      CHECK((order.rho.mean == none) == (exponent <= 1));
      CHECK((order.rho.standard_deviation == none) == (exponent <= 2));
      CHECK((order.rho.low == none) == (exponent <= 0));
      CHECK((order.rho.high == none) == (exponent <= 0));
    }
  }
  CHECK(random_order(1, 3).nematic == RandomValue{1, 0, 1, 1});
  CHECK(random_order(1, 2).nematic == RandomValue{1, 0, 1, 1});
  // Two axes at an angle of cosine c, uniform in space: S = (1 + 3 c) / 4.
  CHECK(random_order(2, 3).nematic.mean == Approx(5.0 / 8).epsilon(1e-4));
  CHECK(random_order(2, 3).nematic.low == Approx((1 + 3 * 0.025) / 4).epsilon(1e-4));
  CHECK(random_order(2, 2).nematic.mean == Approx(2 / pi).epsilon(1e-4));

  const double many = 1e14, root = 1e7;
  const RandomOrder space = random_order(static_cast<std::int64_t>(many), 3);
  CHECK(root * space.nematic.mean == Approx(2.25 * std::sqrt(2 / (5 * pi))).epsilon(1e-4));
  CHECK(root * (space.rho.mean - 1) == Approx(9 * std::sqrt(2 / (5 * pi))).epsilon(1e-4));
  const RandomOrder plane = random_order(static_cast<std::int64_t>(many), 2);
  CHECK(root * plane.nematic.mean == Approx(std::sqrt(pi) / 2).epsilon(1e-4));
  CHECK(root * plane.nematic.high == Approx(std::sqrt(std::log(40.0))).epsilon(1e-4));

  CHECK_THROWS_AS(random_order(0, 3), InvalidArgument);
  CHECK_THROWS_AS(random_order(5, 4), InvalidArgument);
}

TEST_CASE("expected order falls with the number of axes, without steps between rows") {
  for (const int dimension : {2, 3}) {
    const auto scaled = [&](double count) {
      const RandomOrder order = random_order(static_cast<std::int64_t>(count), dimension);
      return std::sqrt(count) * (order.rho.mean - 1);
    };
    for (double count = 8; count < 1e7; count = std::ceil(1.1 * count)) {
      const double here = scaled(count), next = scaled(std::ceil(1.1 * count));
      CHECK(next < here);
      CHECK(next > 0.85 * here);
    }
  }
}

// --- Against samples of our own ------------------------------------------------------------------

Vec3 random_axis(std::mt19937_64& random, int dimension) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), dimension == 3 ? normal(random) : 0.0});
}

// Beyond `cut` rho falls like a power, by which the mean is completed: see the test above.
RandomValue summary(std::vector<double> values, double cut, double exponent) {
  RandomValue result;
  double sum = 0.0, squares = 0.0, beyond = 0.0;
  for (const double value : values) {
    const double kept = std::min(value, cut);
    sum += kept;
    squares += kept * kept;
    beyond += value > cut ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(values.size());
  result.mean = (sum + beyond * cut / (exponent - 1)) / count;
  const double second = (squares + beyond * 2 * cut * cut / (exponent - 2)) / count;
  result.standard_deviation = std::sqrt(second - result.mean * result.mean);
  std::sort(values.begin(), values.end());
  result.low = values[values.size() / 40];
  result.high = values[values.size() - 1 - values.size() / 40];
  return result;
}

// Largest deviations from the table in units of the values [-].
struct Deviation {
  double mean, spread, interval;
};
Deviation worst(const RandomValue& a, const RandomValue& b, double origin) {
  const auto off = [](double x, double y) {
    return std::isinf(x) || std::isinf(y) ? 0.0 : std::abs(x / y - 1);
  };
  return {off(a.mean - origin, b.mean - origin), off(a.standard_deviation, b.standard_deviation),
          std::max(off(a.low - origin, b.low - origin), off(a.high - origin, b.high - origin))};
}

struct Deviations {
  Deviation nematic, rho;
};
Deviations deviations(int count, int dimension, int samples) {
  std::mt19937_64 random(static_cast<std::uint64_t>(1000 * dimension + count));
  std::vector<double> nematic, rho;
  std::vector<Vec3> axes(static_cast<std::size_t>(count));
  for (int i = 0; i < samples; ++i) {
    for (Vec3& axis : axes) axis = random_axis(random, dimension);
    const OrientationOrder order = orientation_order(orientation_tensor(axes), dimension);
    nematic.push_back(order.nematic);
    rho.push_back(order.rho);
  }
  const RandomOrder expected = random_order(count, dimension);
  const double exponent = 0.5 * (count - dimension + 1);
  return {worst(summary(nematic, 2.0, 9.0), expected.nematic, 0.0),
          worst(summary(rho, 300.0, exponent), expected.rho, 1.0)};
}

TEST_CASE("random axes show the order that is expected of them") {
  // 40 000 samples leave 0.2 % on the mean of S and 0.4 % on that of rho - 1 where its second
  // moment is finite, 1 % on deviations and 2 % on the ends of intervals; twice that here, and more
  // for rho of few axes, whose largest values dominate.
  for (const int dimension : {2, 3}) {
    for (const int count : {3, 5, 8, 11, 23}) {
      CAPTURE(dimension, count);
      const Deviations off = deviations(count, dimension, 40'000);
      CHECK(off.nematic.mean < 0.005);
      CHECK(off.nematic.spread < 0.02);
      CHECK(off.nematic.interval < 0.04);
      CHECK(off.rho.mean < (count < 8 ? 0.05 : 0.015));
      CHECK(off.rho.spread < (count < 11 ? 0.3 : 0.05));
      CHECK(off.rho.interval < (count < 5 ? 0.2 : 0.06));
    }
  }
}

TEST_CASE("a large number of random axes shows the expected order to the accuracy promised",
          "[validation]") {
  for (const int dimension : {2, 3}) {
    for (const int count : {3, 4, 5, 6, 7, 9, 11, 13, 15, 18, 23, 30, 45, 90, 250, 1000}) {
      CAPTURE(dimension, count);
      const int samples = count <= 30 ? 500'000 : 15'000'000 / count;
      // Four standard errors of these samples, beside the accuracy promised.
      const double noise = 4 / std::sqrt(samples);
      const Deviations off = deviations(count, dimension, samples);
      CHECK(off.nematic.mean < 0.003 + 0.6 * noise);
      CHECK(off.nematic.spread < 0.003 + noise);
      CHECK(off.nematic.interval < 0.003 + 4 * noise);
      CHECK(off.rho.mean < 0.003 + (count < 8 ? 4 : 1) * noise);
      if (count > 10) CHECK(off.rho.spread < 0.003 + 4 * noise);
      CHECK(off.rho.interval < (count < 5 ? 0.03 : 0.003 + 6 * noise));
    }
  }
}

}  // namespace
}  // namespace packstone
