#include "generate/event_driven/run_state.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "generate/event_driven/collision.hpp"
#include "movers.hpp"
#include "packstone/core/random.hpp"
#include "support/random_body.hpp"

namespace packstone::event_driven {
namespace {

// Bodies of all shapes at random places, without velocities; group 1 every third.
MovingPacking random_state(int dimension, int count, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  MovingPacking state;
  if (dimension == 2) state.packing.cell = cell_2d(1.0, 2.0);
  state.packing.groups = {"turning", "fixed"};
  state.size_factor = 0.3;
  for (int k = 0; k < count; ++k) {
    const ShapeKind shape = test::random_shape(dimension, random);
    const Body body = test::random_body(shape, random, [&] { return random.uniform(0.1, 1.0); });
    const Vec3 center{random.uniform(), random.uniform(), dimension == 3 ? random.uniform() : 0.0};
    state.packing.inclusions.push_back({center, body, k % 3 == 2 ? 1 : 0});
  }
  return state;
}

// Mean and mean square of numbers that should be normal ones.
struct Moments {
  double count = 0.0, sum = 0.0, squares = 0.0;
  void add(double x) {
    count += 1.0;
    sum += x;
    squares += x * x;
  }
  // Off by at most 5 standard deviations of either.
  void check_normal() const {
    REQUIRE(count > 100);
    CHECK(std::abs(sum) < 5.0 * std::sqrt(count));
    CHECK(squares / count == Approx(1.0).margin(5.0 * std::sqrt(2.0 / count)));
  }
};

}  // namespace

TEST_CASE("what a run has counted comes back from the numbers of its state") {
  Progressed progressed;
  double value = 0.125;
  for (double* number :
       {&progressed.growth_rate, &progressed.time, &progressed.collisions, &progressed.since_slower,
        &progressed.grown, &progressed.energy, &progressed.still_collisions, &progressed.virial,
        &progressed.still_time}) {
    *number = value *= 1.7;
  }
  MovingPacking state;
  state.numbers = {{"somebody's", 3.0}, {"time", -1.0}};
  write_numbers(progressed, state);
  // Each under a name of its own.
  CHECK(state.numbers.size() * sizeof(double) == sizeof(Progressed));
  const Progressed back = read_numbers(state);
  CHECK(back.growth_rate == progressed.growth_rate);
  CHECK(back.time == progressed.time);
  CHECK(back.collisions == progressed.collisions);
  CHECK(back.since_slower == progressed.since_slower);
  CHECK(back.grown == progressed.grown);
  CHECK(back.energy == progressed.energy);
  CHECK(back.still_collisions == progressed.still_collisions);
  CHECK(back.virial == progressed.virial);
  CHECK(back.still_time == progressed.still_time);
  CHECK(read_numbers({}).time == 0.0);
}

TEST_CASE("bodies that are taken out of a state and put back are the same bodies") {
  for (const int dimension : {2, 3}) {
    MovingPacking state = random_state(dimension, 60, 3);
    draw_velocities(7, {}, state);
    const MovingPacking before = state;
    const Bodies bodies = bodies_of(state, {});
    REQUIRE(bodies.count() == 60);
    CHECK(bodies.size == state.size_factor);
    CHECK(bodies.growth == 0.0);
    store(bodies, state);
    for (std::size_t k = 0; k < 60; ++k) {
      const Inclusion& then = before.packing.inclusions[k];
      const Inclusion& now = state.packing.inclusions[k];
      CHECK(now.center == then.center);
      CHECK(now.group == then.group);
      CHECK(state.velocity[k] == before.velocity[k]);
      CHECK(state.angular_velocity[k] == before.angular_velocity[k]);
      RandomStream random(k, StreamId::test);
      for (int trial = 0; trial < 10; ++trial) {
        Vec3 d = random_direction(random);
        if (dimension == 2) d = normalized(Vec3{d.x, d.y, 0.0});
        CHECK(support(now.body, d) == Approx(support(then.body, d)).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("groups of fixed orientation neither turn nor change a bit") {
  MovingPacking state = random_state(3, 60, 5);
  EventDrivenOptions options;
  options.fixed_orientation = {false, true};
  draw_velocities(7, options, state);
  const MovingPacking before = state;
  Bodies bodies = bodies_of(state, options);
  for (std::int32_t i = 0; i < bodies.count(); ++i) bodies.advance(i, 0.2);
  store(bodies, state);
  for (std::size_t k = 0; k < 60; ++k) {
    const Inclusion& then = before.packing.inclusions[k];
    const bool fixed = then.group == 1 || is_round(kind(then.body));
    CHECK((state.angular_velocity[k] == Vec3{}) == fixed);
    CHECK((state.packing.inclusions[k].body == then.body) == fixed);
    CHECK(!(state.packing.inclusions[k].center == then.center));
  }
}

TEST_CASE("velocities are drawn with variance 1, angular ones with that over the inertia") {
  for (const int dimension : {2, 3}) {
    MovingPacking state = random_state(dimension, 4000, 6);
    draw_velocities(8, {}, state);
    Moments flying[3], turning;
    for (std::size_t k = 0; k < 4000; ++k) {
      for (std::size_t a = 0; a < 3; ++a) flying[a].add(state.velocity[k][a]);
      const Body& body = state.packing.inclusions[k].body;
      const Vec3& w = state.angular_velocity[k];
      if (is_round(kind(body))) {
        CHECK(w == Vec3{});
        continue;
      }
      // Along an axis of the body, by the moment of inertia from the second moments.
      RandomStream random(k, StreamId::test);
      Vec3 axis{0, 0, 1};
      if (dimension == 3) {
        const Vec3 symmetry = *symmetry_axis(body);
        const bool about = movers::unlike_semi_axes(body) == 3 && random.below(2) == 0;
        axis = about ? symmetry : any_perpendicular(symmetry);
        if (!about && movers::unlike_semi_axes(body) == 3) continue;
        if (movers::unlike_semi_axes(body) == 2) CHECK(std::abs(dot(w, symmetry)) < 1e-12);
      }
      const SymMat3 moment = second_moment(body);
      const double inertia = (trace(moment) - dot(axis, moment * axis)) / volume(body);
      turning.add(std::sqrt(inertia) * dot(w, axis));
    }
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) flying[a].check_normal();
    if (dimension == 2) CHECK(flying[2].squares == 0.0);
    turning.check_normal();
  }
}

TEST_CASE("velocities depend on the seed and on nothing but the body's number") {
  MovingPacking state = random_state(3, 20, 9), fewer = random_state(3, 10, 9), other = state;
  draw_velocities(1, {}, state);
  draw_velocities(1, {}, fewer);
  draw_velocities(2, {}, other);
  for (std::size_t k = 0; k < 10; ++k) {
    CHECK(state.velocity[k] == fewer.velocity[k]);
    CHECK(state.angular_velocity[k] == fewer.angular_velocity[k]);
    CHECK(!(state.velocity[k] == other.velocity[k]));
  }
}

TEST_CASE("rescaling brings both kinds of energy to equilibrium and tells by how much") {
  for (const int dimension : {2, 3}) {
    MovingPacking state = random_state(dimension, 50, 10);
    draw_velocities(3, {}, state);
    Bodies bodies = bodies_of(state, {});
    const Freedom freedom = freedom_of(bodies, dimension);
    CHECK(freedom.translation == 50.0 * dimension);
    for (std::size_t k = 0; k < 50; ++k) {
      bodies.flight[k].velocity *= 3.0;
      bodies.set_angular(k, 0.1 * bodies.spin[k].angular);
    }
    const double before = total_energy(bodies),
                 sought = 0.5 * (freedom.translation + freedom.rotation);
    const Vec3 direction = normalized(bodies.flight[7].velocity);
    CHECK(rescale_velocities(bodies, dimension) == Approx(before / sought));
    Energy sum;
    for (std::int32_t i = 0; i < 50; ++i) {
      const Energy e = energy(bodies, i, bodies.size);
      sum.translation += e.translation;
      sum.rotation += e.rotation;
      CHECK(bodies.flight[static_cast<std::size_t>(i)].turn ==
            norm(bodies.spin[static_cast<std::size_t>(i)].angular));
    }
    CHECK(sum.translation == Approx(0.5 * freedom.translation).epsilon(1e-13));
    CHECK(sum.rotation == Approx(0.5 * freedom.rotation).epsilon(1e-13));
    CHECK(norm(normalized(bodies.flight[7].velocity) - direction) < 1e-15);
  }
}

TEST_CASE("each kind of body counts the ways it moves in") {
  MovingPacking state;
  state.size_factor = 1.0;
  state.packing.groups = {"all", "fixed"};
  for (const Body& body :
       {Body{Sphere{1}}, Body{Ellipsoid{{1, 2, 3}, {}}}, Body{Ellipsoid{{1, 1, 3}, {}}},
        Body{Cylinder{1, 2}}, Body{Spherocylinder{1, 2}}}) {
    state.packing.inclusions.push_back({{0.5, 0.5, 0.5}, body, 0});
  }
  CHECK(freedom_of(bodies_of(state, {}), 3).translation == 15.0);
  CHECK(freedom_of(bodies_of(state, {}), 3).rotation == 9.0);
  for (Inclusion& inclusion : state.packing.inclusions) inclusion.group = 1;
  EventDrivenOptions options;
  options.fixed_orientation = {false, true};
  CHECK(freedom_of(bodies_of(state, options), 3).rotation == 0.0);
}

}  // namespace packstone::event_driven
