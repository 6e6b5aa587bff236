#include "packstone/generate/event_driven.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "orders.hpp"

namespace packstone {
namespace {

using namespace orders;

TEST_CASE("a run that is cancelled before it begins has nothing, or what is valid") {
  const std::atomic<bool> cancel{true};
  const Cell cell{};
  for (const double min_gap : {0.0, 0.05}) {
    const EventDrivenResult result =
        event_driven_pack(cell, filling(cell, copies(kBall, 20), 0.3), {.min_gap = min_gap},
                          RunContext{}.cancel_flag(&cancel));
    CHECK(result.stop == EventDrivenStop::cancelled);
    check_valid(result, min_gap);
  }
}

TEST_CASE("a run out of time says so and keeps a valid packing") {
  const Cell cell{};
  const auto begin = RunContext::Clock::now();
  const EventDrivenResult result =
      event_driven_pack(cell, filling(cell, copies(kProlate, 100), 0.3),
                        {.goal = EventDrivenGoal::equilibrium, .collisions_per_body = 1e9},
                        RunContext{}.deadline(begin + std::chrono::milliseconds(200)));
  CHECK(result.stop == EventDrivenStop::out_of_time);
  check_valid(result);
}

TEST_CASE("a run reports how far it has come") {
  const Cell cell{};
  int reports = 0;
  const auto run = RunContext{}.on_progress([&](const Progress& progress) {
    ++reports;
    CHECK(progress.done <= 1.0);
    CHECK(progress.fraction <= 0.5);
    CHECK(!progress.stage.empty());
  });
  static_cast<void>(event_driven_pack(cell, filling(cell, copies(kBall, 30), 0.5), {}, run));
  CHECK(reports > 0);
}

TEST_CASE("report and history of a run agree") {
  const Cell cell{};
  const Bodies bodies = filling(cell, copies(kProlate, 40), 0.5);
  const EventDrivenResult result = pack(cell, bodies, {.growth_rate = 0.01});
  const auto& history = result.history;
  REQUIRE(history.size() >= 3);
  CHECK(static_cast<std::int64_t>(history.size()) == result.report.blocks);
  CHECK(history.back().collisions == result.report.collisions);
  CHECK(history.back().size_factor == 1.0);
  CHECK(history.back().fraction == Approx(0.5));
  for (std::size_t k = 1; k < history.size(); ++k) {
    CHECK(history[k].time > history[k - 1].time);
    CHECK(history[k].collisions >= history[k - 1].collisions);
    CHECK(history[k].fraction > history[k - 1].fraction);
    CHECK(history[k].fraction == Approx(0.5 * std::pow(history[k].size_factor, 3)));
  }
  for (const EventDrivenSample& sample : history) {
    CHECK(sample.reduced_pressure >= 1.0);
    CHECK(sample.collision_rate >= 0.0);
    CHECK(sample.growth_rate > 0.0);
    CHECK(sample.nematic_order >= 0.0);
    CHECK(sample.nematic_order <= 1.0);
    CHECK(sample.kinetic_energy > 0.5);
  }
  CHECK(result.report.predictions > result.report.collisions);
  CHECK(result.report.steps >= result.report.searches);
  CHECK(result.report.searches > 0);
  CHECK(result.report.neighbor_searches > 0);
}

TEST_CASE("every reason to stop has a name of its own") {
  CHECK(name(EventDrivenStop::target_reached) == "target_reached");
  CHECK(name(EventDrivenStop::jammed) == "jammed");
  CHECK(name(EventDrivenStop::stagnated) == "stagnated");
  CHECK(name(EventDrivenStop::cancelled) == "cancelled");
  CHECK(name(EventDrivenStop::out_of_time) == "out_of_time");
}

}  // namespace
}  // namespace packstone
