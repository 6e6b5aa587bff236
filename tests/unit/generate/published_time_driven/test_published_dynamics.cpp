#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "generate/published_time_driven/dynamics.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/published_time_driven.hpp"

namespace packstone {
namespace {

using time_driven::Dynamics;
using time_driven::Interactions;
using time_driven::Loads;

bool near(const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-12; }

Packing packing_of(const Cell& cell, std::vector<Inclusion> inclusions) {
  Packing packing;
  packing.cell = cell;
  packing.groups = {"all"};
  packing.inclusions = std::move(inclusions);
  return packing;
}

Loads loads_of(const Packing& packing) {
  Loads loads;
  Interactions(packing, false).evaluate(packing.inclusions, loads);
  return loads;
}

TEST_CASE("pairs push each other through the faces of the cell, in every image") {
  const Packing packing =
      packing_of({}, {{{0.05, 0.5, 0.5}, Sphere{0.1}}, {{0.9, 0.5, 0.5}, Sphere{0.1}}});
  const Loads loads = loads_of(packing);
  CHECK(near(loads.force[0], {0.05, 0, 0}));
  CHECK(near(loads.force[1], {-0.05, 0, 0}));
  CHECK(loads.energy == Approx(0.05 * 0.05));
  // Half a cell apart: two images of one neighbor, from both sides.
  const Packing squeezed =
      packing_of({}, {{{0.1, 0.5, 0.5}, Sphere{0.3}}, {{0.6, 0.5, 0.5}, Sphere{0.3}}});
  const Loads both = loads_of(squeezed);
  CHECK(near(both.force[0], {}));
  CHECK(both.energy == Approx(2.0 * 0.1 * 0.1));
}

TEST_CASE("a rod turns away from its own image, and stays where it is") {
  // Sheared, so that the image at (1, 0, 0) overlaps it on both sides.
  const Packing packing = packing_of(
      {3, {1, 1, 1}}, {{{0.5, 0.5, 0.5}, Cylinder{0.1, 0.55, normalized(Vec3{1, 0.15, 0})}}});
  const Loads loads = loads_of(packing);
  CHECK(loads.energy > 0.0);
  CHECK(near(loads.force[0], {}));
  CHECK(loads.torque[0].z > 0.0);
}

TEST_CASE("walls push what crosses them straight in, and do not turn a rod along them") {
  const Cell cell{3, {1, 1, 1}, {true, true, false}};
  const Packing packing = packing_of(
      cell, {{{0.5, 0.5, 0.15}, Sphere{0.2}}, {{0.2, 0.2, 0.95}, Cylinder{0.1, 0.2, {1, 0, 0}}}});
  const Loads loads = loads_of(packing);
  CHECK(near(loads.force[0], {0, 0, 0.05}));
  CHECK(near(loads.force[1], {0, 0, -0.1}));
  CHECK(near(loads.torque[1], {}));
  // A slanted rod is turned along the wall.
  const Packing slanted =
      packing_of(cell, {{{0.5, 0.5, 0.2}, Cylinder{0.1, 0.3, normalized(Vec3{1, 0, 0.5})}}});
  CHECK(loads_of(slanted).torque[0].y > 0.0);
}

TEST_CASE("turning keeps the axis unit and takes the angle asked for") {
  const Vec3 axis = normalized(Vec3{1, 2, 3}), across = any_perpendicular(axis);
  const Vec3 turned = time_driven::turned(axis, 0.01 * across);
  CHECK(norm(turned) == Approx(1.0).margin(1e-15));
  CHECK(std::acos(dot(turned, axis)) == Approx(0.01).epsilon(1e-4));
  CHECK(dot(cross(axis, turned), across) > 0.0);
  CHECK(near(time_driven::turned(axis, 0.3 * axis), axis));
}

// Two spheres on a spring: without friction the energy of motion and half the squared depth is kept
// to the order of the step.
TEST_CASE("both integrators keep the energy of two spheres that collide without friction") {
  for (const auto integrator :
       {TimeDrivenIntegrator::velocity_verlet, TimeDrivenIntegrator::leapfrog}) {
    Packing packing =
        packing_of({}, {{{0.4, 0.5, 0.5}, Sphere{0.1}}, {{0.7, 0.5, 0.5}, Sphere{0.1}}});
    const TimeDrivenOptions options{
        .integrator = integrator, .time_step = 0.02, .damping = 0.0, .berendsen = 0.0};
    Dynamics dynamics(packing, options);
    dynamics.flights()[0].velocity = {0.02, 0, 0};
    dynamics.flights()[1].velocity = {-0.02, 0, 0};
    const double start = dynamics.kinetic_energy();
    bool touched = false;
    for (int step = 0; step < 500; ++step) {
      dynamics.step();
      touched = touched || dynamics.potential_energy() > 0.0;
      const double sum = dynamics.kinetic_energy() + 0.5 * dynamics.potential_energy();
      CHECK(sum == Approx(start).epsilon(0.03));
    }
    CHECK(touched);
    CHECK(dynamics.flights()[0].velocity.x == Approx(-0.02).epsilon(0.01));
  }
}

TEST_CASE("viscous damping slows all motion at the rate beta") {
  Packing packing = packing_of(
      {}, {{{0.2, 0.2, 0.2}, Sphere{0.1}}, {{0.7, 0.7, 0.7}, Cylinder{0.05, 0.1, {0, 0, 1}}}});
  const TimeDrivenOptions options{.time_step = 0.01, .damping = 2.0, .berendsen = 0.0};
  Dynamics dynamics(packing, options);
  dynamics.flights()[0].velocity = {0.01, 0, 0};
  dynamics.flights()[1].angular_velocity = {0.3, 0, 0};
  for (int step = 0; step < 100; ++step) dynamics.step();
  CHECK(dynamics.flights()[0].velocity.x == Approx(0.01 * std::exp(-2.0)).epsilon(1e-3));
  CHECK(dynamics.flights()[1].angular_velocity.x == Approx(0.3 * std::exp(-2.0)).epsilon(1e-3));
}

// Twenty spheres of radius R = 0.02 that hardly meet, at twice or half the temperature.
struct Gas {
  Packing packing;
  TimeDrivenOptions options{.damping = 0.0};

  Gas() {
    packing.groups = {"all"};
    for (int k = 0; k < 20; ++k) {
      RandomStream random(61, StreamId::test, static_cast<std::uint64_t>(k));
      const Vec3 place{random.uniform(), random.uniform(), random.uniform()};
      packing.inclusions.push_back({place, Sphere{0.02}});
    }
  }

  // Kinetic energy over N k T / 2, for k T = 0.25 R^2 / T^2, at the end and its mean.
  struct Reading {
    double last = 0.0, mean = 0.0, least = 1e9, most = 0.0;
  };
  Reading run(double speed, int steps, bool nose_hoover) {
    Dynamics dynamics(packing, options);
    for (std::size_t k = 0; k < packing.inclusions.size(); ++k) {
      RandomStream random(62, StreamId::test, k);
      dynamics.flights()[k].velocity = speed * random_direction(random);
    }
    dynamics.switch_nose_hoover(nose_hoover);
    const double target = 0.5 * dynamics.degrees_of_freedom() * 0.25 * 0.02 * 0.02;
    Reading reading;
    for (int step = 0; step < steps; ++step) {
      dynamics.step();
      reading.last = dynamics.kinetic_energy() / target;
      if (2 * step < steps) continue;
      reading.mean += reading.last * 2.0 / steps;
      reading.least = std::min(reading.least, reading.last);
      reading.most = std::max(reading.most, reading.last);
    }
    return reading;
  }
};

TEST_CASE("the Berendsen thermostat brings the kinetic energy to its target, from both sides") {
  for (const double speed : {0.005, 0.05}) {
    Gas gas;
    gas.options.berendsen = 0.1;
    gas.options.berendsen_temperature = 0.25;
    CHECK(gas.run(speed, 2'000, false).last == Approx(1.0).epsilon(0.02));
  }
}

TEST_CASE("the Nose-Hoover thermostat swings about its target") {
  Gas gas;
  gas.options.berendsen = 0.0;
  gas.options.nose_hoover = 0.02;
  gas.options.nose_hoover_temperature = 0.25;
  const Gas::Reading reading = gas.run(0.025, 8'000, true);
  CHECK(reading.mean == Approx(1.0).epsilon(0.15));
  CHECK(reading.least < 0.8);
  CHECK(reading.most > 1.2);
}

TEST_CASE("the overlap volume of two spheres is that of their lens, across a face too") {
  constexpr double r = 0.2, d = 0.25;
  // pi (2 r - d)^2 (d^2 + 4 d r) / (12 d).
  const double lens = std::numbers::pi * (2 * r - d) * (2 * r - d) * (d * d + 4 * d * r) / (12 * d);
  for (const double x : {0.4, 0.9}) {
    const Vec3 second = wrapped(Cell{}, {x + d, 0.5, 0.95});
    const Packing packing = packing_of({}, {{{x, 0.5, 0.95}, Sphere{r}}, {second, Sphere{r}}});
    const OverlapVolume measured = overlap_volume(packing, 128);
    CHECK(measured.value == Approx(lens).epsilon(0.01));
    CHECK(std::abs(measured.value - lens) < 4.0 * measured.error);
    CHECK(measured.error < 0.02 * lens);
  }
  const Packing apart =
      packing_of({}, {{{0.2, 0.5, 0.5}, Sphere{r}}, {{0.7, 0.5, 0.5}, Sphere{r}}});
  CHECK(overlap_volume(apart).value == 0.0);
}

TEST_CASE("a point in three bodies counts twice") {
  const Inclusion ball{{0.5, 0.5, 0.5}, Sphere{0.3}};
  const double ball_volume = 4.0 / 3.0 * std::numbers::pi * 0.027;
  CHECK(overlap_volume(packing_of({}, {ball, ball, ball}), 128).value ==
        Approx(2.0 * ball_volume).epsilon(0.01));
}

}  // namespace
}  // namespace packstone
