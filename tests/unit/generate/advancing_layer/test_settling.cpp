#include "generate/advancing_layer/settling.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "../../../support/random_body.hpp"
#include "generate/advancing_layer/flat_gap.hpp"
#include "generate/advancing_layer/linear_program.hpp"
#include "generate/advancing_layer/solid_gap.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::advancing_layer {
namespace {

Body random_ellipse(RandomStream& random) {
  const double b = random.uniform(0.05, 1.0);
  return Ellipse{{b * std::pow(20.0, random.uniform()), b}, random.uniform(0.0, 3.14)};
}

Body random_ellipsoid(RandomStream& random) {
  const auto length = [&] { return 0.05 * std::pow(20.0, random.uniform()); };
  switch (random.below(4)) {
    case 0:
      return Sphere{length()};
    case 1: {
      const double across = length();
      return Ellipsoid{{across, across, length()}, random_rotation(random)};
    }
    default:
      return Ellipsoid{{length(), length(), length()}, random_rotation(random)};
  }
}

// A height that nothing reaches.
constexpr double kNowhere = 1e300;

// Least height over all corners of the polygon or polyhedron, box included.
template <int D>
double lowest_corner(std::vector<HalfSpace> sides, double most) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      HalfSpace side{{}, most};
      side.n[axis] = sign;
      sides.push_back(side);
    }
  }
  double lowest = 1e300;
  const auto look = [&](const Vec3& x) {
    const bool inside = std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
      return dot(side.n, x) <= side.reach + 1e-9;
    });
    if (inside) lowest = std::min(lowest, x[D - 1]);
  };
  const std::size_t n = sides.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const Vec3& a = sides[i].n;
      const Vec3& b = sides[j].n;
      if constexpr (D == 2) {
        const double det = a.x * b.y - a.y * b.x;
        if (std::abs(det) < 1e-12) continue;
        look({(sides[i].reach * b.y - sides[j].reach * a.y) / det,
              (a.x * sides[j].reach - b.x * sides[i].reach) / det, 0.0});
      } else {
        for (std::size_t k = j + 1; k < n; ++k) {
          const Vec3& c = sides[k].n;
          const double det = dot(a, cross(b, c));
          if (std::abs(det) < 1e-12) continue;
          look((sides[i].reach * cross(b, c) + sides[j].reach * cross(c, a) +
                sides[k].reach * cross(a, b)) /
               det);
        }
      }
    }
  }
  return lowest;
}

template <int D>
void compare_programs(std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  std::vector<HalfSpace> sides;
  const auto count = random.below(9);
  for (std::uint64_t k = 0; k < count; ++k) {
    Vec3 n = random_direction(random);
    if (D == 2) n = normalized(Vec3{n.x, n.y, 0.0});
    // Every third touches the origin.
    sides.push_back({n, k % 3 == 0 ? 0.0 : random.uniform(0.0, 1.0)});
  }
  const Vec3 x = lowest_point<D>(sides, 1.0);
  for (const HalfSpace& side : sides) CHECK(dot(side.n, x) <= side.reach + 1e-10);
  CHECK(x[D - 1] == Approx(lowest_corner<D>(sides, 1.0)).margin(1e-8));
}

template <int D>
Vec3 center_between(const Cell& cell, const Mover& mover, RandomStream& random) {
  Vec3 center{};
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double margin = cell.periodic[axis] ? 0.0 : mover.half_extents[axis] + 1e-6;
    center[axis] = random.uniform(margin, cell.size[axis] - margin);
  }
  return center;
}

template <int D>
double least_gap(const Cell& cell, const std::vector<Body>& bodies,
                 const std::vector<Vec3>& centers, const Body& body, const Vec3& center) {
  double least = 1e300;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    for (int x = cell.periodic[0] ? -1 : 0; x <= (cell.periodic[0] ? 1 : 0); ++x) {
      const Vec3 r = centers[k] + image_shift(cell, {x, 0, 0}) - center;
      least = std::min(least, gap(body, bodies[k], r).value);
    }
  }
  return least;
}

// Bodies let down one after the other; each ends apart from all others and where it cannot sink.
template <int D>
void let_down(ShapeKind shape, double min_gap, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  Cell cell{D, {6.0, 6.0, 6.0}, {true, false, false}};
  cell.size[D - 1] = 60.0;
  if (D == 2) cell.size.z = 0.0;
  Settling<D> settling(cell, min_gap, 1e-10, 20);
  typename Settling<D>::Workspace work;
  std::vector<Body> bodies;
  std::vector<Vec3> centers;
  double top = 0.0;
  for (int k = 0; k < 20; ++k) {
    const Body body =
        test::random_body(shape, random, [&] { return 0.2 * std::pow(5.0, random.uniform()); });
    const Mover mover(body);
    Vec3 center = center_between<D>(cell, mover, random);
    center[D - 1] = top + min_gap + mover.half_extents[D - 1] + 0.1;
    REQUIRE(settling.settle(mover, center, kNowhere, work) == Settling<D>::Outcome::rests);
    REQUIRE(settling.is_clear(mover, center, work));
    CHECK(least_gap<D>(cell, bodies, centers, body, center) > min_gap);
    CHECK(center[D - 1] > mover.half_extents[D - 1]);
    Vec3 lower = center;
    lower[D - 1] -= 1e-6;
    const bool held = lower[D - 1] < mover.half_extents[D - 1] ||
                      least_gap<D>(cell, bodies, centers, body, lower) < min_gap + 1e-6;
    CHECK(held);
    const Vec3 stands = wrapped(cell, center);
    settling.add(mover, stands);
    bodies.push_back(body);
    centers.push_back(stands);
    top = std::max(top, stands[D - 1] + mover.half_extents[D - 1]);
  }
}

}  // namespace

TEST_CASE("flat_gap agrees with the proven gap of ellipses that are apart, and is never above it") {
  RandomStream random(1, StreamId::test);
  for (int k = 0; k < 4000; ++k) {
    const Body a = random_ellipse(random), b = random_ellipse(random);
    const double angle = random.uniform(0.0, 6.28);
    const double apart = random.uniform(0.0, 1.3) * (circum_radius(a) + circum_radius(b));
    const Vec3 r{apart * std::cos(angle), apart * std::sin(angle), 0.0};
    const Gap proven = gap(a, b, r);
    const PosedBody of_a = posed_body(a), of_b = posed_body(b);
    Vec3 d = first_direction(of_a, of_b, r);
    const double bound = flat_gap(of_a, of_b, r, 1e300, 30, d);
    const double rounding = proven.error + 1e-12;
    CHECK(norm(d) == Approx(1.0).epsilon(1e-14));
    CHECK(bound <= proven.value + rounding);
    if (proven.value > 0.0) CHECK(bound == Approx(proven.value).margin(1e-9));
  }
}

TEST_CASE("solid_gap agrees with the proven gap of ellipsoids, and is never above it") {
  RandomStream random(2, StreamId::test);
  int steps_left = 0;
  for (int k = 0; k < 4000; ++k) {
    const Body a = random_ellipsoid(random), b = random_ellipsoid(random);
    const double apart = random.uniform(0.0, 1.3) * (circum_radius(a) + circum_radius(b));
    const Vec3 r = apart * random_direction(random);
    const Gap proven = gap(a, b, r);
    const double rounding = proven.error + 1e-12;
    const SolidEllipsoid of_a(posed_body(a)), of_b(posed_body(b));
    // Any direction gives a bound, also one that has not come to the end.
    Vec3 d = first_direction(of_a, of_b, r);
    for (const int steps : {0, 1, 30}) {
      const double bound = solid_gap(of_a, of_b, r, kNowhere, steps, d);
      CHECK(norm(d) == Approx(1.0).epsilon(1e-14));
      CHECK(bound <= proven.value + rounding);
      if (steps == 30 && proven.value > 0.0) {
        CHECK(bound == Approx(proven.value).margin(1e-9));
      }
    }
    // Where less is asked for, it ends at once.
    Vec3 first = first_direction(of_a, of_b, r);
    if (solid_gap(of_a, of_b, r, -kNowhere, 30, first) < proven.value - 1e-6) ++steps_left;
  }
  CHECK(steps_left > 100);
}

TEST_CASE("solid_gap of flat and long ellipsoids, and of balls") {
  RandomStream random(3, StreamId::test);
  for (int k = 0; k < 500; ++k) {
    const Body disc = Ellipsoid{{1.0, 1.0, 0.005}, random_rotation(random)};
    const Body needle = Ellipsoid{{0.005, 0.005, 1.0}, random_rotation(random)};
    const Vec3 r = random.uniform(0.5, 2.5) * random_direction(random);
    const Gap proven = gap(disc, needle, r);
    if (!(proven.value > 0.0)) continue;
    const SolidEllipsoid a(posed_body(disc)), b(posed_body(needle));
    Vec3 d = first_direction(a, b, r);
    CHECK(solid_gap(a, b, r, kNowhere, 60, d) == Approx(proven.value).margin(1e-8));
  }
  const SolidEllipsoid ball(posed_body(Sphere{1.0}));
  Vec3 d = first_direction(ball, ball, {0.0, 3.0, 0.0});
  CHECK(solid_gap(ball, ball, {0.0, 3.0, 0.0}, kNowhere, 5, d) == Approx(1.0).epsilon(1e-14));
  CHECK(first_direction(ball, ball, {}) == Vec3{0, 0, 1});
}

TEST_CASE("lowest_point finds the lowest corner, as trying all of them does") {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    compare_programs<2>(seed);
    compare_programs<3>(seed);
  }
}

TEST_CASE("lowest_point keeps to the box and to level sides") {
  CHECK(lowest_point<2>({}, 0.5) == Vec3{0.0, -0.5, 0.0});
  CHECK(lowest_point<3>({}, 0.5) == Vec3{0.0, 0.0, -0.5});
  const std::vector<HalfSpace> floor{{{0, -1, 0}, 0.25}};
  CHECK(lowest_point<2>(floor, 0.5).y == Approx(-0.25));
  const std::vector<HalfSpace> below{{{0, 0, -1}, 0.0}};
  CHECK(lowest_point<3>(below, 0.5).z == Approx(0.0).margin(1e-14));
}

TEST_CASE("Settling: bodies of every shape come to rest, apart by the least gap") {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    let_down<2>(ShapeKind::ellipse, 0.0, seed);
    let_down<2>(ShapeKind::disk, 0.03, seed);
    let_down<3>(ShapeKind::ellipsoid, 0.0, seed);
    let_down<3>(ShapeKind::cylinder, 0.05, seed);
    let_down<3>(ShapeKind::spherocylinder, 0.0, seed);
  }
}

TEST_CASE("Settling takes a body out of what it overlaps a little, not out of its middle") {
  const Cell cell = cell_2d(10.0, 10.0, true, false);
  Settling<2> settling(cell, 0.0, 1e-10, 2);
  Settling<2>::Workspace work;
  const Mover disk(Disk{1.0});
  settling.add(disk, {5.0, 1.0, 0.0});
  settling.add(disk, {7.5, 1.0, 0.0});
  Vec3 center{6.0, 2.3, 0.0};
  REQUIRE_FALSE(settling.is_clear(disk, center, work));
  REQUIRE(settling.settle(disk, center, kNowhere, work) == Settling<2>::Outcome::rests);
  CHECK(settling.is_clear(disk, center, work));
  CHECK(center.x == Approx(6.25));
  CHECK(center.y == Approx(1.0 + std::sqrt(4.0 - 1.25 * 1.25)));
  Vec3 inside{5.0, 1.0, 0.0};
  CHECK(settling.settle(disk, inside, kNowhere, work) == Settling<2>::Outcome::overlaps);
}

TEST_CASE("Settling gives a body up that comes down too slowly to end below a known height") {
  const Cell cell = cell_2d(10.0, 10.0, true, false);
  Settling<2> settling(cell, 0.0, 1e-10, 1);
  Settling<2>::Workspace work;
  const Mover disk(Disk{1.0});
  settling.add(disk, {5.0, 1.0, 0.0});
  Vec3 center{5.01, 3.1, 0.0};
  CHECK(settling.settle(disk, center, 0.5, work) == Settling<2>::Outcome::lags);
  Vec3 again{5.01, 3.1, 0.0};
  CHECK(settling.settle(disk, again, kNowhere, work) == Settling<2>::Outcome::rests);
  CHECK(again.y == Approx(1.0));
}

TEST_CASE("Settling comes to the same place whatever its workspace was used for before") {
  RandomStream random(4, StreamId::test);
  const Cell cell{3, {6.0, 6.0, 60.0}, {true, true, false}};
  Settling<3> settling(cell, 0.0, 1e-10, 10);
  for (int k = 0; k < 10; ++k) {
    const Vec3 center{random.uniform(0.0, 6.0), random.uniform(0.0, 6.0), 2.0 + k};
    settling.add(Mover(Ellipsoid{{1.0, 0.5, 0.3}, random_rotation(random)}), center);
  }
  Settling<3>::Workspace used;
  for (int k = 0; k < 20; ++k) {
    const Mover mover(random_ellipsoid(random));
    const Vec3 start{random.uniform(0.0, 6.0), random.uniform(0.0, 6.0), 12.0};
    Settling<3>::Workspace fresh;
    Vec3 center = start, again = start;
    const auto outcome = settling.settle(mover, center, kNowhere, fresh);
    CHECK(settling.settle(mover, again, kNowhere, used) == outcome);
    CHECK(again == center);
  }
}

}  // namespace packstone::advancing_layer
