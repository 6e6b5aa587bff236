#include "generate/rsa/body_lanes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "generate/rsa/outline.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {
namespace {

using rsa::BodyLanes;

// Any 3D body, from compact ones to fibers a hundred times as long as wide.
Body random_body(RandomStream& random, double size) {
  const double a = size * std::pow(10.0, random.uniform(-1.0, 1.0));
  const double b = size * std::pow(10.0, random.uniform(-1.0, 1.0));
  switch (random.below(4)) {
    case 0:
      return Sphere{a};
    case 1:
      return Ellipsoid{{a, b, std::sqrt(a * b)}, random_rotation(random)};
    case 2:
      return Cylinder{a, b, random_direction(random)};
    default:
      return Spherocylinder{a, b, random_direction(random)};
  }
}

Vec3 random_center(RandomStream& random, const Cell& cell) {
  return {random.uniform() * cell.size.x, random.uniform() * cell.size.y,
          cell.dimension == 3 ? random.uniform() * cell.size.z : 0.0};
}

// From a to the nearest image of b.
Vec3 nearest_image(const Cell& cell, const Vec3& a, const Vec3& b) {
  Vec3 r = b - a;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell.periodic[axis]) r[axis] -= cell.size[axis] * std::round(r[axis] / cell.size[axis]);
  }
  return r;
}

struct Placed {
  std::vector<Body> bodies;
  std::vector<Vec3> centers;
  BodyLanes lanes;

  explicit Placed(const Cell& cell) : lanes(cell) {}
};

bool any_overlaps(const Cell& cell, const Placed& placed, const Body& body, const Vec3& center,
                  double min_gap) {
  for (std::size_t i = 0; i < placed.bodies.size(); ++i) {
    const Vec3 r = nearest_image(cell, center, placed.centers[i]);
    if (overlap(body, placed.bodies[i], r, min_gap) == Verdict::overlapping) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("overlaps seen by lanes are overlaps to the exact kernel, and few are missed") {
  int balls_overlap = 0, balls_seen = 0, rods_overlap = 0, rods_seen = 0;
  const Cell cells[] = {Cell{}, Cell{3, {1.0, 0.7, 2.5}, {true, false, true}}};
  for (std::uint64_t scene = 0; scene < 400; ++scene) {
    const Cell& cell = cells[scene % 2];
    const double min_gap = scene % 3 == 0 ? 0.02 : 0.0;
    Placed placed(cell);
    RandomStream random(31, StreamId::test, scene);
    for (int i = 0; i < 1 + static_cast<int>(scene % 20); ++i) {
      placed.bodies.push_back(random_body(random, 0.04));
      placed.centers.push_back(random_center(random, cell));
      placed.lanes.add(rsa::outline_of(placed.bodies.back()), placed.centers.back());
    }
    for (int k = 0; k < 25; ++k) {
      const Body body = random_body(random, 0.04);
      const rsa::Outline outline = rsa::outline_of(body);
      const Vec3 center = random_center(random, cell);
      const Body ball = Sphere{outline.in_radius};
      BodyLanes::View view;
      const bool ball_seen = placed.lanes.ball_overlaps(outline.in_radius, min_gap, center, view);
      const bool ball_overlaps = any_overlaps(cell, placed, ball, center, min_gap);
      balls_overlap += ball_overlaps;
      balls_seen += ball_seen;
      if (ball_seen) REQUIRE(ball_overlaps);
      if (ball_seen || outline.half_length == 0.0 || outline.ends == rsa::Outline::Ends::loose) {
        continue;
      }
      const bool rod_seen = placed.lanes.rod_overlaps(outline, min_gap, view);
      const bool rod_overlaps = any_overlaps(cell, placed, body, center, min_gap);
      rods_overlap += rod_overlaps;
      rods_seen += rod_seen;
      if (rod_seen) REQUIRE(rod_overlaps);
    }
  }
  // What is missed are ellipsoids, of which lanes know but a ball, and gaps at edges.
  CHECK(balls_overlap > 1000);
  CHECK(balls_seen > 0.85 * balls_overlap);
  CHECK(rods_overlap > 500);
  CHECK(rods_seen > 0.65 * rods_overlap);
}

TEST_CASE("overlaps of cylinders seen by lanes hold for thin fibers, where floats are coarse") {
  const Cell cell{};
  int seen = 0;
  for (std::uint64_t scene = 0; scene < 400; ++scene) {
    RandomStream random(32, StreamId::test, scene);
    const double radius = std::pow(10.0, random.uniform(-5.0, -2.0));
    const Cylinder first{radius, 0.45, random_direction(random)};
    // Nearly touching, at the sides or at the ends, and often almost parallel.
    const Vec3 tilt = random_direction(random) * std::pow(10.0, random.uniform(-6.0, 0.0));
    const Cylinder second{radius, random.uniform(0.0, 0.45) + radius,
                          normalized(first.axis + tilt)};
    BodyLanes lanes(cell);
    lanes.add(rsa::outline_of(first), {0.5, 0.5, 0.5});
    for (int k = 0; k < 50; ++k) {
      const double along = random.uniform(-0.45, 0.45);
      const Vec3 r =
          along * first.axis + random_direction(random) * (2.0 * radius * random.uniform(0.9, 1.1));
      BodyLanes::View view;
      const rsa::Outline outline = rsa::outline_of(Body{second});
      if (lanes.ball_overlaps(0.0, 0.0, Vec3{0.5, 0.5, 0.5} + r, view)) continue;
      if (!lanes.rod_overlaps(outline, 0.0, view)) continue;
      ++seen;
      REQUIRE(overlap(Body{first}, Body{second}, r) == Verdict::overlapping);
    }
  }
  CHECK(seen > 1000);
}

TEST_CASE("lanes list every body within reach, the nearer ones first") {
  const Cell cell{3, {1.0, 2.0, 0.5}, {true, true, false}};
  Placed placed(cell);
  RandomStream random(33, StreamId::test);
  for (int i = 0; i < 29; ++i) {
    placed.bodies.push_back(random_body(random, 0.03));
    placed.centers.push_back(random_center(random, cell));
    placed.lanes.add(rsa::outline_of(placed.bodies.back()), placed.centers.back());
  }
  for (int k = 0; k < 200; ++k) {
    const Vec3 center = random_center(random, cell);
    const double reach = random.uniform(0.0, 0.4);
    BodyLanes::View view;
    if (placed.lanes.ball_overlaps(0.0, 0.0, center, view)) continue;
    std::array<std::int32_t, BodyLanes::kMost> listed;
    const std::int32_t count = placed.lanes.list_near(reach, view, listed);
    for (std::int32_t i = 0; i < 29; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double distance = norm(nearest_image(cell, center, placed.centers[at]));
      const bool within = distance < reach + circum_radius(placed.bodies[at]);
      const auto end = listed.begin() + count;
      if (within) CHECK(std::count(listed.begin(), end, i) == 1);
    }
  }
}

}  // namespace packstone
