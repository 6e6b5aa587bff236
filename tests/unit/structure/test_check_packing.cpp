#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "support/brute_force_check.hpp"

using namespace packstone;
using Image = std::array<int, 3>;
using Pair = std::array<std::int64_t, 2>;

namespace {

Body random_body(int dimension, double size, RandomStream& random) {
  const auto other = [&] { return size * std::pow(10.0, -random.uniform()); };
  if (dimension == 2) {
    if (random.below(2) == 0) return Disk{size};
    return Ellipse{{size, other()}, random.uniform(0.0, 3.0)};
  }
  switch (random.below(4)) {
    case 0:
      return Sphere{size};
    case 1:
      return Ellipsoid{{size, other(), other()}, random_rotation(random)};
    case 2:
      return Cylinder{other(), size, random_direction(random)};
    default:
      return Spherocylinder{other(), size, random_direction(random)};
  }
}

// `count` bodies of all shapes at random places: some overlap, some stick out of the walls.
Packing scattered(std::uint64_t seed, int dimension, int count, double size) {
  RandomStream random(seed, StreamId::test);
  Packing packing;
  if (dimension == 2) packing.cell = cell_2d(1, 1);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
    packing.cell.size[axis] = random.uniform(0.6, 1.5);
    packing.cell.periodic[axis] = random.uniform() < 0.7;
  }
  packing.groups = {"first", "second"};
  for (int i = 0; i < count; ++i) {
    Vec3 center{random.uniform(), random.uniform(), random.uniform()};
    center = scale(center, packing.cell.size);
    const double s = size * std::pow(4.0, -random.uniform());
    packing.inclusions.push_back({center, random_body(dimension, s, random), i % 2});
  }
  return packing;
}

Packing spheres(const Cell& cell, const std::vector<Vec3>& centers, double radius) {
  Packing packing;
  packing.cell = cell;
  packing.groups = {"spheres"};
  for (const Vec3& center : centers) packing.inclusions.push_back({center, Sphere{radius}, 0});
  return packing;
}

void require_same_verdict(const Certificate& found, const Certificate& expected) {
  CHECK(found.count == expected.count);
  CHECK(found.overlaps == expected.overlaps);
  CHECK(found.gaps_below == expected.gaps_below);
  CHECK(found.outside_walls == expected.outside_walls);
  if (std::isinf(expected.smallest_gap)) {
    CHECK(found.smallest_gap == expected.smallest_gap);
    return;
  }
  REQUIRE(std::abs(found.smallest_gap - expected.smallest_gap) <=
          found.smallest_gap_error + expected.smallest_gap_error);
  CHECK(found.worst_pair == expected.worst_pair);
  CHECK(found.worst_image == expected.worst_image);
}

}  // namespace

TEST_CASE("the check says what measuring every pair and image says") {
  struct Kind {
    int dimension, count;
    double size;
  };
  // Dilute, near, crowded with overlaps; bodies longer than the cell with own images; single ones.
  const Kind kind = GENERATE(Kind{3, 6, 0.05}, Kind{3, 10, 0.15}, Kind{3, 8, 0.4}, Kind{3, 3, 1.2},
                             Kind{3, 1, 0.3}, Kind{3, 2, 0.001}, Kind{2, 12, 0.05},
                             Kind{2, 10, 0.2}, Kind{2, 4, 1.5}, Kind{2, 1, 0.4});
  CAPTURE(kind.dimension, kind.count, kind.size);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    const Packing packing = scattered(seed, kind.dimension, kind.count, kind.size);
    const double min_gap = seed % 2 == 0 ? 0.0 : 0.03;
    const Certificate found = check_packing(packing, {.min_gap = min_gap});
    require_same_verdict(found, test::brute_force_check(packing, min_gap));
    CHECK(found.fraction == Approx(fraction(packing)).epsilon(1e-14));
  }
}

TEST_CASE("the certificate is the same for 1, 2, 3 and 8 threads") {
  Packing packing = scenes::jostled_ellipsoids(600, 0.5, 3);
  packing.inclusions[77].center = packing.inclusions[78].center;
  const Certificate one = check_packing(packing, {.min_gap = 1e-3}, RunContext().threads(1));
  const auto directions = separating_directions(packing, {}, RunContext().threads(1));
  CHECK(one.overlaps > 0);
  for (const int threads : {2, 3, 8}) {
    CHECK(check_packing(packing, {.min_gap = 1e-3}, RunContext().threads(threads)) == one);
    const auto again = separating_directions(packing, {}, RunContext().threads(threads));
    REQUIRE(again.size() == directions.size());
    for (std::size_t k = 0; k < again.size(); ++k) {
      REQUIRE(again[k].direction == directions[k].direction);
      REQUIRE(again[k].gap == directions[k].gap);
    }
  }
}

TEST_CASE("an overlap of 1e-9 of the size is found and named, for every shape") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    RandomStream random(seed, StreamId::test, 1);
    const int dimension = seed % 3 == 0 ? 2 : 3;
    const Cell cell = dimension == 2 ? cell_2d(10, 10) : Cell{3, {10, 10, 10}};
    const Body a = random_body(dimension, 0.5, random);
    const Body b = random_body(dimension, 0.5, random);
    const double turn = random.uniform(0.0, 6.28);
    const Vec3 away =
        dimension == 3 ? random_direction(random) : Vec3{std::cos(turn), std::sin(turn), 0.0};
    // Sliding b along the contact normal by the gap makes the pair touch.
    const Gap apart = gap(a, b, 3.0 * away);
    const Vec3 touching = 3.0 * away - apart.value * apart.normal;
    const Vec3 corner = dimension == 3 ? Vec3{0, 5, 9} : Vec3{0, 5, 0};
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 other = wrapped(cell, corner + touching + sign * 1e-9 * apart.normal);
      const Packing packing{cell, {"all"}, {{corner, a, 0}, {other, b, 0}}, {}, {}};
      const Certificate verdict = check_packing(packing);
      CHECK(verdict.overlaps == (sign < 0.0 ? 1 : 0));
      CHECK(verdict.worst_pair == Pair{0, 1});
      // The kernel placed the pair, and some 1e-15 for each coordinate of a cell of 10.
      const double slack = apart.error + 1e-14;
      CHECK(std::abs(verdict.smallest_gap - sign * 1e-9) <= verdict.smallest_gap_error + slack);
      CHECK(verdict.smallest_gap_error < 1e-11);
    }
  }
}

TEST_CASE("a planted overlap in a dense packing is counted and named") {
  Packing packing = scenes::jostled_ellipsoids(500, 0.5, 5);
  const Certificate before = check_packing(packing);
  REQUIRE(before.passed());
  CHECK(before.smallest_gap > 0.0);
  CHECK(before.fraction == Approx(0.5).epsilon(1e-12));
  packing.inclusions.push_back({packing.inclusions[123].center, Sphere{1e-3}, 0});
  const Certificate after = check_packing(packing);
  CHECK(after.overlaps == 1);
  CHECK_FALSE(after.passed());
  CHECK(after.worst_pair == Pair{123, 500});
  CHECK(after.worst_image == Image{0, 0, 0});
}

TEST_CASE("a single body meets its own images, and nobody where there is no period") {
  const Packing alone = spheres(Cell{3, {1, 2, 3}}, {{0.5, 0.5, 0.5}}, 1e-4);
  const Certificate periodic = check_packing(alone);
  CHECK(periodic.smallest_gap == Approx(1.0 - 2e-4).epsilon(1e-14));
  CHECK(periodic.worst_pair == Pair{0, 0});
  CHECK(periodic.worst_image == Image{1, 0, 0});

  const Cell box{3, {1, 2, 3}, {false, false, false}};
  const Certificate walled = check_packing(spheres(box, {{0.5, 0.5, 0.5}}, 0.1));
  CHECK(std::isinf(walled.smallest_gap));
  CHECK(walled.worst_pair == Pair{-1, -1});
  CHECK(walled.passed());
  CHECK(std::isinf(check_packing(spheres(box, {}, 0.1)).smallest_gap));
}

TEST_CASE("two far specks in a large cell have their distance measured") {
  const Cell box{3, {1e3, 1e3, 1e3}, {false, false, false}};
  const Certificate verdict = check_packing(spheres(box, {{1, 1, 1}, {999, 1, 1}}, 1e-3));
  CHECK(verdict.smallest_gap == Approx(998.0 - 2e-3).epsilon(1e-14));
}

TEST_CASE("a body that rests on a wall is inside, one that is pushed through it is not") {
  const Cell cell{3, {1, 1, 0.7}, {true, true, false}};
  RandomStream random(1, StreamId::test);
  for (int k = 0; k < 200; ++k) {
    const Body body = random_body(3, 0.2, random);
    const double h = half_extents(body).z;
    for (const double z : {h, cell.size.z - h}) {
      Packing packing{cell, {"all"}, {{{0.5, 0.5, z}, body, 0}}, {}, {}};
      CHECK(check_packing(packing).outside_walls == 0);
      packing.inclusions[0].center.z += z < 0.35 ? -1e-14 : 1e-14;
      CHECK(check_packing(packing).outside_walls == 1);
    }
  }
  // Written by hand, exactly on the wall.
  CHECK(check_packing(spheres(cell, {{0.5, 0.5, 0.1}, {0.1, 0.1, 0.7 - 0.1}}, 0.1)).passed());
}

TEST_CASE("who crosses a wall is named with the wall that is crossed deepest, and how far") {
  const Cell cell{3, {1, 1, 0.7}, {true, false, false}};
  const Packing packing =
      spheres(cell, {{0.99, 0.5, 0.3}, {0.5, 0.08, 0.65}, {0.2, 0.97, 0.35}, {0.8, 0.9, 0.6}}, 0.1);
  const std::vector<WallCrossing> found = wall_crossings(packing);
  CHECK(check_packing(packing).outside_walls == 2);
  REQUIRE(found.size() == 2);
  CHECK(found[0].inclusion == 1);
  CHECK(found[0].axis == 2);
  CHECK(found[0].wall == 0.7);
  CHECK(found[0].depth == Approx(0.05));
  CHECK(found[1].inclusion == 2);
  CHECK(found[1].axis == 1);
  CHECK(found[1].wall == 1.0);
  CHECK(found[1].depth == Approx(0.07));
  const std::optional<WallCrossing> deepest = deepest_crossing(packing);
  REQUIRE(deepest.has_value());
  CHECK(deepest->inclusion == 2);
  CHECK(deepest->depth == found[1].depth);
  const Packing inside = spheres(Cell{}, {{0, 0, 0}}, 0.3);
  CHECK(wall_crossings(inside).empty());
  CHECK_FALSE(deepest_crossing(inside).has_value());
}

TEST_CASE("the census adds up per group") {
  const Packing packing = scattered(4, 3, 9, 0.01);
  const Certificate verdict = check_packing(packing);
  REQUIRE(verdict.groups.size() == 2);
  CHECK(verdict.groups[0].name == "first");
  CHECK(verdict.groups[0].count == 5);
  CHECK(verdict.groups[1].count == 4);
  CHECK(verdict.groups[0].fraction + verdict.groups[1].fraction ==
        Approx(verdict.fraction).epsilon(1e-15));
}

TEST_CASE("the least gap asked for is judged apart from overlap") {
  const Packing pair = spheres(Cell{}, {{0.3, 0.5, 0.5}, {0.6, 0.5, 0.5}}, 0.1);
  const Certificate strict = check_packing(pair, {.min_gap = 0.11});
  CHECK(strict.gaps_below == 1);
  CHECK(strict.overlaps == 0);
  CHECK_FALSE(strict.passed());
  CHECK(check_packing(pair, {.min_gap = 0.09}).passed());
}

TEST_CASE("every pair of near boxes gets a direction that proves it apart") {
  const Packing packing = scenes::jostled_ellipsoids(300, 0.5, 9);
  const auto witnesses = separating_directions(packing);
  REQUIRE(witnesses.size() > 300);
  for (const PairWitness& w : witnesses) {
    const Inclusion& a = packing.inclusions[w.a];
    const Inclusion& b = packing.inclusions[w.b];
    const Vec3 r = b.center - a.center + image_shift(packing.cell, w.image);
    REQUIRE(w.gap > 0.0);
    REQUIRE(proven_gap(a.body, b.body, r, w.direction) >= w.gap);
  }
}

TEST_CASE("a pair that overlaps gets a direction without proof") {
  const auto witnesses =
      separating_directions(spheres(Cell{}, {{0.5, 0.5, 0.5}, {0.6, 0.5, 0.5}}, 0.1));
  REQUIRE(witnesses.size() == 1);
  CHECK(witnesses[0].gap <= 0.0);
}

TEST_CASE("what cannot be checked is refused with a reason") {
  const Packing pair = spheres(Cell{}, {{0.3, 0.5, 0.5}}, 0.1);
  CHECK_THROWS_WITH(check_packing(pair, {.min_gap = -1.0}), Catch::Contains("min_gap = -1"));
  CHECK_THROWS_WITH(check_packing(pair, {.min_gap = 1e300}),
                    Catch::Contains("min_gap = 1e+300; allowed are numbers >= 0 and below"));
  CHECK_THROWS_WITH(check_packing(spheres(Cell{}, {{0.3, 0.5, 0.5}}, 1e5)),
                    Catch::Contains("inclusion 0: it is 200000 periods"));
  Packing long_needle = spheres(cell_2d(1, 1), {}, 1.0);
  long_needle.inclusions.push_back({{0.5, 0.5, 0.0}, Ellipse{{1e4, 1e-3}, 0.0}, 0});
  CHECK_THROWS_AS(check_packing(long_needle), InvalidArgument);
}
