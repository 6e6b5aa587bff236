#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/io/checkpoint_file.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "support/order.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

using test::order;

// Denser than random sequential adsorption can.
const std::string kDense = R"(
[[inclusions]]
name = "grains"
shape = "ellipsoid"
aspect = 2
count = 30
fraction = 0.3
[[inclusions]]
name = "balls"
shape = "sphere"
count = 20
fraction = 0.2
[packing]
method = "event-driven"
)";

// Goes on until it is told to stop.
const std::string kEndless = R"(
[[inclusions]]
name = "plates"
shape = "ellipse"
aspect = 1.5
count = 40
fraction = 0.5
[packing.event-driven]
goal = "equilibrium"
collisions_per_body = 1e9
)";

TEST_CASE("a dense recipe is packed by event-driven dynamics, certified, with its history") {
  const PackOutcome outcome = pack(order(kDense + "min_gap = 0.001\n"));
  CHECK(outcome.target_reached);
  CHECK(outcome.stop == "target_reached");
  CHECK(outcome.method == "event-driven");
  CHECK(outcome.method_reason == "as ordered");
  CHECK(outcome.groups[0].count == 30);
  CHECK(outcome.groups[0].fraction == Approx(0.3).epsilon(1e-12));
  CHECK(outcome.packing.groups == std::vector<std::string>{"grains", "balls"});
  REQUIRE(outcome.packing.certificate.has_value());
  CHECK(outcome.packing.certificate == check_packing(outcome.packing, {.min_gap = 0.001}));
  CHECK(outcome.packing.provenance->method == "event-driven");
  REQUIRE(outcome.motion.has_value());
  CHECK(outcome.motion->size_factor == 1.0);
  CHECK(outcome.motion->report.collisions > 100);
  REQUIRE_FALSE(outcome.motion->history.empty());
  CHECK(outcome.motion->history.back().fraction == Approx(0.5).epsilon(1e-9));
}

TEST_CASE("event-driven dynamics gives the same bits for the recipe in the provenance") {
  const PackOutcome first = pack(order(kDense));
  const Recipe again = recipe_of_packing(first.packing, "again.json");
  CHECK(scenes::state_hash(pack(again, RunContext{}.threads(3)).packing) ==
        scenes::state_hash(first.packing));
}

TEST_CASE("collisions turn the groups whose law is random, and others only when ordered") {
  const std::string groups =
      "[[inclusions]]\nname = \"grains\"\nshape = \"ellipsoid\"\naspect = 2\ncount = 15\n"
      "fraction = 0.15\n"
      "[[inclusions]]\nname = \"balls\"\nshape = \"sphere\"\ncount = 10\nfraction = 0.1\n"
      "[[inclusions]]\nname = \"along\"\nshape = \"spherocylinder\"\naspect = 2\ncount = 15\n"
      "fraction = 0.15\norientation = { axis = [0, 0, 1] }\n"
      "[packing]\nmethod = \"event-driven\"\n[packing.event-driven]\n";
  const auto turned = [&](const std::string& rotate) {
    const PackOutcome outcome = pack(order(groups + rotate));
    CHECK(outcome.target_reached);
    std::vector<bool> said;
    for (const GroupOutcome& group : outcome.groups) {
      said.push_back(group.turned);
      if (!group.tensor) continue;
      const bool same = trace(*group.tensor - *group.ordered_tensor) == Approx(0.0).margin(1e-12) &&
                        group.tensor->zz == Approx(group.ordered_tensor->zz).margin(1e-12);
      CHECK(same != group.turned);
    }
    return said;
  };
  CHECK(turned("") == std::vector<bool>{true, false, false});
  CHECK(turned("rotate = true\n") == std::vector<bool>{true, false, true});
  CHECK(turned("rotate = false\n") == std::vector<bool>{false, false, false});
}

TEST_CASE("bodies may grow from where random sequential adsorption has placed smaller ones") {
  const PackOutcome outcome = pack(order(kDense + "[packing.event-driven]\nstart = \"rsa\"\n"));
  CHECK(outcome.target_reached);
  CHECK(outcome.trials >= 50);
  CHECK(outcome.derived.back() == "grown from a fraction of 0.2 that rsa has placed");
  CHECK(outcome.packing.certificate->passed());
  const PackOutcome thin =
      pack(order(kDense + "[packing.event-driven]\nstart = \"rsa\"\nstart_fraction = 0.05\n"));
  CHECK(thin.derived.back() == "grown from a fraction of 0.05 that rsa has placed");
  const PackOutcome hopeless =
      pack(order(kDense + "[packing.rsa]\nmax_restarts = 0\n"
                          "[packing.event-driven]\nstart = \"rsa\"\nstart_fraction = 0.49\n"));
  CHECK(hopeless.target_reached);
  CHECK_THAT(hopeless.derived.back(), Catch::Contains("grew from points"));
}

TEST_CASE("what is halted as rsa places the start is kept at the size of the start") {
  const std::atomic<bool> cancelled{true};
  const PackOutcome outcome = pack(order(kDense + "[packing.event-driven]\nstart = \"rsa\"\n"),
                                   RunContext{}.cancel_flag(&cancelled));
  CHECK(outcome.stop == "cancelled");
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.packing.certificate->passed());
  CHECK(outcome.motion->size_factor < 1.0);
}

TEST_CASE("the densest packing is what was ordered, however large its inclusions are") {
  const std::string densest = "[packing.event-driven]\ngoal = \"densest\"\nslowest_growth = 0.01\n";
  const std::string balls = "[[inclusions]]\nshape = \"sphere\"\ncount = 60\nfraction = ";
  for (const char* nominal : {"0.1\n", "0.9\n"}) {  // the latter no packing could have
    const PackOutcome outcome = pack(order(balls + nominal + densest));
    CHECK(outcome.target_reached);
    CHECK(outcome.stop == "jammed");
    CHECK(outcome.packing.certificate->passed());
    CHECK(outcome.packing.certificate->fraction > 0.55);
    CHECK(outcome.packing.certificate->fraction ==
          Approx(*outcome.groups[0].ordered_fraction * std::pow(outcome.motion->size_factor, 3)));
  }
}

TEST_CASE("equilibrium goes on at the size ordered, and its energy stays") {
  const PackOutcome outcome =
      pack(order("[[inclusions]]\nshape = \"disk\"\ncount = 50\nfraction = 0.4\n"
                 "[packing.event-driven]\ngoal = \"equilibrium\"\ncollisions_per_body = 20\n",
                 "[1, 1]"));
  CHECK(outcome.target_reached);
  CHECK(outcome.motion->size_factor == 1.0);
  CHECK(outcome.motion->report.energy_drift < 1e-9);
  // 1 / (1 - fraction)^2 by scaled particle theory is 2.78; of 50 disks and 500 collisions a rough
  // mean.
  CHECK(outcome.motion->report.reduced_pressure == Approx(2.78).epsilon(0.2));
}

TEST_CASE("a target out of reach ends with a valid packing of smaller inclusions") {
  const PackOutcome outcome =
      pack(order("[[inclusions]]\nshape = \"disk\"\ncount = 40\nfraction = 0.9\n"
                 "[packing.event-driven]\nslowest_growth = 0.01\n",
                 "[1, 1]"));
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.stop == "jammed");
  CHECK(outcome.motion->size_factor < 1.0);
  CHECK(outcome.groups[0].count == 40);
  CHECK(outcome.groups[0].fraction < *outcome.groups[0].ordered_fraction);
  CHECK(outcome.packing.certificate->passed());
}

TEST_CASE("a time limit ends a run that moves, and only the densest packing is then reached") {
  Recipe limited = order(kEndless, "[1, 1]");
  limited.time_limit = 0.1;
  const PackOutcome outcome = pack(limited);
  CHECK(outcome.stop == "out_of_time");
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.packing.certificate->passed());
  limited.event_driven.goal = EventDrivenGoal::densest;
  limited.event_driven.slowest_growth = 1e-12;
  CHECK(pack(limited).target_reached);
  // Not all stand yet.
  limited.event_driven.start = GrowthStart::rsa;
  limited.time_limit = 1e-9;
  const PackOutcome nothing = pack(limited);
  CHECK(nothing.stop == "out_of_time");
  CHECK_FALSE(nothing.target_reached);
}

// The same state as it was handed over first.
MovingPacking first_checkpoint(const Recipe& recipe, std::uint64_t& hash_at_end) {
  MovingPacking first;
  const PackOutcome outcome =
      pack(recipe, {}, {.every_seconds = 0.0, .write = [&](const auto& state) {
                          if (first.size_factor == 0.0) first = state;
                        }});
  hash_at_end = scenes::state_hash(outcome.packing);
  return first;
}

TEST_CASE("a run gone on with from a checkpoint file gives the bits of one uninterrupted") {
  const test::TemporaryFolder folder;
  const Recipe recipe = order(kDense);
  std::uint64_t whole = 0;
  const MovingPacking state = first_checkpoint(recipe, whole);
  REQUIRE(state.size_factor < 1.0);
  write_checkpoint(folder / "c.h5", state);
  const MovingPacking read = read_checkpoint(folder / "c.h5");
  const PackOutcome resumed = resume_pack(recipe_of_packing(read.packing, "c.h5"), read);
  CHECK(resumed.target_reached);
  CHECK(resumed.method_reason == "from a checkpoint");
  CHECK(scenes::state_hash(resumed.packing) == whole);
  CHECK(resumed.packing.provenance->recipe_json == recipe_to_json(recipe));
  CHECK(resumed.groups[0].ordered_tensor == pack(recipe).groups[0].ordered_tensor);
}

TEST_CASE("a run that is cancelled hands a state over from which it ends as it would have ended") {
  const Recipe recipe = order(kDense);
  std::atomic<bool> cancelled{false};
  std::vector<MovingPacking> states;
  RunContext run;
  run.cancel_flag(&cancelled).on_progress([&](const Progress&) { cancelled = true; });
  const PackOutcome outcome =
      pack(recipe, run,
           {.every_seconds = 1e9, .write = [&](const auto& state) { states.push_back(state); }});
  CHECK(outcome.stop == "cancelled");
  CHECK(outcome.packing.certificate->passed());
  REQUIRE(states.size() == 1);
  CHECK(states[0].size_factor <= outcome.motion->size_factor);
  CHECK(states[0].packing.groups == outcome.packing.groups);
  CHECK(scenes::state_hash(resume_pack(recipe, states[0]).packing) ==
        scenes::state_hash(pack(recipe).packing));
}

TEST_CASE("a checkpoint of another recipe is refused") {
  const Recipe recipe = order(kDense);
  std::uint64_t ignored = 0;
  const MovingPacking state = first_checkpoint(recipe, ignored);
  const auto refused = [&](const std::string& text, const std::string& override_text,
                           const char* message) {
    const Recipe other =
        recipe_from_toml("[cell]\nsize = [1, 1, 1]\n" + text, "other.toml", {override_text});
    CHECK_THROWS_AS(resume_pack(other, state), InvalidArgument);
    CHECK_THROWS_WITH(resume_pack(other, state),
                      Catch::Contains("does not belong to the recipe") && Catch::Contains(message));
  };
  refused(kDense, "cell.size=[1, 1, 2]", "another cell");
  refused(kDense, "inclusions.balls.count=21", "it holds 50 inclusions of 51 ordered");
  refused(kDense, "inclusions.balls.fraction=0.21", "inclusion 30 is another one");
  refused(kDense, "inclusions.balls.name=spheres", "other groups");
  MovingPacking broken = state;
  broken.size_factor = -1.0;
  CHECK_THROWS_WITH(resume_pack(recipe, broken), Catch::Contains("size_factor = -1"));
}

TEST_CASE("what dynamics cannot do is refused before work, with its place in the recipe") {
  const std::string open = "[[inclusions]]\nshape = \"sphere\"\nradius = 0.05\n";
  CHECK_THROWS_WITH(
      pack(order(open + "[packing]\nmethod = \"event-driven\"\n")),
      Catch::StartsWith("test.toml:5: inclusions[0].radius = 0.05; a size alone leaves the count"));
  CHECK_THROWS_WITH(
      pack(order("[[inclusions]]\nshape = \"sphere\"\ncount = 100\nfraction = 0.75\n")),
      Catch::StartsWith("test.toml:6: ") && Catch::Contains("densest packing"));
}

TEST_CASE("where sizes are open, gaps alone can be too large") {
  const std::string groups =
      "[[inclusions]]\nshape = \"sphere\"\ncount = 100\nfraction = 0.9\n"
      "[packing.event-driven]\ngoal = \"densest\"\nslowest_growth = 0.05\n"
      "[packing]\nmin_gap = ";
  CHECK_THROWS_WITH(pack(order(groups + "0.3\n")),
                    Catch::StartsWith("test.toml:11: packing.min_gap = 0.3; "));
  CHECK(pack(order(groups + "0.05\n")).target_reached);
}

TEST_CASE("rods that may turn are packed where none could stand as drawn") {
  // Longer than the layer is thick.
  const std::string rods =
      "[[inclusions]]\nshape = \"spherocylinder\"\naspect = 12\ncount = 20\nfraction = 0.04\n"
      "[packing]\nmethod = \"event-driven\"\n";
  const PackOutcome outcome = pack(order(rods, "[1, 1, 0.25]\nperiodic = [true, true, false]"));
  CHECK(outcome.target_reached);
  CHECK(outcome.packing.certificate->outside_walls == 0);
}

}  // namespace
}  // namespace packstone
