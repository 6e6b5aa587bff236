#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "generate/event_driven/engine.hpp"
#include "generate/event_driven/run_state.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "scenes.hpp"
#include "support/validation_seed.hpp"

namespace packstone {
namespace {

using event_driven::BlockCount;
using event_driven::Bodies;
using event_driven::Engine;

// N. F. Carnahan, K. E. Starling, J. Chem. Phys. 51 (1969) 635-636.
double carnahan_starling(double phi) {
  return (1.0 + phi + phi * phi - phi * phi * phi) / std::pow(1.0 - phi, 3);
}

EventDrivenResult in_equilibrium(const std::vector<OrderedBody>& bodies, double collisions,
                                 std::uint64_t seed) {
  return event_driven_pack(
      Cell{}, bodies,
      {.goal = EventDrivenGoal::equilibrium, .collisions_per_body = collisions, .seed = seed});
}

// A gas in the middle of its motion, at its full size.
MovingPacking moving_gas(const std::vector<OrderedBody>& bodies, std::uint64_t seed) {
  return in_equilibrium(bodies, 5.0, seed).state;
}

Vec3 momentum_of(const Bodies& bodies) {
  Vec3 sum;
  for (const auto& flight : bodies.flight) sum += flight.velocity;
  return sum;
}

std::vector<OrderedBody> scalene_bodies(int count, double fraction, std::uint64_t seed) {
  std::vector<OrderedBody> bodies = scenes::equal_ellipsoids(count, fraction, 1.0, seed);
  for (OrderedBody& b : bodies) {
    auto& ellipsoid = std::get<Ellipsoid>(b.body);
    ellipsoid.semi_axes = scale(ellipsoid.semi_axes, {1.5, 1.0, 1.0 / 1.5});
  }
  return bodies;
}

// Runs back to where it came from; the farthest that any center or axis then is from there.
double return_error(const std::vector<OrderedBody>& bodies, std::int64_t collisions) {
  const MovingPacking start = moving_gas(bodies, 5);
  Bodies moving = event_driven::bodies_of(start, {});
  const Bodies before = moving;
  RunContext run;
  const double never = std::numeric_limits<double>::infinity();
  const BlockCount out =
      Engine(moving, start.packing.cell).run_block({collisions, never}, run, false);
  REQUIRE(out.collisions == collisions);
  for (std::size_t k = 0; k < moving.flight.size(); ++k) {
    moving.flight[k].velocity = -moving.flight[k].velocity;
    moving.set_angular(k, -moving.spin[k].angular);
  }
  const BlockCount back =
      Engine(moving, start.packing.cell).run_block({10 * collisions, out.time}, run, false);
  // The last one out may or may not be the first one back.
  CHECK(std::abs(static_cast<double>(back.collisions - collisions)) <= 1.0);
  double worst = 0.0;
  for (std::size_t k = 0; k < moving.flight.size(); ++k) {
    Vec3 off = moving.flight[k].center - before.flight[k].center;
    for (std::size_t a = 0; a < 3; ++a) off[a] -= std::round(off[a]);
    worst = std::max({worst, norm(off), norm(moving.spin[k].axis - before.spin[k].axis)});
  }
  return worst;
}

}  // namespace

TEST_CASE("a gas whose velocities are all turned round returns to where it came from") {
  for (const double aspect : {1.0, 2.0, 0.4}) {
    const auto bodies = scenes::equal_ellipsoids(20, 0.2, aspect, 2);
    CAPTURE(aspect);
    // A few collisions of each body, every one of which makes errors ten times as large or so.
    CHECK(return_error(bodies, 60) < 1e-7);
  }
}

TEST_CASE("a block of events without growth keeps energy and momentum") {
  for (const auto& bodies :
       {scenes::equal_ellipsoids(30, 0.3, 1.0, 3), scenes::equal_ellipsoids(30, 0.3, 3.0, 3),
        scenes::cylinders_and_spheres(10, 0.1, 0.1, 2.0, 3)}) {
    const MovingPacking start = moving_gas(bodies, 6);
    Bodies moving = event_driven::bodies_of(start, {});
    const double energy = event_driven::total_energy(moving);
    const Vec3 momentum = momentum_of(moving);
    RunContext run;
    const double never = std::numeric_limits<double>::infinity();
    const BlockCount block =
        Engine(moving, start.packing.cell).run_block({2000, never}, run, false);
    CHECK(block.collisions == 2000);
    // Rounding of each collision, of which some 130 a body.
    CHECK(event_driven::total_energy(moving) == Approx(energy).epsilon(1e-13));
    CHECK(norm(momentum_of(moving) - momentum) < 1e-12);
    CHECK(block.virial > 0.0);
  }
}

TEST_CASE("hard spheres have the pressure of Carnahan and Starling within 0.5 %", "[validation]") {
  for (const double phi : {0.3, 0.5}) {
    const auto bodies = scenes::equal_ellipsoids(2000, phi, 1.0, 7);
    const EventDrivenResult result = in_equilibrium(bodies, 1500.0, validation_seed(7));
    REQUIRE(result.stop == EventDrivenStop::target_reached);
    std::printf("phi %.1f: p V / N k T = %.4f, Carnahan-Starling %.4f\n", phi,
                result.report.reduced_pressure, carnahan_starling(phi));
    CHECK(result.report.reduced_pressure == Approx(carnahan_starling(phi)).epsilon(0.005));
  }
}

TEST_CASE("spheroids of aspect 1.001 have the pressure of spheres", "[validation]") {
  const auto pressure = [](double aspect) {
    const auto bodies = scenes::equal_ellipsoids(500, 0.4, aspect, 8);
    return in_equilibrium(bodies, 1000.0, validation_seed(8)).report.reduced_pressure;
  };
  CHECK(pressure(1.001) == Approx(carnahan_starling(0.4)).epsilon(0.01));
  CHECK(pressure(0.999) == Approx(carnahan_starling(0.4)).epsilon(0.01));
}

TEST_CASE("the energy drifts by less than 1e-10 in a million collisions", "[validation]") {
  for (const double aspect : {1.0, 2.0, 0.5, 10.0}) {
    const double phi = aspect > 5.0 ? 0.2 : 0.4;
    const auto bodies = scenes::equal_ellipsoids(100, phi, aspect, 9);
    const EventDrivenResult result = in_equilibrium(bodies, 1e4, validation_seed(9));
    CAPTURE(aspect);
    CHECK(result.report.collisions >= 1'000'000);
    CHECK(result.report.energy_drift < 1e-10);
    CHECK(result.report.most_negative_gap >= -1e-13);
    std::printf("aspect %4.1f: energy drift %.1e\n", aspect, result.report.energy_drift);
  }
}

// Figure 6 of E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013) 471-490: the ratio rho falls to
// 1 as bodies become more. So it does for independent random axes; packings must be no different.
TEST_CASE("orientations of packed ellipsoids are as random as random axes are", "[validation]") {
  struct Case {
    double aspect, phi;
  };
  constexpr int kPackings = 10;
  for (const auto& [aspect, phi] : {Case{2.0, 0.3}, Case{10.0, 0.1}}) {
    int outside = 0, all = 0;
    for (const int count : {10, 25, 50, 100, 200, 500}) {
      const RandomValue rho = random_order(count, 3).rho;
      double sum = 0.0;
      for (int k = 0; k < kPackings; ++k) {
        const std::uint64_t seed =
            validation_seed(static_cast<std::uint64_t>(1000 * count + 10 * k + (aspect > 5.0)));
        const auto bodies = scenes::equal_ellipsoids(count, phi, aspect, seed);
        const EventDrivenResult result = event_driven_pack(Cell{}, bodies, {.seed = seed});
        REQUIRE(result.stop == EventDrivenStop::target_reached);
        const auto axes = symmetry_axes(result.packing, 0);
        const double seen = orientation_order(orientation_tensor(axes), 3).rho;
        sum += seen;
        outside += seen < rho.low || seen > rho.high;
        ++all;
      }
      const double mean = sum / kPackings;
      std::printf("aspect %4.1f, N %3d: rho %.3f, of random axes %.3f +- %.3f\n", aspect, count,
                  mean, rho.mean, rho.standard_deviation / std::sqrt(kPackings));
      // Four standard deviations of the mean; the law of rho has a long upper tail.
      CHECK(std::abs(mean - rho.mean) < 4.0 * rho.standard_deviation / std::sqrt(kPackings));
    }
    // One in 20 is expected outside: 3 of 60; 10 or more have a chance of 1 in 1000.
    CHECK(outside < 10);
    CHECK(all == 60);
  }
}

TEST_CASE("mixtures and scalene bodies are packed densely without overlap", "[validation]") {
  const Cell cell{};
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const auto& bodies :
         {scenes::cylinders_and_spheres(50, 0.25, 0.25, 3.0, seed), scalene_bodies(300, 0.6, seed),
          scenes::equal_ellipsoids(300, 0.6, 2.0, seed)}) {
      const EventDrivenResult result =
          event_driven_pack(cell, bodies, {.seed = validation_seed(seed)});
      CHECK(result.stop == EventDrivenStop::target_reached);
      CHECK(result.report.most_negative_gap >= -1e-12);
      CHECK(check_packing(result.packing).passed());
    }
  }
}

TEST_CASE("every row of table 2 of Ghossein and Levesque is reached", "[validation]") {
  struct Row {
    double aspect;
    int count;
    double phi;
  };
  const Row rows[] = {{2, 30, 0.6},   {5, 45, 0.55},   {10, 90, 0.3},       {20, 175, 0.2},
                      {30, 175, 0.1}, {40, 310, 0.1},  {0.5, 30, 0.6},      {0.2, 45, 0.55},
                      {0.1, 60, 0.3}, {0.05, 75, 0.2}, {1.0 / 30, 90, 0.1}, {0.025, 100, 0.1}};
  for (const Row& row : rows) {
    CAPTURE(row.aspect, row.count, row.phi);
    const auto bodies = scenes::equal_ellipsoids(row.count, row.phi, row.aspect, 4);
    const EventDrivenResult result =
        event_driven_pack(Cell{}, bodies, {.seed = validation_seed(4)});
    CHECK(result.stop == EventDrivenStop::target_reached);
    CHECK(result.report.most_negative_gap >= -1e-12);
    CHECK(check_packing(result.packing).passed());
  }
}

}  // namespace packstone
