#include "packstone/geometry/clipped_volume.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "support/oracle.hpp"
#include "support/random_body.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Vec3 kEverywhere{kInfinity, kInfinity, kInfinity};

// Lengths over a factor of 30.
Body some_body(int dimension, RandomStream& random) {
  return test::random_body(test::random_shape(dimension, random), random,
                           [&] { return std::exp(random.uniform(-1.7, 1.7)); });
}

Vec3 point_between(const Vec3& lo, const Vec3& hi, RandomStream& random) {
  return {random.uniform(lo.x, hi.x), random.uniform(lo.y, hi.y), random.uniform(lo.z, hi.z)};
}

struct Box {
  Vec3 lo, hi;
};

// Some sides cut the body, some do not.
Box some_box(const Body& body, RandomStream& random) {
  const Vec3 half = half_extents(body);
  Box box;
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = random.uniform(-1.3, 1.3) * half[a], y = random.uniform(-1.3, 1.3) * half[a];
    box.lo[a] = std::min(x, y);
    box.hi[a] = std::max(x, y);
    if (random.below(6) == 0) box.lo[a] = -kInfinity;
    if (random.below(6) == 0) box.hi[a] = kInfinity;
  }
  return box;
}

// Share of random points of the box about the body that are in both.
double sampled_volume(const Body& body, const Box& box, int points, RandomStream& random) {
  const Vec3 half = half_extents(body);
  const std::size_t axes = dimension(kind(body)) == 2 ? 2 : 3;
  double room = 1.0;
  for (std::size_t a = 0; a < axes; ++a) room *= 2.0 * half[a];
  int inside = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3 x = point_between(-half, half, random);
    bool in_box = true;
    for (std::size_t a = 0; a < axes; ++a)
      in_box = in_box && x[a] >= box.lo[a] && x[a] <= box.hi[a];
    inside += in_box && oracle::gauge(body, x) <= 1.0 ? 1 : 0;
  }
  return room * inside / points;
}

TEST_CASE("parts of simple bodies below planes are those computed by hand") {
  CHECK(volume_below(Sphere{2.0}, 2, 0.0) == Approx(16.0 / 3.0 * pi).epsilon(1e-15));
  // A cap of height 1/2 of the unit ball: pi h^2 (3 - h) / 3.
  CHECK(volume_below(Sphere{1.0}, 0, -0.5) == Approx(pi * 0.25 * 2.5 / 3.0).epsilon(1e-14));
  CHECK(volume_below(Disk{1.0}, 1, 0.5) ==
        Approx(pi - (pi / 3.0 - std::sqrt(3.0) / 4.0)).epsilon(1e-14));
  const Cylinder upright{1.0, 2.0, {0, 0, 1}};
  CHECK(volume_below(upright, 2, 0.5) == Approx(2.5 * pi).epsilon(1e-14));
  CHECK(volume_below(upright, 0, 0.5) ==
        Approx(4.0 * (pi - (pi / 3.0 - std::sqrt(3.0) / 4.0))).epsilon(1e-13));
  const Spherocylinder capsule{1.0, 2.0, {0, 0, -1}};
  CHECK(volume_below(capsule, 2, -2.0) == Approx(2.0 / 3.0 * pi).epsilon(1e-14));
  CHECK(volume_below(capsule, 2, 2.5) ==
        Approx(volume(Body{capsule}) - pi * 0.25 * 2.5 / 3.0).epsilon(1e-14));
  CHECK(volume_below(capsule, 1, 0.0) == Approx(0.5 * volume(Body{capsule})).epsilon(1e-14));
}

TEST_CASE("parts of simple bodies in boxes are those computed by hand") {
  const Vec3 origin;
  CHECK(volume_in_box(Sphere{1.0}, origin, kEverywhere) == Approx(pi / 6.0).epsilon(1e-12));
  CHECK(volume_in_box(Disk{1.0}, origin, kEverywhere) == Approx(pi / 4.0).epsilon(1e-14));
  CHECK(volume_in_box(Ellipse{{3.0, 1.0}, 0.0}, origin, {kInfinity, 0.0, 0.0}) == 0.0);
  // A cube inside a ball; a square inside a disk.
  CHECK(volume_in_box(Sphere{1.0}, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}) ==
        Approx(1.0).epsilon(1e-13));
  CHECK(volume_in_box(Disk{1.0}, {-0.5, -0.5, 0}, {0.5, 0.5, 0}) == Approx(1.0).epsilon(1e-14));
  const Cylinder lying{1.0, 2.0, {1, 0, 0}};
  CHECK(volume_in_box(lying, origin, kEverywhere) == Approx(pi / 2.0).epsilon(1e-12));
  const Spherocylinder capsule{1.0, 2.0, {0, 1, 0}};
  CHECK(volume_in_box(capsule, origin, kEverywhere) ==
        Approx(volume(Body{capsule}) / 8.0).epsilon(1e-12));
  CHECK(volume_in_box(Sphere{1.0}, {2, 2, 2}, {3, 3, 3}) == 0.0);
  CHECK(volume_in_box(Sphere{1.0}, {0, 0, 0.1}, {1, 1, 0.1}) == 0.0);
  CHECK(volume_in_box(lying, -kEverywhere, kEverywhere) == volume(Body{lying}));
}

TEST_CASE("volume_in_box against random points") {
  RandomStream random(1, StreamId::test);
  constexpr int kPoints = 20000;
  for (int dimension : {2, 3}) {
    for (int trial = 0; trial < 150; ++trial) {
      const Body body = some_body(dimension, random);
      const Box box = some_box(body, random);
      const Vec3 half = half_extents(body);
      const double room = dimension == 2 ? 4 * half.x * half.y : 8 * half.x * half.y * half.z;
      CAPTURE(dimension, trial, name(kind(body)));
      // Half the room has the largest variance; five deviations.
      CHECK(volume_in_box(body, box.lo, box.hi) ==
            Approx(sampled_volume(body, box, kPoints, random))
                .margin(5.0 * 0.5 * room / std::sqrt(kPoints)));
    }
  }
}

// Boxes that fill the part below a plane hold what volume_below(), which shares nothing with their
// integrals, says.
double worst_of_parts(int dimension, int trials, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  double worst = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const Body body = some_body(dimension, random);
    const Vec3 half = half_extents(body);
    const auto axis = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(dimension)));
    const std::size_t other = (axis + 1) % static_cast<std::size_t>(dimension);
    Vec3 left = kEverywhere, right = -kEverywhere;
    left[axis] = random.uniform(-1, 1) * half[axis];
    left[other] = right[other] = random.uniform(-1, 1) * half[other];
    Vec3 end = kEverywhere;
    end[axis] = left[axis];
    const double parts = volume_in_box(body, -kEverywhere, left) + volume_in_box(body, right, end);
    worst = std::max(worst, std::abs(parts - volume_below(body, axis, left[axis])) / volume(body));
  }
  return worst;
}

TEST_CASE("volume_in_box: parts add up to volume_below") {
  CHECK(worst_of_parts(2, 10000, 2) < 0.1 * kClippedAreaError);
  CHECK(worst_of_parts(3, 10000, 3) < 0.5 * kVolumeInBoxError);
}

TEST_CASE("volume_in_box: corners of a body add up to its volume") {
  RandomStream random(4, StreamId::test);
  double worst = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Body body = some_body(3, random);
    const Vec3 half = half_extents(body);
    const Vec3 corner = point_between(-half, half, random);
    double sum = 0.0;
    for (int octant = 0; octant < 8; ++octant) {
      Vec3 lo = -kEverywhere, hi = kEverywhere;
      for (std::size_t a = 0; a < 3; ++a) ((octant >> a) & 1 ? lo : hi)[a] = corner[a];
      sum += volume_in_box(body, lo, hi);
    }
    worst = std::max(worst, std::abs(sum - volume(body)) / volume(body));
  }
  CHECK(worst < 0.5 * kVolumeInBoxError);
}

TEST_CASE("volume_below: rising, and of opposite heights adding up to the volume") {
  RandomStream random(5, StreamId::test);
  for (int trial = 0; trial < 5000; ++trial) {
    const int dimension = trial % 2 == 0 ? 3 : 2;
    const Body body = some_body(dimension, random);
    const std::size_t axis = random.below(static_cast<std::uint64_t>(dimension));
    const double reach = half_extents(body)[axis], whole = volume(body);
    const double x = random.uniform(-1.1, 1.1) * reach, y = random.uniform(-1.1, 1.1) * reach;
    CAPTURE(trial, name(kind(body)), axis, x / reach);
    CHECK(std::abs(volume_below(body, axis, x) + volume_below(body, axis, -x) - whole) <
          1e-12 * whole);
    CHECK(volume_below(body, axis, std::min(x, y)) <=
          volume_below(body, axis, std::max(x, y)) + 1e-12 * whole);
    CHECK(volume_below(body, axis, reach) == whole);
    CHECK(volume_below(body, axis, -reach) == 0.0);
    CHECK(volume_below(body, axis, kInfinity) == whole);
  }
}

TEST_CASE("volume_below of rods that lie all but flat or stand all but upright") {
  for (const double tilt : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const Vec3 flat = normalized(Vec3{1.0, 0.3, tilt}),
               upright = normalized(Vec3{tilt, 0.2 * tilt, 1.0});
    for (const Vec3& u : {flat, upright}) {
      for (const Body& body : {Body{Cylinder{1.0, 5.0, u}}, Body{Spherocylinder{1.0, 5.0, u}}}) {
        for (const double height : {-0.999, -0.9, -0.3, 0.0, 0.5, 0.99}) {
          // Two halves beside each other, sliced.
          const Vec3 end{0.1, kInfinity, height};
          const double left = volume_in_box(body, -kEverywhere, end);
          const double right =
              volume_in_box(body, {0.1, -kInfinity, -kInfinity}, {kInfinity, kInfinity, height});
          CAPTURE(tilt, u.z, height, name(kind(body)));
          CHECK(std::abs(volume_below(body, 2, height) - left - right) < 1e-10 * volume(body));
        }
      }
    }
  }
}

TEST_CASE("validation: parts of bodies of aspects up to 100 add up", "[validation]") {
  RandomStream random(6, StreamId::test);
  double worst = 0.0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Body body = test::random_body(test::random_shape(3, random), random,
                                        [&] { return std::pow(10.0, random.uniform(-1, 1)); });
    const Box box = some_box(body, random);
    const std::size_t axis = random.below(3);
    const double cut = random.uniform(-1, 1) * half_extents(body)[axis];
    if (cut <= box.lo[axis] || cut >= box.hi[axis]) continue;
    Vec3 hi = box.hi, lo = box.lo;
    hi[axis] = lo[axis] = cut;
    const double parts = volume_in_box(body, box.lo, hi) + volume_in_box(body, lo, box.hi);
    worst = std::max(worst, std::abs(parts - volume_in_box(body, box.lo, box.hi)) / volume(body));
  }
  CAPTURE(worst);
  CHECK(worst < 0.5 * kVolumeInBoxError);
}

}  // namespace
}  // namespace packstone
