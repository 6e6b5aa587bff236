#include "packstone/tessellate/laguerre.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"
#include "scenes.hpp"
#include "tessellate/laguerre/grains.hpp"
#include "tessellate/laguerre/interfaces.hpp"
#include "tessellate/laguerre/laplacian.hpp"
#include "tessellate/laguerre/shape_step.hpp"
#include "tessellate/laguerre/transport.hpp"

using namespace packstone;
using std::numbers::pi;

namespace {

// n x n bodies, each somewhere in its own square and turned at random.
template <class MakeBody>
Packing scattered(int n, const std::array<bool, 2>& periodic, const MakeBody& make) {
  RandomStream random(5, StreamId::test, 0);
  Packing packing{cell_2d(1, 1, periodic[0], periodic[1]), {"grains"}, {}, {}, {}};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Body body = make(random, 0.5 / n);
      const double slack = 0.5 / n - std::get<Ellipse>(body).semi_axes.x;
      const Vec3 center{(i + 0.5) / n + slack * random.uniform(-1, 1),
                        (j + 0.5) / n + slack * random.uniform(-1, 1), 0};
      packing.inclusions.push_back({center, body, 0});
    }
  }
  return packing;
}

Packing ellipses(int n, double aspect, const std::array<bool, 2>& periodic = {true, true}) {
  return scattered(n, periodic, [=](RandomStream& random, double room) {
    const double a = room * random.uniform(0.6, 0.95);
    return Body{Ellipse{{a, a / aspect}, random.uniform(-pi, pi)}};
  });
}

double total(const std::vector<CellShape>& shapes) {
  CompensatedSum sum;
  for (const CellShape& shape : shapes) sum.add(shape.measure);
  return sum.value();
}

// Sites of a packing, as laguerre_tessellate() makes them without inflation.
std::vector<laguerre::Site> plain_sites(const Packing& packing) {
  return laguerre::sites_of(packing.cell, laguerre::grains_of(packing, 1.0), 0.5);
}

std::vector<Vec3> centers(const Packing& packing) {
  return laguerre::centers_of(laguerre::grains_of(packing, 1.0));
}

}  // namespace

TEST_CASE("the couplings are the derivatives of the measures by the weights") {
  for (const Packing& packing : {ellipses(5, 2.0), scenes::jostled_ellipsoids(30, 0.4, 3)}) {
    const std::size_t count = packing.inclusions.size();
    const auto sites = plain_sites(packing);
    const auto at = centers(packing);
    const auto sums = laguerre::cell_sums(packing.cell, sites, at, 1);
    const double size =
        std::pow(volume(packing.cell) / static_cast<double>(count), 2.0 / packing.cell.dimension);
    const double step = 1e-5 * size;
    for (const std::int32_t of : {0, 7, 20}) {
      const auto moved = [&](double by) {
        auto shifted = sites;
        for (laguerre::Site& site : shifted) site.weight += site.owner == of ? by : 0.0;
        return laguerre::cell_sums(packing.cell, shifted, at, 1);
      };
      const auto up = moved(step), down = moved(-step);
      std::vector<double> exact(count, 0.0);
      for (const laguerre::Coupling& c : sums.couplings) {
        if (c.a != of && c.b != of) continue;
        exact[static_cast<std::size_t>(of)] += c.value;
        exact[static_cast<std::size_t>(c.a == of ? c.b : c.a)] -= c.value;
      }
      const double scale = exact[static_cast<std::size_t>(of)];
      for (std::size_t g = 0; g < count; ++g) {
        const double slope = (up.cells[g].measure - down.cells[g].measure) / (2.0 * step);
        CHECK(std::abs(slope - exact[g]) < 1e-4 * scale);
      }
    }
  }
}

TEST_CASE("solve_laplacian solves in the plane and in space") {
  RandomStream random(9, StreamId::test, 0);
  std::vector<laguerre::Coupling> couplings;
  std::vector<double> x(60);
  for (double& value : x) value = random.uniform(-1, 1);
  for (std::int32_t a = 0; a < 60; ++a) {
    for (std::int32_t b = a + 1; b < std::min(60, a + 5); ++b) {
      couplings.push_back({a, b, random.uniform(0.1, 2.0)});
    }
  }
  std::vector<double> right(60, 0.0);
  for (const auto& c : couplings) {
    const double flow =
        c.value * (x[static_cast<std::size_t>(c.a)] - x[static_cast<std::size_t>(c.b)]);
    right[static_cast<std::size_t>(c.a)] += flow;
    right[static_cast<std::size_t>(c.b)] -= flow;
  }
  for (const int dimension : {2, 3}) {
    const auto found = laguerre::solve_laplacian(couplings, right, dimension);
    for (std::size_t k = 0; k < 60; ++k) CHECK(found[k] == Approx(x[k] - x[0]).margin(1e-7));
  }
}

TEST_CASE("cell_sums agrees with the moments of the cells as polygons and polyhedra") {
  for (const Packing& packing : {ellipses(6, 3.0), scenes::jostled_ellipsoids(30, 0.4, 3)}) {
    const LaguerreResult result = laguerre_tessellate(packing, published_laguerre());
    const auto at = centers(packing);
    const auto sums = laguerre::cell_sums(packing.cell, plain_sites(packing), at, 1);
    for (std::size_t g = 0; g < at.size(); ++g) {
      const auto& cell = sums.cells[g];
      const CellShape& shape = result.shapes[g];
      CHECK(cell.measure == Approx(shape.measure));
      CHECK(norm(at[g] + cell.first / cell.measure - shape.centroid) < 1e-12);
      const Vec3 off = cell.first / cell.measure;
      const CellShape again = shape_of_moments(packing.cell.dimension, cell.measure, at[g] + off,
                                               cell.second - cell.measure * dyad(off));
      CHECK(again.aspect == Approx(shape.aspect));
      CHECK(angle_between_shapes(packing.cell.dimension, again, shape) < 1e-6);
    }
  }
}

TEST_CASE("measures become exactly proportional to those ordered") {
  for (const double aspect : {1.0, 2.0, 4.0}) {
    const Packing packing = ellipses(12, aspect);
    const LaguerreResult result = laguerre_tessellate(packing);
    CHECK(result.stop == LaguerreStop::finished);
    CHECK_NOTHROW(check_well_formed(result.tessellation));
    CHECK(std::abs(total(result.shapes) - 1.0) < 1e-12);
    CHECK(result.report.made.largest_measure_error < 1e-8);
    CHECK(result.report.published.measure_spread > 0.05);
    CHECK(result.report.made.in_parts == 0);
    const double phi = fraction(packing);
    for (std::size_t g = 0; g < result.shapes.size(); ++g) {
      CHECK(result.shapes[g].measure * phi ==
            Approx(volume(packing.inclusions[g].body)).epsilon(1e-8));
    }
  }
}

TEST_CASE("measures in space become exactly proportional to those ordered") {
  const Packing packing = scenes::jostled_ellipsoids(60, 0.45, 4);
  const LaguerreResult result = laguerre_tessellate(packing);
  CHECK(result.stop == LaguerreStop::finished);
  CHECK_NOTHROW(check_well_formed(result.tessellation));
  CHECK(std::abs(total(result.shapes) - 1.0) < 1e-12);
  CHECK(result.report.made.largest_measure_error < 1e-8);
}

TEST_CASE("every shape in space can be tessellated") {
  RandomStream random(6, StreamId::test, 0);
  Packing packing{Cell{}, {"all"}, {}, {}, {}};
  for (int k = 0; k < 27; ++k) {
    const Vec3 center{(k % 3 + 0.5) / 3, (k / 3 % 3 + 0.5) / 3, (k / 9 + 0.5) / 3};
    const Vec3 axis = random_direction(random);
    const Body bodies[] = {Sphere{0.12}, Ellipsoid{{0.15, 0.1, 0.06}, random_rotation(random)},
                           Cylinder{0.07, 0.12, axis}, Spherocylinder{0.05, 0.09, axis}};
    packing.inclusions.push_back({center, bodies[k % 4], 0});
  }
  for (const int rounds : {0, 2}) {
    const LaguerreResult result =
        laguerre_tessellate(packing, {.spacing = 0.8, .shape_rounds = rounds});
    CHECK(result.stop == LaguerreStop::finished);
    CHECK_NOTHROW(check_well_formed(result.tessellation));
    CHECK(result.report.made.largest_measure_error < 1e-8);
    CHECK(result.report.made.empty == 0);
  }
}

TEST_CASE("rounds bring the shapes of cells nearer to those ordered") {
  for (const bool connected : {true, false}) {
    const Packing packing = ellipses(12, 2.0);
    const LaguerreErrors before = laguerre_tessellate(packing).report.made;
    const LaguerreResult result =
        laguerre_tessellate(packing, {.connected = connected, .shape_rounds = 10});
    const LaguerreErrors& after = result.report.made;
    CHECK_NOTHROW(check_well_formed(result.tessellation));
    CHECK(after.largest_measure_error < 1e-8);
    CHECK(after.elongated == 144);
    CHECK(std::abs(after.aspect_mean - 1.0) < 0.1);
    CHECK(after.aspect_spread < 0.7 * before.aspect_spread);
    CHECK(after.angle_mean < 0.4 * before.angle_mean);
    CHECK(after.offset_mean < 1.0);
    CHECK((!connected || after.in_parts == 0));
  }
}

TEST_CASE("rounds leave measures alone where these are not ordered") {
  const Packing packing = ellipses(10, 2.0);
  const LaguerreErrors without =
      laguerre_tessellate(packing, {.ordered_measures = false}).report.made;
  const LaguerreErrors with =
      laguerre_tessellate(packing, {.ordered_measures = false, .shape_rounds = 6}).report.made;
  CHECK(with.angle_mean < 0.6 * without.angle_mean);
  CHECK(with.measure_spread > 0.01);
}

TEST_CASE("steps converge as Newton's method where nothing stands in their way") {
  const Packing packing = ellipses(5, 1.3);
  const auto at = centers(packing);
  auto sites = plain_sites(packing);
  laguerre::ShapeGoal goal;
  for (const Inclusion& inclusion : packing.inclusions) {
    goal.shapes.push_back(shape_of_body(inclusion.body));
    goal.measures.push_back(volume(inclusion.body) / fraction(packing));
  }
  const auto sums = [&] { return laguerre::cell_sums(packing.cell, sites, at, 1); };
  const auto misfit = [&] {
    const auto now = sums();
    double sum = 0.0;
    for (std::size_t g = 0; g < at.size(); ++g) {
      for (const double r :
           laguerre::shape_residual(goal.shapes[g], goal.measures[g], now.cells[g])) {
        sum += r * r;
      }
    }
    return std::sqrt(sum / static_cast<double>(at.size()));
  };
  const double first = misfit();
  for (double damping = 1.0; damping > 1e-4; damping *= 0.5) {
    shape_step(packing.cell, goal, at, sums(), interfaces_of(packing.cell, sites, 1), damping,
               sites);
  }
  CHECK(first > 0.1);
  CHECK(misfit() < 1e-4 * first);
}

TEST_CASE("cells at walls keep what they are found with, or do not") {
  const Packing packing = ellipses(10, 2.0, {true, false});
  const LaguerreResult kept = laguerre_tessellate(packing);
  CHECK(kept.stop == LaguerreStop::finished);
  CHECK(kept.report.made.cells < 100);
  CHECK(kept.report.made.cells >= 60);
  CHECK(kept.report.made.largest_measure_error < 1e-6);
  CHECK(std::abs(total(kept.shapes) - 1.0) < 1e-12);
  const LaguerreResult all = laguerre_tessellate(packing, {.keep_wall_cells = false});
  const double phi = fraction(packing);
  for (std::size_t g = 0; g < all.shapes.size(); ++g) {
    CHECK(all.shapes[g].measure * phi == Approx(volume(packing.inclusions[g].body)).epsilon(1e-8));
  }
}

TEST_CASE("cells that come to a wall as bodies grow count as any other") {
  // Growth by the fraction moves cells to walls and away from them.
  Packing packing;
  packing.cell = cell_2d(1, 1, false, false);
  packing.groups = {"grains"};
  RandomStream random(3, StreamId::test, 0);
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; j < 12; ++j) {
      const Vec3 at{(k + random.uniform(0.05, 0.95)) / 12, (j + random.uniform(0.05, 0.95)) / 12,
                    0.0};
      packing.inclusions.push_back({at, Disk{random.uniform(0.003, 0.03)}, 0});
    }
  }
  const auto cells_at_walls = [&](const LaguerreOptions& options) {
    std::set<std::int32_t> at_wall;
    for (const Facet& facet : laguerre_tessellate(packing, options).tessellation.facets) {
      if (facet.outer == Facet::kWall) at_wall.insert(facet.inner);
    }
    return at_wall;
  };
  REQUIRE(cells_at_walls(published_laguerre()) != cells_at_walls({.ordered_measures = false}));
  const LaguerreReport report = laguerre_tessellate(packing).report;
  CHECK(report.made.cells == report.published.cells);
  CHECK(report.made.largest_measure_error < 1e-6);
  CHECK(report.published.largest_measure_error > 0.1);
}

TEST_CASE("a single grain fills the box") {
  const Packing packing = ellipses(1, 2.0);
  const LaguerreResult result = laguerre_tessellate(packing, {.shape_rounds = 2});
  CHECK(result.stop == LaguerreStop::finished);
  CHECK(result.shapes[0].measure == Approx(1.0));
}

TEST_CASE("transport finds weights also where cells are empty at first") {
  RandomStream random(8, StreamId::test, 0);
  for (const int dimension : {2, 3}) {
    Cell box = dimension == 2 ? cell_2d(1, 1) : Cell{};
    std::vector<laguerre::Site> sites;
    std::vector<Vec3> at;
    for (std::int32_t g = 0; g < 300; ++g) {
      at.push_back({random.uniform(0, 1), random.uniform(0, 1),
                    dimension == 3 ? random.uniform(0, 1) : 0.0});
      const double weight = (g % 7 == 0 ? 3.0 : 0.1) * std::pow(1.0 / 300, 2.0 / dimension);
      sites.push_back(laguerre::wrapped_site(box, at.back(), weight, g));
    }
    CHECK(laguerre::cell_sums(box, sites, at, 1).hidden > 0);
    std::vector<double> targets(300, 1.0 / 300);
    const auto outcome = laguerre::transport(box, sites, at, targets, {}, {});
    CHECK(outcome.reached);
    CHECK(outcome.error <= 1e-9);
    CHECK(outcome.steps < 20);
  }
}

TEST_CASE("log_shape and body_of_log_shape are each other's inverse") {
  RandomStream random(10, StreamId::test, 0);
  for (int k = 0; k < 100; ++k) {
    const double a = random.uniform(1, 4), b = random.uniform(1, 4), c = random.uniform(1, 4);
    const Body bodies[] = {Ellipse{{a, b}, random.uniform(-3, 3)},
                           Ellipsoid{{a, b, c}, random_rotation(random)}};
    for (const Body& body : bodies) {
      const int d = dimension(kind(body));
      const CellShape shape = shape_of_body(body);
      const CellShape back = shape_of_body(
          laguerre::body_of_log_shape(d, volume(body), laguerre::log_shape(d, shape)));
      CHECK(norm(back.semi_axes - shape.semi_axes) < 1e-12);
      CHECK(angle_between_shapes(d, shape, back) < 1e-6);
    }
  }
}

TEST_CASE("laguerre_tessellate gives the same bits for any number of threads") {
  for (const Packing& packing : {ellipses(20, 3.0), scenes::jostled_ellipsoids(60, 0.4, 3)}) {
    const auto make = [&](int threads) {
      return laguerre_tessellate(packing, {.spacing = 0.8, .shape_rounds = 1},
                                 RunContext{}.threads(threads));
    };
    const LaguerreResult one = make(1), two = make(2);
    CHECK(one.tessellation.vertices == two.tessellation.vertices);
    CHECK(one.tessellation.corners == two.tessellation.corners);
    CHECK(one.tessellation.facets == two.tessellation.facets);
  }
}

TEST_CASE("laguerre_tessellate stops when asked, with a tessellation all the same") {
  const std::atomic<bool> stop{true};
  const LaguerreResult result =
      laguerre_tessellate(ellipses(8, 2.0), {.shape_rounds = 5}, RunContext{}.cancel_flag(&stop));
  CHECK(result.stop == LaguerreStop::cancelled);
  CHECK_NOTHROW(check_well_formed(result.tessellation));
  CHECK(std::abs(total(result.shapes) - 1.0) < 1e-12);
  const LaguerreResult late =
      laguerre_tessellate(ellipses(8, 2.0), {}, RunContext{}.time_limit(0.0));
  CHECK(late.stop == LaguerreStop::out_of_time);
}

TEST_CASE("laguerre_tessellate names the option that is out of range") {
  const Packing packing = ellipses(3, 2.0);
  const auto refused = [&](const LaguerreOptions& options, const std::string& name) {
    CHECK_THROWS_WITH(laguerre_tessellate(packing, options), Catch::Contains(name));
  };
  refused({.spacing = 0.0}, "spacing");
  refused({.measure_tolerance = 0.0}, "measure_tolerance");
  refused({.max_newton_steps = 0}, "max_newton_steps");
  refused({.shape_rounds = -1}, "shape_rounds");
  refused({.shape_gain = 2.0}, "shape_gain");
  refused({.center_gain = 1.5}, "center_gain");
  Packing empty = packing;
  empty.inclusions.clear();
  CHECK_THROWS_AS(laguerre_tessellate(empty), InvalidArgument);
}
