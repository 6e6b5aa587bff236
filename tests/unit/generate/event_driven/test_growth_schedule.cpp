#include "generate/event_driven/growth_schedule.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace packstone::event_driven {
namespace {

EventDrivenOptions options_for(EventDrivenGoal goal) {
  EventDrivenOptions options;
  options.goal = goal;
  options.growth_rate = 0.2;
  options.slowest_growth = 0.01;
  return options;
}

Progressed under(double pressure, double growth_rate) {
  Progressed at;
  at.pressure = pressure;
  at.growth_rate = growth_rate;
  return at;
}

// What a block brings at a reduced pressure, where nothing but collisions of pairs holds growth up.
BlockGain at_pressure(double pressure, double collisions = 30.0) {
  return {0.1 * collisions / pressure, collisions, 0.1, pressure};
}

}  // namespace

TEST_CASE("a gas is dilute up to a tenth of the cell, at a third of the fraction ordered at most") {
  const EventDrivenOptions options = options_for(EventDrivenGoal::target);
  for (const int dimension : {2, 3}) {
    for (const double full : {0.01, 0.1, 0.25, 0.3, 0.6}) {
      const double size = GrowthSchedule(options, full, dimension).dilute_until();
      CHECK(full * std::pow(size, dimension) == Approx(std::min(0.1, full / 3.0)));
    }
  }
}

TEST_CASE("bodies grow fast while they are dilute, and the slower the more they press") {
  const EventDrivenOptions options = options_for(EventDrivenGoal::target);
  const GrowthSchedule schedule(options, 0.5, 3);
  CHECK(schedule.rate(under(3.0, 0.2), 0.1) == 1.0);
  double faster = 1.0;
  for (const double pressure : {1.0, 5.0, 6.0, 9.0, 11.0, 12.0, 100.0}) {
    const double rate = schedule.rate(under(pressure, 0.2), 0.9);
    CHECK(rate <= faster);
    CHECK(rate >= 0.2);
    faster = rate;
  }
  CHECK(faster == 0.2);
  CHECK(schedule.rate(under(0.0, 0.2), 0.9) == 0.2);
}

TEST_CASE("blocks are short while the pressure is not known or changes fast") {
  const EventDrivenOptions options = options_for(EventDrivenGoal::target);
  const GrowthSchedule schedule(options, 0.5, 3);
  const double first = schedule.block_collisions(under(0.0, 0.2));
  const double thin = schedule.block_collisions(under(5.0, 0.2));
  const double usual = schedule.block_collisions(under(50.0, 0.2));
  CHECK(first < thin);
  CHECK(thin < usual);
}

TEST_CASE("on the way to a target crowded bodies grow half as fast, again and again, then jam") {
  const EventDrivenOptions options = options_for(EventDrivenGoal::target);
  const GrowthSchedule schedule(options, 0.5, 3);
  Progressed at = under(50.0, 0.2);
  CHECK_FALSE(schedule.slow_down(at, at_pressure(50.0, 1000.0)));
  CHECK(at.growth_rate == 0.2);
  int halvings = 0;
  for (int block = 0; block < 100; ++block) {
    const double before = at.growth_rate;
    if (schedule.slow_down(at, at_pressure(1000.0))) break;
    if (at.growth_rate == before) continue;
    CHECK(at.growth_rate == std::max(0.5 * before, options.slowest_growth));
    ++halvings;
  }
  CHECK(halvings == 5);
  CHECK(at.growth_rate == options.slowest_growth);
  CHECK(schedule.slow_down(at, at_pressure(1000.0, 100.0)));
}

TEST_CASE("toward the densest a fluid is compressed slowly, and frozen gaps close faster") {
  const EventDrivenOptions options = options_for(EventDrivenGoal::densest);
  const GrowthSchedule schedule(options, 0.5, 3);
  Progressed at = under(5.0, 0.2);
  CHECK_FALSE(schedule.slow_down(at, at_pressure(5.0)));
  CHECK(at.growth_rate == 0.2);
  CHECK_FALSE(schedule.slow_down(at, at_pressure(13.0)));
  CHECK(at.growth_rate == options.slowest_growth);
  at.pressure = 299.0;
  CHECK(schedule.rate(at, 0.9) == 0.01);
  at.pressure = 301.0;
  CHECK(schedule.rate(at, 0.9) == Approx(0.1));
  at.growth_rate = 0.1;
  CHECK(schedule.rate(at, 0.9) == 0.2);
}

TEST_CASE("bodies are jammed that hardly grow, whatever holds them up") {
  for (const EventDrivenGoal goal : {EventDrivenGoal::target, EventDrivenGoal::densest}) {
    const EventDrivenOptions options = options_for(goal);
    const GrowthSchedule schedule(options, 0.5, 3);
    Progressed at = under(50.0, 0.2);
    CHECK(schedule.slow_down(at, at_pressure(1.1e5)));
    // Walls and own images, which the pressure does not count.
    CHECK(schedule.slow_down(at, {1e-6, 30.0, 0.1, 1.0}));
    CHECK(schedule.slow_down(at, {0.0, 30.0, 0.1, 1.0}));
  }
}

}  // namespace packstone::event_driven
