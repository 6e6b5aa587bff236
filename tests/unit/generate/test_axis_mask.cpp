#include "generate/rsa/axis_mask.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/standing.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/structure/standing.hpp"
#include "rsa_oracle.hpp"

namespace packstone {
namespace {

using rsa::AxisMask;
using rsa::Candidate;
using rsa::outline_of;
using rsa::PlacedBodies;

enum class Kind { spherocylinder, cylinder, mixture };

// Axes along the edges of the cell come often enough to try every branch.
Vec3 random_axis(RandomStream& random) {
  const Vec3 edges[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  if (random.below(4) == 0) return edges[random.below(3)];
  return random_direction(random);
}

Body random_rod(RandomStream& random, Kind kind, double radius, double half) {
  const auto which = kind == Kind::mixture ? random.below(4) : kind == Kind::cylinder ? 1 : 0;
  const double r = kind == Kind::mixture ? radius * random.uniform(1.0, 3.0) : radius;
  if (which == 0) return Spherocylinder{r, half, random_axis(random)};
  if (which == 1) return Cylinder{r, half, random_axis(random)};
  if (which == 2) return Sphere{r};
  return Ellipsoid{{half, r, r}, random_rotation(random)};
}

Vec3 random_center(RandomStream& random, const Cell& cell) {
  return {random.uniform() * cell.size.x, random.uniform() * cell.size.y,
          random.uniform() * cell.size.z};
}

Cell box(const Vec3& size, const std::array<bool, 3>& periodic) {
  Cell cell;
  cell.size = size;
  cell.periodic = periodic;
  return cell;
}

bool inside_walls(const Cell& cell, const Body& body, const Vec3& center) {
  return rsa::is_inside(centers_inside_walls(cell, half_extents(body)), center, 3);
}

struct Case {
  Cell cell;
  Kind kind;
  double radius, half, min_gap;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {box({1, 1, 1}, {true, true, true}), Kind::spherocylinder, 0.01, 0.2, 0.0},
      {box({1, 1, 1}, {true, true, true}), Kind::cylinder, 0.02, 0.1, 0.01},
      {box({1, 1, 1}, {true, true, true}), Kind::cylinder, 0.05, 0.1, 0.0},
      {box({2, 1, 0.5}, {true, false, true}), Kind::mixture, 0.01, 0.3, 0.0},
      {box({1, 1, 1}, {true, true, true}), Kind::spherocylinder, 0.01, 1.7, 0.0}};
  return all;
}

TEST_CASE("a rod that the mask of axes blocks does overlap") {
  std::uint64_t key = 0;
  for (const Case& c : cases()) {
    CAPTURE(key);
    RandomStream random(43, StreamId::test, key++);
    AxisMask mask(c.cell, c.min_gap, c.radius);
    REQUIRE_FALSE(mask.empty());
    std::vector<Body> bodies;
    std::vector<Vec3> centers;
    for (int k = 0; k < 60; ++k) {
      bodies.push_back(random_rod(random, c.kind, c.radius, c.half));
      centers.push_back(random_center(random, c.cell));
      mask.add(outline_of(bodies.back()), centers.back());
    }
    int overlapping = 0, blocked = 0;
    for (int k = 0; k < 300; ++k) {
      const Body rod = random_rod(random, c.kind, c.radius, c.half);
      const Vec3 at = random_center(random, c.cell);
      // Trials that stick out of the walls are refused anyway.
      bool hit = !inside_walls(c.cell, rod, at);
      for (std::size_t i = 0; i < bodies.size() && !hit; ++i) {
        rsa_oracle::for_images(c.cell, 4, [&](const Vec3& shift) {
          const Vec3 r = (centers[i] + shift) - at;
          hit = hit || overlap(rod, bodies[i], r, c.min_gap) == Verdict::overlapping;
        });
      }
      overlapping += hit ? 1 : 0;
      if (!mask.blocks(outline_of(rod), at)) continue;
      ++blocked;
      CHECK(hit);
    }
    CHECK(overlapping > 30);
    CHECK(blocked > overlapping / 8);
  }
}

TEST_CASE("a cleared mask blocks nothing, nor does one that is left out") {
  const Case& c = cases().front();
  RandomStream random(47, StreamId::test, 0);
  AxisMask mask(c.cell, 0.0, c.radius), none(c.cell, 0.0, 1e-7);
  CHECK(none.empty());
  const Body rod = random_rod(random, c.kind, c.radius, c.half);
  for (AxisMask* m : {&mask, &none}) m->add(outline_of(rod), {0.5, 0.5, 0.5});
  CHECK(mask.blocks(outline_of(rod), {0.5, 0.5, 0.5}));
  CHECK_FALSE(none.blocks(outline_of(rod), {0.5, 0.5, 0.5}));
  mask.clear();
  CHECK_FALSE(mask.blocks(outline_of(rod), {0.5, 0.5, 0.5}));
}

TEST_CASE("long bodies are judged as without mask and grid of capsules") {
  constexpr int kCount = 400;
  std::uint64_t key = 0;
  for (const Case& c : cases()) {
    CAPTURE(key);
    RandomStream random(53, StreamId::test, key++);
    std::vector<OrderedBody> bodies;
    std::vector<std::int64_t> order;
    for (std::int64_t k = 0; k < kCount; ++k) {
      bodies.push_back({random_rod(random, c.kind, 0.2 * c.radius, c.half), 0});
      order.push_back(k);
    }
    PlacedBodies fast(c.cell, c.min_gap, bodies, order), plain(c.cell, c.min_gap, kCount);
    for (int round = 0; round < 2; ++round) {
      int fits = 0;
      for (const OrderedBody& b : bodies) {
        const Candidate candidate(b.body);
        const Vec3 at = random_center(random, c.cell);
        // Trials that stick out of the walls are refused either way.
        if (!inside_walls(c.cell, b.body, at)) continue;
        std::int64_t cost = 0;
        PlacedBodies::View view;
        const auto judge = [&](const PlacedBodies& placed) {
          return placed.look_around(candidate.outline, at, view, cost) &&
                 placed.leaves_room_for(candidate, at, view, cost);
        };
        const bool expected = judge(plain);
        CHECK(judge(fast) == expected);
        fits += expected ? 1 : 0;
        fast.add(candidate, at);
        plain.add(candidate, at);
      }
      CHECK(fits > 10);
      CHECK(fits < kCount);
      fast.clear();
      plain.clear();
    }
  }
}

}  // namespace
}  // namespace packstone
