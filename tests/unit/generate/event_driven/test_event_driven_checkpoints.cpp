#include "packstone/generate/event_driven.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <vector>

#include "orders.hpp"
#include "scenes.hpp"

namespace packstone {
namespace {

using namespace orders;

// All states that a run offers to keep.
struct Kept {
  EventDrivenResult result;
  std::vector<MovingPacking> states;
};
Kept keep_all(const Cell& cell, const Bodies& bodies, const EventDrivenOptions& options) {
  Kept kept;
  const Checkpointing every{0.0, [&](const MovingPacking& state) { kept.states.push_back(state); }};
  kept.result = event_driven_pack(cell, bodies, options, {}, every);
  return kept;
}

void check_continues(const Kept& kept, const MovingPacking& state,
                     const EventDrivenOptions& options) {
  const EventDrivenResult result = event_driven_continue(state, options);
  CHECK(result.stop == kept.result.stop);
  CHECK(hash_of(result) == hash_of(kept.result));
  CHECK(result.state.velocity == kept.result.state.velocity);
  CHECK(result.state.angular_velocity == kept.result.state.angular_velocity);
  CHECK(result.state.numbers == kept.result.state.numbers);
}

// The state of a run that is cancelled when it has offered `offers` states to keep.
EventDrivenResult cancelled_after(int offers, const Cell& cell, const Bodies& bodies,
                                  const EventDrivenOptions& options) {
  std::atomic<bool> cancel{false};
  int seen = 0;
  const Checkpointing counting{0.0,
                               [&](const MovingPacking&) { cancel = cancel || ++seen >= offers; }};
  return event_driven_pack(cell, bodies, options, RunContext{}.cancel_flag(&cancel), counting);
}

TEST_CASE("a run goes on from every state that it offers to keep as if it had never stopped") {
  const Cell cell{};
  for (const Bodies& bodies :
       {filling(cell, copies(kBall, 30), 0.5), filling(cell, copies(kProlate, 30), 0.5),
        filling(cell, mixture(3, 30, 14), 0.5)}) {
    const EventDrivenOptions options{.growth_rate = 0.003, .seed = 4};
    const Kept kept = keep_all(cell, bodies, options);
    REQUIRE(kept.states.size() >= 4);
    // The last one is the end.
    for (std::size_t k = 0; k + 1 < kept.states.size(); k += 1 + kept.states.size() / 6) {
      CAPTURE(k, kept.states.size());
      check_continues(kept, kept.states[k], options);
    }
  }
}

TEST_CASE("a run in equilibrium goes on from every state, and measures the same pressure") {
  const Cell cell{};
  const EventDrivenOptions options{
      .goal = EventDrivenGoal::equilibrium, .collisions_per_body = 60.0, .seed = 4};
  const Kept kept = keep_all(cell, filling(cell, copies(kProlate, 20), 0.3), options);
  REQUIRE(kept.states.size() >= 4);
  for (std::size_t k = 0; k + 1 < kept.states.size(); k += 2) {
    check_continues(kept, kept.states[k], options);
    const EventDrivenResult result = event_driven_continue(kept.states[k], options);
    CHECK(result.report.reduced_pressure == kept.result.report.reduced_pressure);
    CHECK(result.report.energy_drift == kept.result.report.energy_drift);
  }
}

TEST_CASE("a cancelled run keeps a valid packing and goes on from its state as if never stopped") {
  const Cell cell{};
  const EventDrivenOptions options{.growth_rate = 0.003, .seed = 4};
  for (const Bodies& bodies :
       {filling(cell, copies(kBall, 30), 0.5), filling(cell, mixture(3, 30, 14), 0.5)}) {
    const Kept kept = keep_all(cell, bodies, options);
    for (const int offers : {1, 2, 4}) {
      CAPTURE(offers);
      const EventDrivenResult stopped = cancelled_after(offers, cell, bodies, options);
      REQUIRE(stopped.stop == EventDrivenStop::cancelled);
      CHECK(stopped.size_factor > 0.0);
      CHECK(stopped.size_factor < 1.0);
      CHECK(stopped.size_factor >= stopped.state.size_factor);
      check_valid(stopped);
      check_continues(kept, stopped.state, options);
    }
  }
}

TEST_CASE("a run that is stopped anywhere goes on from its state as if never stopped") {
  const Cell cell{};
  const EventDrivenOptions options{.growth_rate = 0.03, .seed = 6};
  const Bodies bodies = filling(cell, copies(kProlate, 100), 0.5);
  const Kept kept = keep_all(cell, bodies, options);
  // Wherever the clock happens to stop it: the answer must be the same.
  for (const int milliseconds : {1, 4, 11}) {
    const auto limit = RunContext::Clock::now() + std::chrono::milliseconds(milliseconds);
    const EventDrivenResult stopped =
        event_driven_pack(cell, bodies, options, RunContext{}.deadline(limit));
    check_valid(stopped);
    if (stopped.stop != EventDrivenStop::out_of_time) continue;
    check_continues(kept, stopped.state, options);
  }
}

TEST_CASE("event_driven_continue starts from what stands, and refuses what overlaps") {
  MovingPacking start;
  start.packing = scenes::jostled_ellipsoids(32, 0.4, 3);
  start.size_factor = 1.0;
  const EventDrivenOptions equilibrium{.goal = EventDrivenGoal::equilibrium,
                                       .collisions_per_body = 20.0};
  const EventDrivenResult result = event_driven_continue(start, equilibrium);
  CHECK(result.stop == EventDrivenStop::target_reached);
  CHECK(result.size_factor == 1.0);
  check_valid(result);
  CHECK(hash_of(result) != scenes::state_hash(start.packing));

  MovingPacking smaller = start;
  smaller.size_factor = 0.5;
  const EventDrivenResult grown = event_driven_continue(smaller);
  CHECK(grown.stop == EventDrivenStop::target_reached);
  CHECK(grown.size_factor == 1.0);
  check_valid(grown);

  MovingPacking overlapping = start;
  overlapping.packing.inclusions[1].center = overlapping.packing.inclusions[0].center;
  check_names(message_of([&] { static_cast<void>(event_driven_continue(overlapping)); }),
              {"worst pair 0 and 1"});
  MovingPacking few = start;
  few.velocity.resize(3);
  CHECK(!message_of([&] { static_cast<void>(event_driven_continue(few)); }).empty());
}

}  // namespace
}  // namespace packstone
