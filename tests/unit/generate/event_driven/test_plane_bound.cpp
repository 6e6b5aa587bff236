#include "generate/event_driven/plane_bound.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "generate/event_driven/revolution_bound.hpp"
#include "movers.hpp"
#include "support/each_pair.hpp"
#include "support/oracle.hpp"

namespace packstone::event_driven {
namespace {

using movers::Motion;
using movers::Scene;

// A plane, turning or not, between the two bodies of a scene or beside the first of them.
struct Setting {
  Scene scene;
  MovingPlane plane;
  bool two = true;

  [[nodiscard]] Vec3 normal_at(double t) const { return plane.normal + t * plane.rate; }
  [[nodiscard]] Vec3 between(double t) const {
    const Vec3 to = two ? center_at(scene.movers[1], t) : Vec3{};
    return to - center_at(scene.movers[0], t);
  }
};

PlaneBound bound_of(const Setting& s) {
  const Bodies bodies = bodies_of(s.scene);
  const Vec3 velocity = (s.two ? s.scene.movers[1].velocity : Vec3{}) - s.scene.movers[0].velocity;
  PlaneBound bound(s.plane, s.between(0.0), velocity, s.scene.min_gap);
  for (std::int32_t i = 0; i < (s.two ? 2 : 1); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double second = bodies.second.empty() ? 0.0 : bodies.second[k].semi_axis;
    bound.add_body(bodies.form[k], bodies.spin[k], bodies.pose(i, 0.0), second, bodies.reach[k],
                   bodies.size, bodies.growth);
  }
  return bound;
}

// What the bound bounds, by bodies turned exactly: n.r less both supports and |n| min_gap.
double exact(const Setting& s, double t) {
  const Vec3 n = s.normal_at(t);
  double value = dot(n, s.between(t)) - s.scene.min_gap * norm(n) -
                 static_cast<double>(oracle::support(movers::body_at(s.scene, 0, t), n));
  if (s.two) value -= static_cast<double>(oracle::support(movers::body_at(s.scene, 1, t), -n));
  return value;
}

// Rounding of all that enters the bound.
double slack(const Setting& s, double t) {
  double reach = 0.0;
  for (const movers::Mover& m : s.scene.movers) reach += circum_radius(m.body);
  return 1e-13 * norm(s.normal_at(t)) * (reach + norm(s.between(t)));
}

Setting random_setting(const zoo::Pair& pair, zoo::Zoo& zoo) {
  const int dim = dimension(kind(pair.a));
  const double reach = zoo::size_of(pair);
  const Motion motion{2.0, zoo.uniform(0, 1) < 0.5 ? 0.0 : zoo.log_uniform(1e-3, 1.0),
                      zoo.uniform(0, 1) < 0.7 ? 0.0 : 0.1 * reach};
  Setting s;
  s.scene = movers::approaching(pair, motion, zoo);
  // Near the one that separates by most, or anywhere.
  const Vec3 best = gap(pair.a, pair.b, pair.r).normal;
  s.plane.normal = zoo.log_uniform(0.01, 100) * (best + zoo.uniform(0, 1) * zoo.direction(dim));
  const Vec3 unit = normalized(s.plane.normal);
  const Vec3 turn = zoo.uniform(0, 2) * norm(s.plane.normal) * zoo.direction(dim);
  if (zoo.uniform(0, 1) < 0.5) s.plane.rate = turn - dot(turn, unit) * unit;
  s.two = zoo.uniform(0, 1) < 0.8;
  return s;
}

template <class Check>
void for_each_setting(std::uint64_t seed, int count, Check&& check) {
  zoo::Zoo zoo(seed);
  zoo::for_each_pair(seed, count, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    check(random_setting(pair, zoo), zoo);
  });
}

}  // namespace

TEST_CASE("the bound of a moving plane never exceeds what the plane shows, at any time") {
  for_each_setting(1, 40, [](const Setting& s, zoo::Zoo& zoo) {
    const PlaneBound bound = bound_of(s);
    REQUIRE(std::abs(bound.at(0.0) - exact(s, 0.0)) <= slack(s, 0.0));
    for (int k = 0; k < 12; ++k) {
      const double t = zoo.log_uniform(1e-6, 3.0);
      REQUIRE(bound.at(t) <= exact(s, t) + slack(s, t));
    }
  });
}

TEST_CASE("the bound of a moving plane never exceeds its length times the gap, at any time") {
  for_each_setting(2, 15, [](const Setting& s, zoo::Zoo& zoo) {
    if (!s.two) return;
    const PlaneBound bound = bound_of(s);
    for (int k = 0; k < 4; ++k) {
      const double t = zoo.log_uniform(1e-4, 2.0);
      const movers::Clearance c = movers::clearance(s.scene, 0, {1, {}}, t);
      REQUIRE(bound.at(t) <= norm(s.normal_at(t)) * (c.value + c.error) + slack(s, t));
    }
  });
}

TEST_CASE("the bound of a moving plane is concave") {
  for_each_setting(3, 30, [](const Setting& s, zoo::Zoo& zoo) {
    const PlaneBound bound = bound_of(s);
    for (int k = 0; k < 8; ++k) {
      const double a = zoo.uniform(0, 2), b = zoo.uniform(0, 2);
      const double chord = 0.5 * (bound.at(a) + bound.at(b));
      REQUIRE(bound.at(0.5 * (a + b)) >= chord - slack(s, a) - slack(s, b));
      // A tangent lies above it.
      const double tangent = bound.at(a) + (b - a) * bound.slope(a);
      REQUIRE(bound.at(b) <= tangent + slack(s, a) + slack(s, b) + 1e-13 * std::abs(tangent));
    }
  });
}

TEST_CASE("the bound of a moving plane starts with the rate of what the plane shows") {
  int checked = 0;
  for_each_setting(4, 30, [&](const Setting& s, zoo::Zoo&) {
    // The support of a rod has a bend where the plane comes to lie along or across it.
    const Bodies bodies = bodies_of(s.scene);
    for (std::size_t k = 0; k < 2; ++k) {
      const double along = dot(normalized(s.plane.normal), bodies.spin[k].axis);
      if (bodies.form[k] >= Form::cylinder && (std::abs(along) < 0.1 || std::abs(along) > 0.9)) {
        return;
      }
    }
    const PlaneBound bound = bound_of(s);
    constexpr double kStep = 1e-6;
    const double rate = (exact(s, kStep) - exact(s, -kStep)) / (2.0 * kStep);
    // Differences: rounding of exact() over the step, and the third derivative, which is some
    // square of the aspect of up to 100.
    const double scale = slack(s, 0.0) / 1e-13;
    REQUIRE(bound.slope(0.0) == Approx(rate).margin(1e-7 * scale));
    ++checked;
  });
  CHECK(checked > 3000);
}

TEST_CASE("bodies of revolution have the same bound by the shorter way") {
  for_each_setting(5, 30, [](const Setting& setting, zoo::Zoo&) {
    Setting s = setting;
    s.plane.rate = {};
    const Bodies bodies = bodies_of(s.scene);
    if (!are_revolution(bodies) || !s.two) return;
    const Vec3 velocity = s.scene.movers[1].velocity - s.scene.movers[0].velocity;
    s.scene.min_gap = 0.0;
    const auto of_revolution = [&](std::size_t k) {
      const Spin& spin = bodies.spin[k];
      const double lateral = spin.lateral * spin.lateral;
      return Revolution<double, Vec3>{spin.axis, spin.angular, lateral,
                                      spin.axial * spin.axial - lateral, bodies.flight[k].turn};
    };
    const Revolution<double, Vec3> a = of_revolution(0), b = of_revolution(1);
    const RevolutionBound bound(
        s.plane.normal, a, b, s.between(0.0),
        {bodies.reach[0], bodies.reach[1], bodies.size, bodies.growth, velocity});
    REQUIRE(bound.length() == Approx(norm(s.plane.normal)));
    const PlaneBound same = bound_of(s);
    REQUIRE(std::abs(bound.now() - same.at(0.0)) <= slack(s, 0.0));
    REQUIRE(bound.slope_now() == Approx(same.slope(0.0)).margin(slack(s, 0.0)));
    for (const double t : {0.0, 0.1, 1.0}) {
      REQUIRE(std::abs(bound.at(t) - same.at(t)) <= slack(s, t));
      REQUIRE(bound.slope(t) == Approx(same.slope(t)).margin(slack(s, t)));
    }
  });
}

TEST_CASE("up to the time that safe_time() returns the bound stays above its aim") {
  int asked = 0, late = 0;
  for_each_setting(6, 40, [&](const Setting& s, zoo::Zoo& zoo) {
    const PlaneBound bound = bound_of(s);
    const double start = bound.at(0.0);
    if (!(start > 0.0)) return;
    const double horizon = zoo.log_uniform(0.01, 10.0);
    const double aim = start * (zoo.uniform(0, 1) < 0.5 ? 1e-9 : zoo.uniform(0, 0.9));
    if (bound.at(horizon) >= aim) return;
    const double safe = safe_time(bound, horizon, aim);
    REQUIRE(safe > 0.0);
    REQUIRE(safe < horizon);
    for (int k = 0; k <= 20; ++k) REQUIRE(bound.at(safe * k / 20.0) >= aim - slack(s, safe));
    ++asked;
    // Close to where it ends: else a search would take many steps.
    late += bound.at(1.2 * safe) < aim + 0.1 * (start - aim);
  });
  CHECK(asked > 500);
  CHECK(late > 0.95 * asked);
}

}  // namespace packstone::event_driven
