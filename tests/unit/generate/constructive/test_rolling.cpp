#include "generate/drop_and_roll/rolling.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "generate/drop_and_roll/pile.hpp"
#include "packstone/core/random.hpp"

namespace packstone::rolling {
namespace {

constexpr double kPi = std::numbers::pi;
const Vec3 kUp{0, 0, 1};

Contact ball_below(std::int32_t body, const Vec3& center, double reach, const Vec3& p) {
  return {body, center, reach, normalized(p - center)};
}

double angle_of(const Angle& at) { return std::atan2(at.sin, at.cos); }

// Turns the angle forward in small steps until the arc is blocked.
double first_blocked(const Blocked& blocked, double from) {
  constexpr int kSteps = 200'000;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = from + (kPi - from) * k / kSteps;
    if (blocked.a * std::cos(t) + blocked.b * std::sin(t) > blocked.k) return t;
  }
  return 2.0 * kPi;
}

// A sphere at p in space that two others hold from both sides.
struct HeldByTwo {
  Vec3 p;
  Contacts contacts;
};
HeldByTwo held_by_two(double height_difference) {
  const Vec3 a{-1, 0, 0};
  const Vec3 b{1, 0, height_difference};
  const Vec3 middle = 0.5 * (a + b);
  const double half = 0.5 * norm(b - a);
  const Vec3 e = normalized(b - a);
  const Vec3 uphill = normalized(kUp - dot(kUp, e) * e);
  const double h = std::sqrt(4.0 - half * half);
  HeldByTwo held;
  held.p = middle + h * (std::cos(0.3) * uphill + std::sin(0.3) * Vec3{0, 1, 0});
  held.contacts.add(ball_below(0, a, 2.0, held.p));
  held.contacts.add(ball_below(1, b, 2.0, held.p));
  return held;
}

}  // namespace

TEST_CASE("settle: a ball falls without contact, and beside one") {
  Contacts none;
  CHECK_FALSE(settle(none, kUp));
  Contacts beside;
  beside.add({0, {}, 2.0, {1, 0, 0}});
  CHECK_FALSE(settle(beside, kUp));
  CHECK(beside.size() == 0);
}

TEST_CASE("settle: one contact alone carries a ball that rolls away from the other") {
  Contacts contacts;
  contacts.add({0, {}, 2.0, normalized(Vec3{0.2, 0, 1})});
  contacts.add({1, {}, 2.0, normalized(Vec3{1, 0, 0.2})});
  REQUIRE_FALSE(settle(contacts, kUp));
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].body == 0);
}

TEST_CASE("settle: two contacts are rest in the plane and a way down in space") {
  const Vec3 up{0, 1, 0};
  Contacts plane;
  plane.add({0, {}, 2.0, normalized(Vec3{1, 1, 0})});
  plane.add({1, {}, 2.0, normalized(Vec3{-1, 1, 0})});
  CHECK(settle(plane, up));
  HeldByTwo held = held_by_two(0.0);
  CHECK_FALSE(settle(held.contacts, kUp));
  CHECK(held.contacts.size() == 2);
}

TEST_CASE("settle: three contacts around the vertical are rest in space") {
  Contacts around;
  for (int k = 0; k < 3; ++k) {
    const double t = 2.0 * kPi * k / 3.0;
    around.add({k, {}, 2.0, normalized(Vec3{std::cos(t), std::sin(t), 1.0})});
  }
  CHECK(settle(around, kUp));
  Contacts aside;
  for (int k = 0; k < 3; ++k) {
    const double t = 0.5 * k;
    aside.add({k, {}, 2.0, normalized(Vec3{std::cos(t), std::sin(t), 1.0})});
  }
  CHECK_FALSE(settle(aside, kUp));
}

TEST_CASE("arc_on keeps the distance to what carries, and starts where the ball is") {
  for (const double difference : {0.0, 0.7, -0.7}) {
    const HeldByTwo held = held_by_two(difference);
    const auto arc = arc_on(held.contacts, held.p, kUp);
    REQUIRE(arc);
    CHECK(norm(arc->at(arc->now) - held.p) < 1e-14);
    for (double t = 0.0; t < 3.0; t += 0.25) {
      const Vec3 p = arc->at({std::cos(t), std::sin(t)});
      CHECK(norm(p - held.contacts[0].center) == Approx(2.0).epsilon(1e-14));
      CHECK(norm(p - held.contacts[1].center) == Approx(2.0).epsilon(1e-14));
    }
  }
}

TEST_CASE("arc_on on two ends where settle lets one of them go") {
  for (const double difference : {0.0, 0.4, -0.9}) {
    const HeldByTwo held = held_by_two(difference);
    const auto arc = arc_on(held.contacts, held.p, kUp);
    REQUIRE(arc);
    const double end = std::acos(arc->last_cos);
    for (const double step : {-1e-6, 1e-6}) {
      const Vec3 p = arc->at({std::cos(end + step), std::sin(end + step)});
      Contacts there;
      there.add(ball_below(0, held.contacts[0].center, 2.0, p));
      there.add(ball_below(1, held.contacts[1].center, 2.0, p));
      CHECK_FALSE(settle(there, kUp));
      CHECK((there.size() == 2) == (step < 0.0));
      if (there.size() == 1) CHECK(there[0].body != held.contacts[arc->leaves].body);
    }
  }
}

TEST_CASE("arc_on between a ball and a wall stays in the plane of centers at the wall") {
  Contacts contacts;
  const Vec3 p{1.0, 0.5, 1.0};
  const Vec3 ball{1.8, -0.3, -0.2};
  contacts.add({Contact::kWall, {1.0, 0, 0}, 0.0, {1, 0, 0}});
  contacts.add(ball_below(7, ball, norm(p - ball), p));
  const auto arc = arc_on(contacts, p, kUp);
  REQUIRE(arc);
  CHECK(arc->leaves == 1);
  CHECK(norm(arc->at(arc->now) - p) < 1e-14);
  const Vec3 later = arc->at({0.0, 1.0});
  CHECK(later.x == Approx(1.0).epsilon(1e-14));
  CHECK(later.z == Approx(ball.z).margin(1e-14));
  CHECK(norm(later - ball) == Approx(norm(p - ball)).epsilon(1e-14));
}

TEST_CASE("arc_on between a ball and a wall stays there from the very top, rounding or not") {
  for (const double off : {0.0, 1e-16, -1e-16}) {
    const Vec3 ball{5.0, 1.0, 1.0};
    const Vec3 p{5.0 + off, 1.0 + off, 3.0};
    Contacts contacts;
    contacts.add({Contact::kWall, {0, 1.0, 0}, 0.0, {0, 1, 0}});
    contacts.add(ball_below(0, ball, 2.0, p));
    const auto arc = arc_on(contacts, p, kUp);
    REQUIRE(arc);
    CHECK(arc->begins_at_top());
    CHECK(arc->at({0.0, 1.0}).y == 1.0);
    CHECK(arc->mirrored().at({0.0, 1.0}).x == Approx(10.0 - arc->at({0.0, 1.0}).x));
  }
}

TEST_CASE("Pile: a ball between two that stand at a wall rolls away from the wall") {
  const Cell cell{3, {20, 20, 20}, {false, false, false}};
  for (const double wall : {1.0, 19.0}) {
    Pile pile(cell, 0.0);
    pile.add({9.0, wall, 1.0}, 1.0);
    pile.add({11.5, wall, 1.0}, 1.0);
    const auto place = pile.drop({10.4, wall, 0.0}, 1.0);
    REQUIRE(place);
    CHECK(place->z == Approx(1.0).epsilon(1e-12));
    CHECK(std::abs(place->y - wall) > 1.0);
  }
}

TEST_CASE("Pile: a ball above the ceiling has no place") {
  const Cell cell = cell_2d(2.5, 3.0, false, false);
  Pile pile(cell, 0.0);
  pile.add({1.0, 1.0, 0.0}, 1.0);
  CHECK_FALSE(pile.drop({1.2, 0.0, 0.0}, 1.0));
  CHECK(pile.drop({1.2, 0.0, 0.0}, 0.2));
}

TEST_CASE("entry agrees with a walk along the circle") {
  RandomStream random(11, StreamId::test);
  int met = 0;
  for (int k = 0; k < 40; ++k) {
    const Blocked blocked{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.0};
    const double from = random.uniform(0.0, 2.0);
    const Angle now{std::cos(from), std::sin(from)};
    if (blocked.a * now.cos + blocked.b * now.sin > blocked.k) continue;
    const auto at = entry(blocked, now, -1.0);
    const double expected = first_blocked(blocked, from);
    CHECK(at.has_value() == (expected < kPi));
    if (at) CHECK(angle_of(*at) == Approx(expected).margin(1e-4));
    met += at.has_value();
  }
  CHECK(met > 5);
}

TEST_CASE("entry: a contact left along its tangent does not block, whichever way rounding turns") {
  const double k = std::cos(0.4);
  for (const double turn : {-1e-11, 0.0, 1e-11}) {
    // The blocked arc ends just here, or a rounding ahead: on its rim the slope is all but level.
    const Blocked blocked{1.0, 0.0, 1.0, 1e-10};
    const Angle now{std::cos(turn), std::sin(turn)};
    CHECK_FALSE(entry(blocked, now, -1.0));
  }
  // Steeply into it, from as near.
  CHECK(entry({std::cos(1.4), std::sin(1.4), k, 1e-10}, {std::cos(1.0), std::sin(1.0)}, -1.0));
}

TEST_CASE("entry: what touches and lies ahead blocks at once, what lies behind does not") {
  const Angle now{std::cos(1.0), std::sin(1.0)};
  const auto blocked_at = [&](double middle) {
    const double k = std::cos(0.4);
    return Blocked{std::cos(middle), std::sin(middle), k, 1e-12};
  };
  const auto ahead = entry(blocked_at(1.4), now, -1.0);
  REQUIRE(ahead);
  CHECK(ahead->cos == now.cos);
  CHECK_FALSE(entry(blocked_at(0.6), now, -1.0));
}

}  // namespace packstone::rolling
