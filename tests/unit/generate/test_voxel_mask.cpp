#include "generate/rsa/voxel_mask.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"
#include "rsa_oracle.hpp"

namespace packstone {
namespace {

using rsa::Candidate;
using rsa::CenterBox;
using rsa::PlacedBodies;
using rsa::VoxelMask;

Body random_body(RandomStream& random, double size, int dimension) {
  const double a = size * random.uniform(0.5, 1.5), b = size * random.uniform(0.5, 3.0);
  if (dimension == 2) {
    if (random.below(2) == 0) return Disk{a};
    return Ellipse{{a, b}, random.uniform(0.0, 3.0)};
  }
  switch (random.below(4)) {
    case 0:
      return Sphere{a};
    case 1:
      return Ellipsoid{{a, b, a}, random_rotation(random)};
    case 2:
      return Cylinder{a, b, random_direction(random)};
    default:
      return Spherocylinder{a, b, random_direction(random)};
  }
}

struct Scene {
  PlacedBodies placed;
  std::vector<Body> bodies;
  std::vector<Vec3> centers;

  Scene(const Cell& cell, double min_gap, int count, double size, std::uint64_t seed)
      : placed(cell, min_gap, count) {
    RandomStream random(41, StreamId::test, seed);
    for (int k = 0; k < count; ++k) {
      bodies.push_back(random_body(random, size, cell.dimension));
      centers.push_back({random.uniform() * cell.size.x, random.uniform() * cell.size.y,
                         cell.dimension == 3 ? random.uniform() * cell.size.z : 0.0});
      placed.add(Candidate(bodies.back()), centers.back());
    }
  }

  // Is the ball proven to come within the gap of an image?
  [[nodiscard]] bool covered(const Body& ball, const Vec3& at) const {
    bool hit = false;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      rsa_oracle::for_images(placed.cell(), 1, [&](const Vec3& shift) {
        const Vec3 r = (centers[i] + shift) - at;
        hit = hit || overlap(ball, bodies[i], r, placed.min_gap()) == Verdict::overlapping;
      });
    }
    return hit;
  }
};

Body ball_of(double radius, int dimension) {
  if (dimension == 2) return Disk{radius};
  return Sphere{radius};
}

CenterBox domain_of(const Cell& cell, double radius) {
  CenterBox box = rsa::centers_inside_walls(cell, {radius, radius, radius});
  if (cell.dimension == 2) box.lo.z = box.hi.z = 0.0;
  return box;
}

std::set<std::array<std::int32_t, 3>> voxels_left(const VoxelMask& mask) {
  std::set<std::array<std::int32_t, 3>> left;
  for (std::int64_t k = 0; k < mask.size(); ++k) left.insert(mask.index(k));
  return left;
}

}  // namespace

TEST_CASE("no point of a voxel struck out is free") {
  struct Case {
    Cell cell;
    double min_gap, radius;
    int count;
  };
  const Case cases[] = {{Cell{}, 0.0, 0.06, 20},
                        {Cell{3, {1.0, 0.6, 1.4}, {true, false, true}}, 0.01, 0.08, 12},
                        {cell_2d(1.0, 1.5), 0.0, 0.05, 15},
                        {cell_2d(0.8, 1.0), 0.02, 0.07, 8}};
  for (const Case& c : cases) {
    const Body ball = ball_of(c.radius, c.cell.dimension);
    const CenterBox domain = domain_of(c.cell, c.radius);
    const Scene scene(c.cell, c.min_gap, c.count, 0.06, static_cast<std::uint64_t>(c.count));
    VoxelMask mask(scene.placed, c.radius, domain);
    mask.notice_placed();
    const auto left = voxels_left(mask);
    REQUIRE_FALSE(left.empty());
    REQUIRE(mask.part() < 0.9);
    int struck = 0, free = 0;
    for (int k = 0; k < 3000; ++k) {
      RandomStream random(42, StreamId::test, static_cast<std::uint64_t>(k));
      Vec3 at{0, 0, 0};
      std::array<std::int32_t, 3> voxel{0, 0, 0};
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(c.cell.dimension); ++axis) {
        const double u = random.uniform();
        voxel[axis] = static_cast<std::int32_t>(u * mask.counts()[axis]);
        at[axis] = domain.lo[axis] + (domain.hi[axis] - domain.lo[axis]) * u;
      }
      const bool covered = scene.covered(ball, at);
      free += !covered;
      if (left.count(voxel) > 0) continue;
      ++struck;
      REQUIRE(covered);
    }
    CHECK(struck > 200);
    CHECK(free > 20);
  }
}

TEST_CASE("a mask kept up to date is the mask made anew, and draws from all that is left") {
  const Cell cell{};
  Scene scene(cell, 0.0, 6, 0.08, 1);
  const CenterBox domain = domain_of(cell, 0.09);
  VoxelMask kept(scene.placed, 0.09, domain);
  kept.notice_placed();
  const double before = kept.part();
  for (int k = 0; k < 5; ++k) {
    RandomStream random(43, StreamId::test, static_cast<std::uint64_t>(k));
    scene.placed.add(Candidate(random_body(random, 0.08, 3)),
                     {random.uniform(), random.uniform(), random.uniform()});
    kept.notice_placed();
  }
  VoxelMask anew(scene.placed, 0.09, domain);
  CHECK(anew.expected_cost() > 0);
  anew.notice_placed();
  CHECK(kept.part() < before);
  CHECK(voxels_left(kept) == voxels_left(anew));
  CHECK(kept.serves(0.09, domain));
  CHECK_FALSE(kept.serves(0.091, domain));
  CHECK_FALSE(kept.serves(0.09, {{0.1, 0, 0}, {0.9, 1, 1}}));

  const auto left = voxels_left(kept);
  std::set<std::array<std::int32_t, 3>> drawn;
  const rsa::TrialNumbers numbers(44, StreamId::test, 0);
  for (std::int64_t k = 0; k < 20 * kept.size(); ++k) {
    rsa::TrialNumbers::Row row = numbers.trial(k);
    const Vec3 at = kept.draw(row);
    std::array<std::int32_t, 3> voxel;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel[axis] = static_cast<std::int32_t>(at[axis] * kept.counts()[axis]);
    }
    REQUIRE(left.count(voxel) == 1);
    drawn.insert(voxel);
  }
  CHECK(drawn == left);
}

TEST_CASE("a mask strikes out most of what is covered") {
  // The voxels left at half the radius: the free part, and a layer of about one voxel around it.
  const Scene scene(Cell{}, 0.0, 40, 0.07, 2);
  const Body ball = Sphere{0.07};
  VoxelMask mask(scene.placed, 0.07, domain_of(Cell{}, 0.07));
  mask.notice_placed();
  int free = 0;
  constexpr int trials = 4000;
  for (int k = 0; k < trials; ++k) {
    RandomStream random(45, StreamId::test, static_cast<std::uint64_t>(k));
    free += !scene.covered(ball, {random.uniform(), random.uniform(), random.uniform()});
  }
  CHECK(mask.part() > static_cast<double>(free) / trials);
  CHECK(mask.part() < static_cast<double>(free) / trials + 0.25);
}

}  // namespace packstone
