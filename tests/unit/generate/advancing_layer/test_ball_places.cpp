#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "generate/advancing_layer/anchor_queue.hpp"
#include "generate/advancing_layer/ball_levels.hpp"
#include "generate/advancing_layer/contact_arcs.hpp"
#include "generate/advancing_layer/contact_caps.hpp"
#include "generate/advancing_layer/pockets.hpp"
#include "generate/advancing_layer/standing_balls.hpp"
#include "packstone/core/random.hpp"

namespace packstone::advancing_layer {
namespace {

struct Ball {
  Vec3 center;
  double radius;
};

Vec3 random_point(const Cell& cell, RandomStream& random) {
  Vec3 p;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    p[axis] = random.uniform(0.0, cell.size[axis]);
  }
  return p;
}

// Every image within `reach` of p, as the ball and the vector to it, rounded to be compared.
using Near = std::multiset<std::array<long, 4>>;
std::array<long, 4> key_of(std::int32_t ball, const Vec3& r) {
  return {ball, std::lround(1e9 * r.x), std::lround(1e9 * r.y), std::lround(1e9 * r.z)};
}

Near near_by_brute_force(const Cell& cell, const std::vector<Ball>& balls, const Vec3& p,
                         double reach) {
  constexpr int kImages = 6;
  Near near;
  const auto last = [&](std::size_t axis) { return cell.periodic[axis] ? kImages : 0; };
  for (std::size_t k = 0; k < balls.size(); ++k) {
    for (int x = -last(0); x <= last(0); ++x) {
      for (int y = -last(1); y <= last(1); ++y) {
        for (int z = -last(2); z <= last(2); ++z) {
          const Vec3 r = balls[k].center + image_shift(cell, {x, y, z}) - p;
          if (norm(r) < reach + balls[k].radius) near.insert(key_of(static_cast<int>(k), r));
        }
      }
    }
  }
  return near;
}

template <int D>
void compare_levels(const Cell& cell, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  BallLevels<D> levels(cell, 0.01, 0.4, 60);
  std::vector<Ball> balls;
  for (int k = 0; k < 60; ++k) {
    // Some smaller and larger than expected.
    balls.push_back({random_point(cell, random), 0.005 * std::pow(160.0, random.uniform())});
    CHECK(levels.add(balls.back().center, balls.back().radius) == k);
  }
  for (int query = 0; query < 40; ++query) {
    const Vec3 p = random_point(cell, random);
    const double reach = random.uniform(0.0, 1.5);
    Near seen;
    levels.near(p, reach, [&](std::int32_t ball, const Vec3& r, double radius) {
      CHECK(radius == balls[static_cast<std::size_t>(ball)].radius);
      if (norm(r) < reach + radius) seen.insert(key_of(ball, r));
      return true;
    });
    CHECK(seen == near_by_brute_force(cell, balls, p, reach));
  }
}

// Unit vectors blocked by caps e . n > c.
struct Cap {
  Vec3 n;
  double c;
};

Vec3 random_unit(int dimension, RandomStream& random) {
  if (dimension == 3) return random_direction(random);
  const double angle = random.uniform(0.0, 6.283185307179586);
  return {std::cos(angle), std::sin(angle), 0.0};
}

template <class Blocked>
void compare_ends(int dimension, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  Blocked blocked;
  std::vector<Cap> caps;
  const auto count = 1 + random.below(9);
  for (std::uint64_t k = 0; k < count; ++k) {
    const Cap cap{random_unit(dimension, random), random.uniform(-0.1, 0.99)};
    caps.push_back(cap);
    REQUIRE(blocked.block(cap.n, cap.c));
  }
  std::vector<Vec3> ends;
  blocked.visit_ends([](const Vec3&) { return true; }, [&](const Vec3& e) { ends.push_back(e); });
  for (const Vec3& e : ends) {
    CHECK(norm(e) == Approx(1.0).epsilon(1e-12));
    int touched = 0;
    for (const Cap& cap : caps) {
      CHECK(dot(e, cap.n) < cap.c + 1e-9);
      touched += std::abs(dot(e, cap.n) - cap.c) < 1e-9 ? 1 : 0;
    }
    CHECK(touched >= dimension - 1);
  }
  // The lowest free point is an end, or nothing holds it there.
  const std::size_t up = static_cast<std::size_t>(dimension) - 1;
  double lowest = 2.0;
  Vec3 at;
  for (int k = 0; k < 20'000; ++k) {
    const Vec3 e = random_unit(dimension, random);
    const bool is_free = std::all_of(caps.begin(), caps.end(),
                                     [&](const Cap& cap) { return dot(e, cap.n) <= cap.c; });
    if (is_free && e[up] < lowest) {
      lowest = e[up];
      at = e;
    }
  }
  if (lowest > 1.0) {
    // Corners that are free all the same are points of a free part too small to be hit.
    CHECK(ends.size() < 8);
    return;
  }
  constexpr double kBottom = -0.95;  // There it is the lowest of all, held or not.
  if (lowest < kBottom) return;
  int near = 0;
  for (const Cap& cap : caps) near += std::abs(dot(at, cap.n) - cap.c) < 0.03 ? 1 : 0;
  if (near < dimension - 1) return;
  double lowest_end = 2.0;
  for (const Vec3& e : ends) lowest_end = std::min(lowest_end, e[up]);
  CHECK(lowest_end < lowest + 1e-9);
}

}  // namespace

TEST_CASE("BallLevels finds every image within reach, as brute force does") {
  compare_levels<2>(cell_2d(1.0, 1.3, true, true), 1);
  compare_levels<2>(cell_2d(4.0, 3.0, true, false), 2);
  compare_levels<2>(cell_2d(4.0, 9.0, false, false), 3);
  compare_levels<3>({3, {1.0, 1.2, 1.4}, {true, true, true}}, 4);
  compare_levels<3>({3, {3.0, 2.0, 5.0}, {true, false, false}}, 5);
}

TEST_CASE("AnchorQueue walks upward over the anchors that may hold a radius") {
  RandomStream random(3, StreamId::test);
  AnchorQueue queue(10.0, 0.25, 0.1);
  std::vector<double> heights, limits;
  for (std::int32_t k = 0; k < 300; ++k) {
    heights.push_back(random.uniform(0.0, 10.0));
    limits.push_back(1e300);
    queue.add(k, heights.back());
    if (k % 3 == 0) {
      limits.back() = random.uniform(0.05, 1.0);
      queue.lower_limit(k, limits.back());
    }
  }
  for (int round = 0; round < 200; ++round) {
    const double from = random.uniform(0.0, 10.0);
    const double radius = random.uniform(0.1, 1.0);
    std::set<std::int32_t> expected;
    for (std::int32_t k = 0; k < 300; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const bool above = static_cast<int>(heights[at] * 4.0) >= static_cast<int>(from * 4.0);
      if (above && limits[at] > radius && limits[at] > 0.1) expected.insert(k);
    }
    std::set<std::int32_t> seen;
    int bin = 0;
    queue.walk(from, radius, [&](std::int32_t anchor, double& limit) {
      const auto at = static_cast<std::size_t>(anchor);
      CHECK(static_cast<int>(heights[at] * 4.0) >= bin);
      bin = static_cast<int>(heights[at] * 4.0);
      CHECK(seen.insert(anchor).second);
      if (anchor % 7 == round % 7) limits[at] = limit = std::min(limits[at], radius);
      return true;
    });
    CHECK(seen == expected);
  }
}

TEST_CASE("AnchorQueue ends its walk where it is told") {
  AnchorQueue queue(1.0, 0.5, 0.0);
  for (std::int32_t k = 0; k < 10; ++k) queue.add(k, 0.1 * k);
  int seen = 0;
  queue.walk(0.0, 1.0, [&](std::int32_t, double&) { return ++seen < 4; });
  CHECK(seen == 4);
  seen = 0;
  queue.walk(0.0, 1.0, [&](std::int32_t, double&) { return ++seen > 0; });
  CHECK(seen == 10);
}

TEST_CASE("ContactArcs and ContactCaps: ends touch what they should and are free") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    compare_ends<ContactArcs>(2, seed);
    compare_ends<ContactCaps>(3, seed);
  }
}

TEST_CASE("ContactArcs: nothing is left of a circle that is covered") {
  ContactArcs arcs;
  for (const Vec3& n :
       {Vec3{1, 0, 0}, Vec3{-0.5, 0.8660254037844386, 0}, Vec3{-0.5, -0.8660254037844386, 0}}) {
    REQUIRE(arcs.block(n, 0.4));
  }
  int ends = 0;
  arcs.visit_ends([](const Vec3&) { return true; }, [&](const Vec3&) { ++ends; });
  CHECK(ends == 0);
  CHECK_FALSE(arcs.block({1, 0, 0}, -1.0));
  CHECK(arcs.block({1, 0, 0}, 1.0));
}

TEST_CASE("Pockets: a disk between two on the floor lies where the triangle says") {
  const Cell cell = cell_2d(10.0, 10.0, false, false);
  Pockets<2> pockets(cell, {1.0, 1.0, 1.0, 3}, 0.0);
  pockets.add({3.0, 1.0, 0.0}, 1.0);
  pockets.add({5.5, 1.0, 0.0}, 1.0);
  std::vector<Pocket> found;
  pockets.find({.radius = 1.0, .from = 0.0, .most = 10}, found);
  REQUIRE(found.size() == 2);
  // On the floor beside either disk, 1e-11 apart.
  for (const Pocket& pocket : found) CHECK(pocket.center.y == Approx(1.0).margin(1e-9));
}

TEST_CASE("StandingBalls: a disk on two others lies where the triangle says, and nothing lower") {
  StandingBalls<2> balls(cell_2d(10.0, 10.0, false, false), {1.0, 1.0, 1.0, 3}, 0.0);
  balls.add({3.0, 1.0, 0.0}, 1.0);
  balls.add({5.5, 1.0, 0.0}, 1.0);
  double lowest_between = 0.0;
  balls.visit_places(0, 1.0, [&](const Vec3& center) {
    if (std::abs(center.x - 4.25) < 1e-6) lowest_between = center.y;
  });
  CHECK(lowest_between == Approx(1.0 + std::sqrt(4.0 - 1.25 * 1.25)).epsilon(1e-9));
  CHECK(balls.is_clear({4.25, lowest_between + 1e-6, 0.0}, 1.0));
  CHECK_FALSE(balls.is_clear({4.25, lowest_between - 1e-6, 0.0}, 1.0));
}

TEMPLATE_TEST_CASE_SIG(
    "StandingBalls: the radius that fails on a ball fails, and a little less fits", "",
    ((int D), D), 2, 3) {
  constexpr double kLargest = 1.5, kSmallest = 0.05, kStep = 0.1;
  const Cell cell =
      D == 2 ? cell_2d(10.0, 10.0, true, false) : Cell{3, {6.0, 6.0, 6.0}, {true, true, false}};
  int bracketed = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed, StreamId::test);
    StandingBalls<D> balls(cell, {kSmallest, kLargest, 0.5, 100}, 0.0);
    for (int trial = 0; trial < 400; ++trial) {
      const double radius = random.uniform(0.1, kLargest);
      const Vec3 center = random_point(cell, random);
      if (balls.is_clear(center, radius)) balls.add(center, radius);
    }
    Vec3 place;
    for (std::int32_t anchor = 0; anchor < balls.size(); ++anchor) {
      if (balls.lowest(anchor, kLargest, place)) continue;
      const double fails = balls.failing_radius(anchor, kLargest, kStep);
      REQUIRE(fails <= kLargest);
      if (!(fails > kSmallest)) continue;
      REQUIRE_FALSE(balls.lowest(anchor, fails, place));
      // The bracket is an eighth of the last step, and this at most the way so far and one more.
      const double width = (kLargest - fails + kStep * kLargest) / 8.0;
      if (fails - width > kSmallest) {
        REQUIRE(balls.lowest(anchor, fails - width - 1e-9, place));
        REQUIRE(balls.is_clear(wrapped(cell, place), fails - width - 1e-9));
        ++bracketed;
      }
    }
  }
  CHECK(bracketed > 50);
}

}  // namespace packstone::advancing_layer
