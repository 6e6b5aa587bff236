#include "generate/event_driven/collision.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "movers.hpp"
#include "support/each_pair.hpp"

namespace packstone::event_driven {
namespace {

using movers::Scene;

// The moment of inertia at mass 1, from the second moments of the volume.
Vec3 spin_momentum(const Body& body, const Vec3& angular) {
  const SymMat3 moment = second_moment(body);
  return (trace(moment) * angular - moment * angular) / volume(body);
}

double energy_of(const Bodies& bodies) {
  double sum = 0.0;
  for (std::int32_t i = 0; i < bodies.count(); ++i) {
    const Energy e = energy(bodies, i, bodies.size);
    sum += e.translation + e.rotation;
  }
  return sum;
}

// Two bodies at the moment of touching, in the middle of what they are doing.
struct Touch {
  Scene scene;
  Bodies bodies;
  Contact contact;
  Partner partner{1, {}};
};

// Touching along a random normal, by support points that need no search, so that they come
// together.
Touch random_touch(ShapeKind kind_a, ShapeKind kind_b, double growth, zoo::Zoo& zoo) {
  const int dim = dimension(kind_a);
  Touch touch;
  Scene& s = touch.scene;
  s.growth = growth;
  s.size = zoo.log_uniform(0.1, 2.0);
  const Vec3 n = zoo.direction(dim);
  for (const ShapeKind k : {kind_a, kind_b}) {
    const Body body = zoo.body(k, 1.0);
    const Vec3 angular = movers::visible_turn(body, zoo.uniform(0, 1) * zoo.direction(3));
    s.movers.push_back({body, {}, zoo.uniform(0, 1) * zoo.direction(dim), angular});
  }
  const Body a = movers::body_at(s, 0, 0.0), b = movers::body_at(s, 1, 0.0);
  Contact& c = touch.contact;
  c.normal = n;
  c.arm_a = support_point(a, n);
  c.arm_b = support_point(b, -n);
  c.between = c.arm_a - c.arm_b;
  s.movers[1].center = c.between;
  c.growth_speed = growth / s.size * (support(a, n) + support(b, -n));
  touch.bodies = bodies_of(s);
  return touch;
}

// Of the surfaces at the contact, growth included.
double approach_of(const Touch& t) {
  const auto point_speed = [&](std::size_t k, const Vec3& arm) {
    return t.bodies.flight[k].velocity + cross(t.bodies.spin[k].angular, arm);
  };
  const Contact& c = t.contact;
  return c.growth_speed - dot(c.normal, point_speed(1, c.arm_b) - point_speed(0, c.arm_a));
}

// Makes them come together where they go apart.
void let_approach(Touch& t) {
  if (approach_of(t) < 0.0) {
    for (std::size_t k = 0; k < 2; ++k) {
      t.bodies.flight[k].velocity = -t.bodies.flight[k].velocity;
      t.bodies.set_angular(k, -t.bodies.spin[k].angular);
    }
  }
  t.contact.approach = approach_of(t);
}

template <class Check>
void for_each_touch(std::uint64_t seed, double growth, int count, const Check& check) {
  zoo::Zoo zoo(seed);
  for (const auto& [a, b] : zoo::kinds_of_pairs()) {
    for (int k = 0; k < count; ++k) {
      CAPTURE(name(a), name(b), k);
      Touch touch = random_touch(a, b, growth, zoo);
      let_approach(touch);
      if (touch.contact.approach > 1e-6) check(touch);
    }
  }
}

}  // namespace

TEST_CASE("the energy of a body is that of its mass and its moments of inertia") {
  for_each_touch(1, 0.0, 30, [](const Touch& t) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Energy e = energy(t.bodies, static_cast<std::int32_t>(k), t.scene.size);
      const Vec3 w = t.bodies.spin[k].angular;
      const Body now = movers::body_at(t.scene, k, 0.0);
      CHECK(e.translation == Approx(0.5 * norm_sq(t.bodies.flight[k].velocity)));
      CHECK(e.rotation == Approx(0.5 * dot(w, spin_momentum(now, w))).epsilon(1e-12));
    }
  });
}

TEST_CASE("a collision exchanges momentum along the normal and angular momentum by its arms") {
  for_each_touch(2, 0.0, 60, [](Touch t) {
    const Bodies before = t.bodies;
    const double virial = collide(t.bodies, 0, t.partner, t.contact, 0.0);
    const Contact& c = t.contact;
    const auto pushed = [&](std::size_t k) {
      return t.bodies.flight[k].velocity - before.flight[k].velocity;
    };
    const double impulse = -dot(pushed(0), c.normal);
    CHECK(impulse > 0.0);
    CHECK(norm(pushed(0) + impulse * c.normal) <= 1e-14 * (1.0 + impulse));
    CHECK(norm(pushed(0) + pushed(1)) <= 1e-15 * (1.0 + impulse));
    CHECK(virial == Approx(impulse * dot(c.normal, c.between)).epsilon(1e-12));
    const Vec3 arms[2] = {c.arm_a, c.arm_b};
    for (std::size_t k = 0; k < 2; ++k) {
      if (is_round(kind(t.scene.movers[k].body))) {
        CHECK(t.bodies.spin[k].angular == before.spin[k].angular);
        continue;
      }
      const Vec3 turned = t.bodies.spin[k].angular - before.spin[k].angular;
      const Vec3 gained = spin_momentum(movers::body_at(t.scene, k, 0.0), turned);
      const Vec3 torque = (k == 0 ? -impulse : impulse) * cross(arms[k], c.normal);
      // What is about the axis of a body of revolution is rounding.
      CHECK(norm(gained - torque) <= 1e-12 * impulse * circum_radius(t.scene.movers[k].body));
    }
  });
}

TEST_CASE("without growth a collision keeps the energy and turns the approach round") {
  for_each_touch(3, 0.0, 60, [](Touch t) {
    const double before = energy_of(t.bodies);
    const double approach = t.contact.approach;
    collide(t.bodies, 0, t.partner, t.contact, 0.0);
    CHECK(energy_of(t.bodies) == Approx(before).epsilon(1e-13));
    CHECK(approach_of(t) == Approx(-approach).epsilon(1e-11).margin(1e-14));
  });
}

TEST_CASE("surfaces that grow separate after a collision, and fast ones keep the energy") {
  int fast = 0, slow = 0;
  for (const double growth : {1e-3, 0.03, 0.3}) {
    for_each_touch(4, growth, 40, [&](Touch t) {
      const double before = energy_of(t.bodies), approach = t.contact.approach;
      const double grows = t.contact.growth_speed;
      collide(t.bodies, 0, t.partner, t.contact, 0.0);
      const double after = approach_of(t);
      CHECK(after < 0.0);
      CHECK(-after <= approach * (1.0 + 1e-11) + 1e-14);
      // Where the growth is much of the approach, all of it has to be turned round.
      if (approach < 2.0 * grows) CHECK(after == Approx(-approach).epsilon(1e-10));
      if (approach > 20.0 * grows) CHECK(energy_of(t.bodies) == Approx(before).epsilon(1e-12));
      CHECK(energy_of(t.bodies) >= before * (1.0 - 1e-12));
      fast += approach > 20.0 * grows;
      slow += approach < 2.0 * grows;
    });
  }
  CHECK(fast > 100);
  CHECK(slow > 100);
}

TEST_CASE("a contact that closes no more within rounding is pushed apart all the same") {
  for_each_touch(5, 0.0, 10, [](Touch t) {
    t.contact.approach = -1e-18;
    const Vec3 before = t.bodies.flight[0].velocity;
    collide(t.bodies, 0, t.partner, t.contact, 0.0);
    const double pushed = -dot(t.bodies.flight[0].velocity - before, t.contact.normal);
    CHECK(pushed >= 0.0);
    CHECK(pushed < 1e-11);
  });
}

TEST_CASE("bodies of revolution do not turn about their axis after a collision either") {
  for_each_touch(6, 0.0, 30, [](Touch t) {
    collide(t.bodies, 0, t.partner, t.contact, 0.0);
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3& w = t.bodies.spin[k].angular;
      if (movers::unlike_semi_axes(t.scene.movers[k].body) == 3) continue;
      CHECK(std::abs(dot(w, t.bodies.spin[k].axis)) <= 1e-13 * (1.0 + norm(w)));
      CHECK(t.bodies.flight[k].turn == norm(w));
    }
  });
}

TEST_CASE("a body that meets its own image turns back, and its center keeps its velocity") {
  zoo::Zoo zoo(7);
  for (int k = 0; k < 300; ++k) {
    const auto shape = static_cast<ShapeKind>(1 + k % 3);
    CAPTURE(name(shape), k);
    Touch t = random_touch(shape, shape, k % 2 == 0 ? 0.0 : 0.01, zoo);
    t.partner = {0, t.contact.between};
    t.scene.movers.resize(1);
    t.bodies = bodies_of(t.scene);
    Contact& c = t.contact;
    const Body body = movers::body_at(t.scene, 0, 0.0);
    c.arm_b = -c.arm_a;  // The image is the same body.
    c.between = c.arm_a - c.arm_b;
    c.growth_speed = t.scene.growth / t.scene.size * 2.0 * support(body, c.normal);
    const auto approach = [&] {
      return c.growth_speed - dot(c.normal, cross(t.bodies.spin[0].angular, c.arm_b - c.arm_a));
    };
    if (approach() < 0.0) t.bodies.set_angular(0, -t.bodies.spin[0].angular);
    c.approach = approach();
    if (c.approach < 1e-3) continue;
    const Vec3 velocity = t.bodies.flight[0].velocity;
    const double before = energy_of(t.bodies), growth = c.growth_speed;
    collide(t.bodies, 0, t.partner, c, 0.0);
    CHECK(t.bodies.flight[0].velocity == velocity);
    CHECK(approach() < 0.0);
    if (growth == 0.0) {
      CHECK(approach() == Approx(-c.approach).epsilon(1e-9));
      CHECK(energy_of(t.bodies) == Approx(before).epsilon(1e-12));
    }
  }
}

TEST_CASE("a wall throws back what hits it, and adds nothing to the virial") {
  zoo::Zoo zoo(8);
  for (int k = 0; k < 600; ++k) {
    const auto shape = static_cast<ShapeKind>(k % 6);
    CAPTURE(name(shape), k);
    const int dim = dimension(shape);
    Touch t = random_touch(shape, shape, k % 2 == 0 ? 0.0 : 0.01, zoo);
    t.scene.movers.resize(1);
    t.bodies = bodies_of(t.scene);
    const int axis = static_cast<int>(zoo.uniform(0, dim));
    const bool high = zoo.uniform(0, 1) < 0.5;
    Contact& c = t.contact;
    c.normal = {};
    c.normal[static_cast<std::size_t>(axis)] = high ? 1.0 : -1.0;
    const Body body = movers::body_at(t.scene, 0, 0.0);
    c.arm_a = support_point(body, c.normal);
    c.arm_b = {};
    c.growth_speed = t.scene.growth / t.scene.size * support(body, c.normal);
    const auto approach = [&] {
      return c.growth_speed +
             dot(c.normal, t.bodies.flight[0].velocity + cross(t.bodies.spin[0].angular, c.arm_a));
    };
    c.approach = approach();
    if (c.approach < 1e-3) continue;
    const double before = energy_of(t.bodies);
    const Vec3 velocity = t.bodies.flight[0].velocity;
    CHECK(collide(t.bodies, 0, {wall(axis, high), {}}, c, 0.0) == 0.0);
    CHECK(approach() < 0.0);
    const Vec3 pushed = t.bodies.flight[0].velocity - velocity;
    CHECK(norm(pushed - dot(pushed, c.normal) * c.normal) == 0.0);
    if (t.scene.growth > 0.0) continue;
    CHECK(approach() == Approx(-c.approach).epsilon(1e-10));
    CHECK(energy_of(t.bodies) == Approx(before).epsilon(1e-13));
    if (is_round(shape)) CHECK(dot(pushed, c.normal) == Approx(-2.0 * c.approach));
  }
}

TEST_CASE("bodies that may not turn do not, and collide as if they had no end of inertia") {
  Scene scene;
  scene.movers.push_back({Ellipsoid{{2, 1, 1}, {}}, {}, {1, 0, 0}, {}, false});
  scene.movers.push_back({Ellipsoid{{2, 1, 1}, {}}, {3, 1.4, 0}, {-1, 0, 0}, {}, false});
  Bodies bodies = bodies_of(scene);
  Contact contact;
  contact.normal = normalized(Vec3{0.6, 0.8, 0});
  contact.arm_a = {1.5, 0.7, 0};
  contact.arm_b = {-1.5, -0.7, 0};
  contact.between = {3, 1.4, 0};
  contact.approach = 1.2;
  collide(bodies, 0, {1, {}}, contact, 0.0);
  CHECK(bodies.spin[0].angular == Vec3{});
  CHECK(bodies.spin[1].angular == Vec3{});
  const Vec3 apart = bodies.flight[1].velocity - bodies.flight[0].velocity;
  CHECK(dot(apart, contact.normal) == Approx(1.2));
}

}  // namespace packstone::event_driven
