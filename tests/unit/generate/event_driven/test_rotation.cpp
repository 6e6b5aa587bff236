#include "generate/event_driven/rotation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/revolution_pair.hpp"
#include "movers.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"

namespace packstone::event_driven {
namespace {

// A speed and a time after which it has turned by up to kMostTurn.
struct TurnOf {
  double speed, time;
};
TurnOf random_turn(RandomStream& random) {
  const double speed = std::exp(random.uniform(-12.0, 12.0));
  return {speed, random.uniform() * kMostTurn / speed};
}

}  // namespace

TEST_CASE("sine and versine of a turn are those of long double, up to the greatest turn") {
  RandomStream random(1, StreamId::test);
  for (int k = 0; k < 20000; ++k) {
    TurnOf turn = random_turn(random);
    if (k % 10 == 0) turn.time = kMostTurn / turn.speed;
    const Rotor<double> r = rotor(turn.speed * turn.speed, turn.time);
    const long double w = turn.speed, angle = w * turn.time;
    const long double sine = std::sin(angle) / w;
    const long double half = std::sin(angle / 2) / w;
    // A few units of rounding, of the arithmetic alone: the series ends below 1e-17.
    CHECK(std::abs(r.sine - sine) <= 4e-16L * sine);
    CHECK(std::abs(r.versine - 2 * half * half) <= 6e-16L * 2 * half * half);
  }
  CHECK(rotor(0.0, 2.0).sine == 2.0);
  CHECK(rotor(0.0, 2.0).versine == 2.0);
}

TEST_CASE("turning is what a quaternion does, and keeps lengths and angles") {
  RandomStream random(2, StreamId::test);
  for (int k = 0; k < 5000; ++k) {
    const TurnOf turn = random_turn(random);
    const Vec3 about = random_direction(random), u = random_direction(random),
               v = random_direction(random);
    const Rotor<double> r = rotor(turn.speed * turn.speed, turn.time);
    const Vec3 angular = turn.speed * about;
    const Vec3 turned_u = turned(u, angular, r), turned_v = turned(v, angular, r);
    const Quaternion q = from_axis_angle(about, turn.speed * turn.time);
    // Some ten roundings of numbers up to 1 on either side.
    CHECK(norm(turned_u - rotate(q, u)) < 2e-15);
    CHECK(std::abs(norm(turned_u) - 1.0) < 2e-15);
    CHECK(std::abs(dot(turned_u, turned_v) - dot(u, v)) < 3e-15);
    CHECK(norm(turned(about, angular, r) - about) < 2e-15);
  }
}

TEST_CASE("turning an axis across its angular velocity is the same turn") {
  RandomStream random(3, StreamId::test);
  for (int k = 0; k < 5000; ++k) {
    const TurnOf turn = random_turn(random);
    const Vec3 axis = random_direction(random);
    const Vec3 across = normalized(cross(axis, random_direction(random)));
    const Vec3 angular = turn.speed * across;
    const Vec3 once = turned_across(axis, angular, turn.speed, turn.time);
    const Vec3 same = turned(axis, angular, rotor(turn.speed * turn.speed, turn.time));
    CHECK(norm(once - same) < 2e-15);
  }
}

TEST_CASE("bodies turned in many short looks stand as after one turn, their axes unit") {
  zoo::Zoo zoo(4);
  for (const Body& shape :
       {Body{Ellipsoid{{3, 2, 1}, zoo.rotation()}}, Body{Ellipsoid{{3, 1, 1}, zoo.rotation()}},
        Body{Cylinder{1, 4, zoo.direction(3)}}}) {
    movers::Scene scene;
    const Vec3 angular = movers::visible_turn(shape, 0.9 * zoo.direction(3));
    scene.movers.push_back({shape, {1, 2, 3}, zoo.direction(3), angular});
    Bodies bodies = movers::bodies_of(scene);
    const double end = 20.0;
    for (int k = 1; k <= 50; ++k) bodies.advance(0, end * k / 50.0);
    const Body judge = movers::body_at(scene, 0, end), there = turned_body(bodies, 0, shape);
    CHECK(norm(bodies.flight[0].center - movers::center_at(scene.movers[0], end)) < 1e-13);
    CHECK(std::abs(norm(bodies.spin[0].axis) - 1.0) < 4e-16);
    for (int k = 0; k < 20; ++k) {
      const Vec3 d = zoo.direction(3);
      // Each of 50 looks rounds the axes once.
      CHECK(support(there, d) == Approx(support(judge, d)).epsilon(1e-13));
    }
  }
}

}  // namespace packstone::event_driven
