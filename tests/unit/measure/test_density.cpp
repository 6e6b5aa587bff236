#include "packstone/measure/density.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "constructive_scenes.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/standing.hpp"
#include "scenes.hpp"
#include "support/oracle.hpp"
#include "support/random_body.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

Packing packing_of(const Cell& cell) { return {cell, {"bodies"}, {}, {}, {}}; }

// Disks of diameter 1 on a square lattice: `columns` by `rows`, the lowest left one at `corner`.
Packing square_lattice(const Cell& cell, int columns, int rows, const Vec3& corner) {
  Packing packing = packing_of(cell);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      packing.inclusions.push_back({corner + Vec3{x + 0.5, y + 0.5, 0}, Disk{0.5}, 0});
    }
  }
  return packing;
}

// Bodies of all shapes anywhere between the walls; they overlap, and both count where they do.
Packing random_bodies(const Cell& cell, int count, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  Packing packing = packing_of(cell);
  for (int k = 0; k < count; ++k) {
    const ShapeKind shape = test::random_shape(cell.dimension, random);
    const Body body = test::random_body(shape, random, [&] { return random.uniform(0.02, 0.12); });
    const CenterBox box = centers_inside_walls(cell, half_extents(body));
    packing.inclusions.push_back(
        {{random.uniform(box.lo.x, box.hi.x), random.uniform(box.lo.y, box.hi.y),
          random.uniform(box.lo.z, box.hi.z)},
         body,
         0});
  }
  return packing;
}

const Cell kCells[] = {
    cell_2d(1.0, 1.5, true, false),        cell_2d(1.2, 1.0, true, true),
    cell_2d(1.0, 1.1, false, false),       {3, {1, 1.2, 1.5}, {true, true, false}},
    {3, {1.1, 1, 1}, {true, true, true}},  {3, {1, 1, 1.3}, {false, true, false}},
    {3, {1, 1.2, 1}, {false, false, true}}};

// Margins that leave a window in them.
const DensityOptions kThin{.wall_margin = 0.15, .top_margin = 0.2, .bin_width = 0.09};

double volume_of(const Window& window, int dimension) {
  const Vec3 edges = window.hi - window.lo;
  return dimension == 2 ? edges.x * edges.y : edges.x * edges.y * edges.z;
}

// How many bodies hold the point, over all images that come near.
int bodies_at(const Packing& packing, const Vec3& point) {
  const Cell& cell = packing.cell;
  const auto images = [&](std::size_t a) { return cell.periodic[a] ? 1 : 0; };
  int bodies = 0;
  for (const Inclusion& inclusion : packing.inclusions) {
    for (int x = -images(0); x <= images(0); ++x) {
      for (int y = -images(1); y <= images(1); ++y) {
        for (int z = -images(2); z <= images(2); ++z) {
          const Vec3 r = point - inclusion.center - image_shift(cell, {x, y, z});
          if (norm(r) > circum_radius(inclusion.body)) continue;
          bodies += oracle::gauge(inclusion.body, r) <= 1.0 ? 1 : 0;
        }
      }
    }
  }
  return bodies;
}

struct Estimate {
  double mean = 0.0;
  double deviation = 0.0;
};

Estimate sampled_fraction(const Packing& packing, const Window& window, int points) {
  RandomStream random(9, StreamId::test);
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < points; ++k) {
    Vec3 point;
    for (std::size_t a = 0; a < static_cast<std::size_t>(packing.cell.dimension); ++a) {
      point[a] = random.uniform(window.lo[a], window.hi[a]);
    }
    const int bodies = bodies_at(packing, wrapped(packing.cell, point));
    sum += bodies;
    squares += bodies * bodies;
  }
  const double mean = sum / points;
  return {mean, std::sqrt((squares / points - mean * mean) / points)};
}

const BoundaryDeficit& deficit_of(const DensityReport& report, Boundary boundary, int axis,
                                  double position) {
  return *std::find_if(
      report.deficits.begin(), report.deficits.end(), [&](const BoundaryDeficit& d) {
        return d.boundary == boundary && d.axis == axis && std::abs(d.position - position) < 1e-12;
      });
}

TEST_CASE("one disk: fractions of the cell and below its top, and no interior") {
  Packing packing = packing_of(cell_2d(4, 5, true, false));
  packing.inclusions.push_back({{3.9, 1.5, 0}, Disk{1.0}, 0});
  const DensityReport report = measure_density(packing);
  CHECK(report.count == 1);
  CHECK(report.largest_half_width == 1.0);
  CHECK(report.fraction == Approx(pi / 20.0).epsilon(1e-15));
  CHECK(report.top == 2.5);
  CHECK(*report.fraction_below_top == Approx(pi / 10.0).epsilon(1e-15));
  CHECK_FALSE(report.interior);
  CHECK(report.why_no_interior ==
        "the packing is too small: along y a window that keeps the margins would reach from 2 to "
        "-1.5");
  CHECK(report.deficits.empty());
  CHECK(report.profiles[1].window.empty());
}

TEST_CASE("the profile of one disk holds its segments, wrapped over the period") {
  Packing packing = packing_of(cell_2d(4, 5, true, false));
  packing.inclusions.push_back({{3.9, 1.5, 0}, Disk{1.0}, 0});
  const DensityReport report = measure_density(packing, {.bin_width = 0.5});
  const DensityProfile& x = report.profiles[0];
  REQUIRE(x.edges.size() == 9);
  const auto part = [](double t) { return std::asin(t) + t * std::sqrt(1.0 - t * t) + pi / 2.0; };
  CHECK(x.whole[0] == Approx((part(0.6) - part(0.1)) / 2.5).epsilon(1e-13));
  CHECK(x.whole[1] == Approx((pi - part(0.6)) / 2.5).epsilon(1e-13));
  CHECK(x.whole[5] == Approx(part(-0.9) / 2.5).epsilon(1e-12));
  CHECK(x.whole[3] == 0.0);
  const DensityProfile& y = report.profiles[1];
  CHECK(y.edges.back() == 5.0);
  CHECK(y.edges[5] == 2.5);
  CHECK(y.edges.size() == 7);
  CHECK(y.whole[0] == 0.0);
  CHECK(y.whole[1] == Approx(part(-0.5) / 2.0).epsilon(1e-13));
  CHECK(y.whole[5] == 0.0);
}

TEST_CASE("an upright cylinder fills every slab that it crosses alike") {
  Packing packing = packing_of({3, {1, 1, 1}, {true, true, false}});
  packing.inclusions.push_back({{0.9, 0.1, 0.5}, Cylinder{0.4, 0.25, {0, 0, 1}}, 0});
  const DensityReport report = measure_density(packing, {.bin_width = 0.05});
  const DensityProfile& z = report.profiles[2];
  CHECK(report.top == 0.75);
  for (std::size_t i = 0; i + 1 < z.edges.size(); ++i) {
    const double middle = 0.5 * (z.edges[i] + z.edges[i + 1]);
    CAPTURE(middle);
    CHECK(z.whole[i] == Approx(middle > 0.25 && middle < 0.75 ? 0.16 * pi : 0.0).margin(1e-14));
  }
}

TEST_CASE("a lattice away from the floor: what is missing is the empty layer") {
  // Rows from 0.3 to 20.3, in a window from 1.3 to 18.3.
  const Packing packing = square_lattice(cell_2d(10, 25, true, false), 10, 20, {0.2, 0.3, 0});
  const DensityReport report = measure_density(packing, {.wall_margin = 1.3});
  REQUIRE(report.interior);
  CHECK(report.interior->window.lo.y == 1.3);
  CHECK(report.interior->window.hi.y == Approx(18.3).epsilon(1e-15));
  CHECK(report.interior->fraction.value == Approx(pi / 4.0).epsilon(1e-13));
  CHECK(report.interior->fraction.error < 1e-10);
  REQUIRE(report.deficits.size() == 3);
  CHECK(deficit_of(report, Boundary::floor, 1, 0.0).length ==
        Approx(0.3 * pi / 4.0).epsilon(1e-12));
  CHECK(deficit_of(report, Boundary::top, 1, 20.3).length == Approx(0.0).margin(1e-12));
  CHECK(deficit_of(report, Boundary::ceiling, 1, 25.0).length ==
        Approx(4.7 * pi / 4.0).epsilon(1e-12));
  // Within a row the integral rises and falls back to 0; a quarter of a row shows most of it.
  CHECK(deficit_of(report, Boundary::floor, 1, 0.0).spread > 0.03);
  CHECK(deficit_of(report, Boundary::floor, 1, 0.0).spread < 0.1);
}

TEST_CASE("walls along one axis do not count among the deficits along another") {
  // Empty layers of 1 at the left, 2 at the right, none at floor and ceiling.
  const Packing packing = square_lattice(cell_2d(15, 20, false, false), 12, 20, {1, 0, 0});
  const DensityReport report = measure_density(packing, {.wall_margin = 3.0, .top_margin = 3.0});
  const double phi = pi / 4.0;
  CHECK(report.interior->fraction.value == Approx(phi).epsilon(1e-13));
  REQUIRE(report.deficits.size() == 5);
  CHECK(deficit_of(report, Boundary::wall, 0, 0.0).length == Approx(phi).epsilon(1e-12));
  CHECK(deficit_of(report, Boundary::wall, 0, 15.0).length == Approx(2.0 * phi).epsilon(1e-12));
  CHECK(deficit_of(report, Boundary::floor, 1, 0.0).length == Approx(0.0).margin(1e-12));
  CHECK(deficit_of(report, Boundary::top, 1, 20.0).length == Approx(0.0).margin(1e-12));
  CHECK(deficit_of(report, Boundary::ceiling, 1, 20.0).length == Approx(0.0).margin(1e-12));
}

TEST_CASE("the column through the window is its fraction less the deficits of both ends") {
  for (const Cell& cell : kCells) {
    const DensityReport report = measure_density(random_bodies(cell, 150, 3), kThin);
    REQUIRE(report.interior);
    for (const DensityProfile& profile : report.profiles) {
      const auto axis = static_cast<std::size_t>(profile.axis);
      double column = 0.0, missing = 0.0;
      for (std::size_t i = 0; i < profile.window.size(); ++i) {
        column += profile.window[i] * (profile.edges[i + 1] - profile.edges[i]);
      }
      for (const BoundaryDeficit& deficit : report.deficits) {
        const bool ends_here = deficit.axis == profile.axis && deficit.boundary != Boundary::top;
        missing += ends_here ? deficit.length : 0.0;
      }
      CAPTURE(cell.dimension, axis);
      CHECK(column ==
            Approx(report.interior->fraction.value * cell.size[axis] - missing).margin(1e-8));
    }
  }
}

TEST_CASE("every slab holds what a window in its place holds") {
  for (const Cell& cell : kCells) {
    const Packing packing = random_bodies(cell, 80, 4);
    const DensityReport report = measure_density(packing, kThin);
    REQUIRE(report.interior);
    for (const DensityProfile& profile : report.profiles) {
      const auto axis = static_cast<std::size_t>(profile.axis);
      for (std::size_t i = 0; i < profile.window.size(); ++i) {
        Window slab{{}, cell.size};
        slab.lo[axis] = profile.edges[i];
        slab.hi[axis] = profile.edges[i + 1];
        CAPTURE(cell.dimension, axis, i);
        CHECK(profile.whole[i] == Approx(fraction_in_window(packing, slab).value).margin(1e-8));
        Window part = report.interior->window;
        part.lo[axis] = slab.lo[axis];
        part.hi[axis] = slab.hi[axis];
        CHECK(profile.window[i] == Approx(fraction_in_window(packing, part).value).margin(1e-8));
      }
    }
  }
}

TEST_CASE("the fraction in a window against random points") {
  for (const Cell& cell : kCells) {
    const Packing packing = random_bodies(cell, 60, 5);
    const DensityReport report = measure_density(packing, kThin);
    Window shifted = report.interior->window;
    for (std::size_t a = 0; a < 3; ++a) {
      if (!cell.periodic[a]) continue;
      shifted.lo[a] = -2.3 * cell.size[a];
      shifted.hi[a] = shifted.lo[a] + 0.4 * cell.size[a];
    }
    for (const Window& window : {report.interior->window, shifted}) {
      const Estimate estimate = sampled_fraction(packing, window, 20000);
      const WindowFraction measured = fraction_in_window(packing, window);
      CAPTURE(cell.dimension, estimate.deviation);
      CHECK(measured.value == Approx(estimate.mean).margin(4.5 * estimate.deviation));
      CHECK(measured.error < 1e-6);
    }
  }
}

TEST_CASE("the interior of a dense packing against random points, found by a neighbor search") {
  Packing packing = scenes::jostled_ellipsoids(4000, 0.5, 1);
  packing.cell.periodic = {true, false, false};
  std::erase_if(packing.inclusions, [&](const Inclusion& inclusion) {
    const double reach = half_extents(inclusion.body).z;
    return inclusion.center.z < reach || inclusion.center.z + reach > 1.0;
  });
  const double margin = 2.0 * circum_radius(packing.inclusions.front().body);
  const DensityReport report = measure_density(packing);
  REQUIRE(report.interior);
  // 2^18 points: deviation 0.001.
  CHECK(report.interior->fraction.value ==
        Approx(scenes::interior_fraction(packing, margin)).margin(0.004));
  CHECK(report.interior->fraction.value == Approx(0.5).margin(0.01));
}

TEST_CASE("windows that fill another one add up to it") {
  RandomStream random(6, StreamId::test);
  for (const Cell& cell : kCells) {
    const Packing packing = random_bodies(cell, 100, 6);
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
      const Window whole{0.1 * cell.size, 0.9 * cell.size};
      Window low = whole, high = whole;
      low.hi[axis] = high.lo[axis] = random.uniform(0.2, 0.8) * cell.size[axis];
      const auto held = [&](const Window& window) {
        return fraction_in_window(packing, window).value * volume_of(window, cell.dimension);
      };
      CHECK(held(low) + held(high) == Approx(held(whole)).margin(1e-9));
    }
  }
}

TEST_CASE("shifts along periodic axes change nothing but the profiles along them") {
  for (const Cell& cell : kCells) {
    const Packing packing = random_bodies(cell, 100, 7);
    Packing shifted = packing;
    Vec3 shift;
    for (std::size_t a = 0; a < 3; ++a) shift[a] = cell.periodic[a] ? 0.377 : 0.0;
    for (Inclusion& inclusion : shifted.inclusions) {
      inclusion.center = wrapped(cell, inclusion.center + shift);
    }
    const DensityReport a = measure_density(packing, kThin);
    const DensityReport b = measure_density(shifted, kThin);
    CHECK(b.interior->fraction.value == Approx(a.interior->fraction.value).epsilon(1e-8));
    CHECK(b.top == a.top);
    REQUIRE(a.deficits.size() == b.deficits.size());
    for (std::size_t i = 0; i < a.deficits.size(); ++i) {
      CHECK(b.deficits[i].length == Approx(a.deficits[i].length).margin(1e-8));
    }
  }
}

TEST_CASE("a fully periodic packing is all interior") {
  const Packing packing = random_bodies(kCells[4], 50, 8);
  const DensityReport report = measure_density(packing);
  CHECK_FALSE(report.top);
  CHECK_FALSE(report.fraction_below_top);
  CHECK(report.interior->window == Window{{}, packing.cell.size});
  CHECK(report.interior->fraction.value == Approx(report.fraction).epsilon(1e-14));
  CHECK(report.interior->fraction.error < 1e-14);
  CHECK(report.deficits.empty());
  for (const DensityProfile& profile : report.profiles) CHECK(profile.window == profile.whole);
}

TEST_CASE("bodies longer than a period are counted in full") {
  Packing packing = packing_of({3, {1, 1, 1}, {true, true, true}});
  packing.inclusions.push_back(
      {{0.2, 0.5, 0.9}, Spherocylinder{0.05, 2.2, normalized(Vec3{1, 0.1, 0.3})}, 0});
  const DensityReport report = measure_density(packing, {.bin_width = 0.1});
  for (const DensityProfile& profile : report.profiles) {
    double sum = 0.0;
    for (const double fraction : profile.whole) sum += fraction / 10.0;
    CHECK(sum == Approx(report.fraction).epsilon(1e-12));
  }
  CHECK(fraction_in_window(packing, {{0, 0, 0}, {0.5, 1, 1}}).value +
            fraction_in_window(packing, {{0.5, 0, 0}, {1, 1, 1}}).value ==
        Approx(2.0 * report.fraction).epsilon(1e-10));
}

TEST_CASE("a cell in which nothing stands") {
  const DensityReport report = measure_density(packing_of(cell_2d(1, 1, false, false)));
  CHECK(report.fraction == 0.0);
  CHECK_FALSE(report.top);
  CHECK(report.why_no_interior == "nothing stands in the cell");
  CHECK(report.profiles[0].whole == std::vector<double>{0.0});
}

TEST_CASE("the density report is the same for any number of threads") {
  const Packing packing = random_bodies(kCells[5], 3000, 10);
  const DensityReport one = measure_density(packing, kThin, RunContext().threads(1));
  for (const int threads : {2, 3, 8}) {
    CHECK(measure_density(packing, kThin, RunContext().threads(threads)) == one);
  }
}

TEST_CASE("what measure_density and fraction_in_window refuse is named with its range") {
  const Packing packing = random_bodies(kCells[0], 10, 11);
  const auto refusal = [&](const DensityOptions& options) {
    try {
      (void)measure_density(packing, options);
    } catch (const InvalidArgument& problem) {
      return std::string(problem.what());
    }
    return std::string("accepted");
  };
  CHECK(refusal({.wall_margin = -1.0}) ==
        "DensityOptions::wall_margin is -1; allowed are finite numbers >= 0");
  CHECK(refusal({.top_margin = std::nan("")}) ==
        "DensityOptions::top_margin is nan; allowed are finite numbers >= 0");
  CHECK(refusal({.bin_width = 0.0}) ==
        "DensityOptions::bin_width is 0; allowed are finite numbers >= 1.5e-06");
  CHECK(refusal({.wall_margin = 0.0, .top_margin = 0.0}) == "accepted");
  CHECK_THROWS_WITH(fraction_in_window(packing, {{0, 0.5, 0}, {1, 0.5, 0}}),
                    "window: along y it reaches from 0.5 to 0.5; allowed are finite numbers, the "
                    "second above the first");
  CHECK_THROWS_WITH(fraction_in_window(packing, {{0, -0.1, 0}, {1, 0.5, 0}}),
                    "window: along y it reaches from -0.1 to 0.5; allowed between the walls is "
                    "[0, 1.5]");
  CHECK_THROWS_WITH(fraction_in_window(packing, {{0, 0, 0}, {1.1, 0.5, 0}}),
                    "window: along x it reaches from 0 to 1.1; allowed is at most a period, 1");
  Packing bad = packing;
  bad.inclusions[3].group = 7;
  CHECK_THROWS_AS(measure_density(bad), InvalidArgument);
}

}  // namespace
}  // namespace packstone
