#include "packstone/geometry/box_contact.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"
#include "support/oracle.hpp"
#include "support/random_body.hpp"

namespace packstone {
namespace {

constexpr ShapeKind kShapes[] = {ShapeKind::sphere,   ShapeKind::ellipsoid,
                                 ShapeKind::cylinder, ShapeKind::spherocylinder,
                                 ShapeKind::disk,     ShapeKind::ellipse};

// g(d) of equation (1) in long double, by support functions of its own.
long double gap_along(const Body& body, const Vec3& half, const Vec3& r, const Vec3& d) {
  long double g = -oracle::support(body, d);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    g += static_cast<long double>(d[axis]) * r[axis] - std::abs(d[axis]) * half[axis];
  }
  return g;
}

// The least gauge of the body over the box: at most 1 exactly where they meet. The gauge is convex,
// and so is its minimum over some coordinates: golden sections within golden sections.
double least_gauge(const Body& body, const Vec3& half, const Vec3& r, Vec3 x = {},
                   std::size_t axis = 0) {
  if (axis == 3) return static_cast<double>(oracle::gauge(body, x));
  const auto value = [&](double t) {
    x[axis] = t;
    return least_gauge(body, half, r, x, axis + 1);
  };
  double low = r[axis] - half[axis], high = r[axis] + half[axis];
  if (half[axis] == 0.0) return value(r[axis]);
  constexpr double kGolden = 0.6180339887498949;
  double t[2] = {high - kGolden * (high - low), low + kGolden * (high - low)};
  double at[2] = {value(t[0]), value(t[1])};
  double best = std::min({at[0], at[1], value(low), value(high)});
  for (int step = 0; step < 34; ++step) {
    const int worse = at[0] > at[1] ? 0 : 1;
    (worse == 0 ? low : high) = t[worse];
    t[worse] = t[1 - worse];
    at[worse] = at[1 - worse];
    t[1 - worse] = worse == 0 ? low + kGolden * (high - low) : high - kGolden * (high - low);
    at[1 - worse] = value(t[1 - worse]);
    best = std::min(best, at[1 - worse]);
  }
  return best;
}

// A box beside a body: thick, or without thickness along one axis.
struct Scene {
  Body body;
  Vec3 half;
  Vec3 r;
};
Scene random_scene(ShapeKind shape, bool flat, RandomStream& random) {
  Scene scene;
  scene.body = test::random_body(shape, random, [&] { return random.uniform(0.05, 1.0); });
  scene.half = {random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
  if (flat) scene.half[random.below(dimension(shape) == 2 ? 2 : 3)] = 0.0;
  scene.r = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
  if (dimension(shape) == 2) scene.half.z = scene.r.z = 0.0;
  return scene;
}

TEST_CASE("a body just too small to reach a box is proven apart, a little larger it is not") {
  // Golden sections find the least gauge to their last step, 1e-7 of a half edge, or better; the
  // gauge changes by 1 / 0.05 per length at most.
  const double margin = 4e-6;
  RandomStream random(1, StreamId::test);
  for (const ShapeKind shape : kShapes) {
    for (int trial = 0; trial < 24; ++trial) {
      // Boxes with three edges cost 40 times as much as rectangles.
      const bool flat = dimension(shape) == 2 || trial % 6 > 0;
      const Scene scene = random_scene(shape, flat, random);
      const double gauge = least_gauge(scene.body, scene.half, scene.r);
      if (gauge < 1e-3) continue;  // The box holds the center.
      CAPTURE(shape, trial, gauge);
      const Body small = scaled(scene.body, gauge * (1 - margin));
      const auto d = separating_direction(small, scene.half, scene.r);
      REQUIRE(d.has_value());
      CHECK(gap_along(small, scene.half, scene.r, *d) > 0);
      CHECK(norm(*d) == Approx(1).epsilon(1e-15));
      const Body large = scaled(scene.body, gauge * (1 + margin));
      CHECK_FALSE(separating_direction(large, scene.half, scene.r).has_value());
    }
  }
}

TEST_CASE("every direction that parts a body from a box is a proof in long double") {
  RandomStream random(2, StreamId::test);
  int parted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const ShapeKind shape = kShapes[trial % 6];
    const Scene scene = random_scene(shape, trial % 3 == 0, random);
    const double least = trial % 5 == 0 ? 0.1 : 0.0;
    const auto d = separating_direction(scene.body, scene.half, scene.r, least);
    if (!d) continue;
    ++parted;
    if (!(gap_along(scene.body, scene.half, scene.r, *d) > least))
      FAIL_CHECK("no proof: " << trial);
  }
  CHECK(parted > 8000);
  CHECK(parted < 18000);
}

TEST_CASE("a ball and a box part where the nearest point of the box says so, to 1e-14") {
  RandomStream random(3, StreamId::test);
  for (int trial = 0; trial < 2000; ++trial) {
    Scene scene = random_scene(ShapeKind::sphere, trial % 2 == 0, random);
    Vec3 nearest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      nearest[axis] =
          std::clamp(0.0, scene.r[axis] - scene.half[axis], scene.r[axis] + scene.half[axis]);
    }
    const double distance = norm(nearest);
    if (distance < 1e-2) continue;
    CAPTURE(trial, distance);
    // Rounding of g is 28 units of |r| and the reach of both, some 2e-14 in all.
    CHECK(separating_direction(Sphere{distance - 3e-14}, scene.half, scene.r));
    CHECK_FALSE(separating_direction(Sphere{distance + 3e-14}, scene.half, scene.r));
  }
}

TEST_CASE("bodies aligned with a box, where corners and faces tie, are parted to rounding") {
  const Vec3 half{0.5, 0.5, 0.5};
  const double near = 1e-13;
  const double diagonal = std::sqrt(0.5);
  const Cylinder lying{0.2, 0.7, {1, 0, 0}}, leaning{0.2, 0.7, {diagonal, diagonal, 0}};
  CHECK(separating_direction(lying, half, {1.2 + near, 0, 0}));
  CHECK_FALSE(separating_direction(lying, half, {1.2 - near, 0, 0}));
  CHECK(separating_direction(lying, half, {0.1, 0.7 + near, 0}));
  CHECK_FALSE(separating_direction(lying, half, {0.1, 0.7 - near, 0}));
  // Edge against the end face, that leans towards it; and against the side.
  CHECK(separating_direction(leaning, half,
                             {0.5 + (0.7 + near) * diagonal, 0.5 + (0.7 + near) * diagonal, 0}));
  CHECK_FALSE(separating_direction(
      leaning, half, {0.5 + (0.7 - near) * diagonal, 0.5 + (0.7 - near) * diagonal, 0}));
  CHECK(separating_direction(leaning, half,
                             {0.5 + (0.2 + near) * diagonal, -0.5 - (0.2 + near) * diagonal, 0}));
  CHECK_FALSE(separating_direction(
      leaning, half, {0.5 + (0.2 - near) * diagonal, -0.5 - (0.2 - near) * diagonal, 0}));
  // Within a box, about it, and at its center.
  CHECK_FALSE(separating_direction(Sphere{0.1}, half, {0.2, 0.1, 0.3}));
  CHECK_FALSE(separating_direction(Sphere{9.0}, half, {0.2, 0.1, 0.3}));
  CHECK_FALSE(separating_direction(Sphere{0.1}, half, {0, 0, 0}));
  CHECK_FALSE(separating_direction(Disk{0.1}, {0.5, 0, 0}, {0, 0.05, 0}));
}

TEST_CASE("needles and thin plates a thousand times longer than thick are parted from a corner") {
  RandomStream random(4, StreamId::test);
  const Vec3 half{0.5, 0.5, 0.5};
  int parted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 axis = random_direction(random);
    const double length = random.uniform(1.0, 3.0);
    const Body body = trial % 2 == 0 ? Body(Spherocylinder{1e-3, length, axis})
                                     : Body(Ellipsoid{{length, length, 1e-3}, from_z_to(axis)});
    const Vec3 r{random.uniform(0.5, 2.5), random.uniform(0.5, 2.5), random.uniform(0.5, 2.5)};
    const auto d = separating_direction(body, half, r);
    if (d) {
      ++parted;
      if (!(gap_along(body, half, r, *d) > 0)) FAIL_CHECK("no proof: " << trial);
    } else {
      // No random search finds a direction either.
      long double best = -1;
      for (int probe = 0; probe < 200; ++probe) {
        best = std::max(best, gap_along(body, half, r, random_direction(random)));
      }
      if (best > 0) FAIL_CHECK("not parted: " << trial);
    }
  }
  CHECK(parted > 500);
  CHECK(parted < 2900);
}

}  // namespace
}  // namespace packstone
