#include "packstone/recipe/pack.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "support/order.hpp"

using namespace packstone;
using test::order;

namespace {

const std::string kMixture = R"(
[[inclusions]]
name = "rods"
shape = "spherocylinder"
aspect = 3
count = 20
fraction = 0.08
[[inclusions]]
name = "balls"
shape = "sphere"
count = 30
fraction = 0.06
size = { uniform = [1, 2] }
)";

// Random sequential adsorption of so few large spheres does not come near this.
const std::string kBeyond = R"(
[[inclusions]]
name = "balls"
shape = "sphere"
count = 20
fraction = 0.6
[packing]
method = "rsa"
)";

}  // namespace

TEST_CASE("pack makes what is ordered, certified, with its origin") {
  const Recipe recipe = order(kMixture + "[packing]\nmin_gap = 0.01\nseed = 3\n");
  const PackOutcome outcome = pack(recipe);
  CHECK(outcome.target_reached);
  CHECK(outcome.stop == "target_reached");
  REQUIRE(outcome.groups.size() == 2);
  CHECK(outcome.groups[0].ordered_count == 20);
  CHECK(outcome.groups[0].count == 20);
  // Count and fraction are both met; a sum of 30 volumes rounds in its last digits.
  CHECK(outcome.groups[1].fraction == Approx(0.06).epsilon(1e-13));
  CHECK(outcome.packing.groups == std::vector<std::string>{"rods", "balls"});
  REQUIRE(outcome.packing.certificate.has_value());
  CHECK(outcome.packing.certificate == check_packing(outcome.packing, {.min_gap = 0.01}));
  CHECK(outcome.packing.certificate->passed());
  REQUIRE(outcome.packing.provenance.has_value());
  CHECK(outcome.packing.provenance->seed == 3);
  CHECK(outcome.packing.provenance->recipe_json == recipe_to_json(recipe));
}

TEST_CASE("pack gives the same bits for the recipe that it left in the provenance") {
  const PackOutcome first = pack(order(kMixture));
  const Recipe again = recipe_from_json(first.packing.provenance->recipe_json, "again.json");
  const PackOutcome second = pack(again, RunContext{}.threads(3));
  CHECK(scenes::state_hash(first.packing) == scenes::state_hash(second.packing));
  const PackOutcome other =
      pack(recipe_from_json(recipe_to_json(again), "other.json", {"packing.seed=2"}));
  CHECK(scenes::state_hash(first.packing) != scenes::state_hash(other.packing));
}

TEST_CASE("a shortfall is an outcome with a certified packing, not an error") {
  const PackOutcome outcome = pack(order(kBeyond + "[packing.rsa]\nmax_restarts = 0\n"));
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.stop == "saturated");
  CHECK(outcome.groups[0].ordered_count == 20);
  CHECK(outcome.groups[0].count < 20);
  CHECK(outcome.groups[0].count > 10);
  CHECK(outcome.packing.certificate->passed());
}

TEST_CASE("a cancelled run and one out of time keep what is valid") {
  const Recipe recipe = order(kBeyond);
  const std::atomic<bool> cancelled{true};
  const PackOutcome stopped = pack(recipe, RunContext{}.cancel_flag(&cancelled));
  CHECK(stopped.stop == "cancelled");
  CHECK_FALSE(stopped.target_reached);
  CHECK(stopped.packing.certificate->passed());

  Recipe limited = recipe;
  limited.time_limit = 0.05;
  CHECK(pack(limited).stop == "out_of_time");
  // The sooner of the two limits holds.
  limited.time_limit = 1e6;
  const auto soon = RunContext::Clock::now() + std::chrono::milliseconds(50);
  CHECK(pack(limited, RunContext{}.deadline(soon)).stop == "out_of_time");
}

TEST_CASE("a size alone fills the cell, around groups that are counted") {
  const PackOutcome alone =
      pack(order("[[inclusions]]\nshape = \"disk\"\nradius = 0.05\n", "[1, 1]"));
  CHECK(alone.target_reached);
  CHECK(alone.stop == "saturated");
  CHECK_FALSE(alone.groups[0].ordered_count.has_value());
  // 0.547 in the limit; some 70 disks spread by a few percent.
  CHECK(alone.groups[0].fraction == Approx(0.547).margin(0.05));

  const PackOutcome around = pack(order(
      "[[inclusions]]\nname = \"few\"\nshape = \"ellipse\"\naspect = 3\ncount = 5\nfraction = 0.2\n"
      "[[inclusions]]\nname = \"rest\"\nshape = \"disk\"\nradius = 0.04\n",
      "[1, 1]"));
  CHECK(around.target_reached);
  CHECK(around.groups[0].count == 5);
  CHECK(around.groups[1].count > 10);
}

TEST_CASE("the order of orientations is reported beside that of as many random axes") {
  const PackOutcome outcome = pack(order(kMixture));
  const GroupOutcome& turned = outcome.groups[0];
  REQUIRE(turned.order.has_value());
  CHECK(*turned.order == orientation_order(*turned.tensor, 3));
  CHECK(*turned.random_order == random_order(turned.count, 3));
  CHECK_FALSE(outcome.groups[1].order.has_value());
  CHECK_FALSE(outcome.groups[1].random_order.has_value());

  const std::string rods =
      "[[inclusions]]\nshape = \"ellipse\"\nsemi_axes = [0.06, 0.02]\ncount = 30\n"
      "orientation = { tensor = [[0.7, 0], [0, 0.3]] }\n";
  const PackOutcome flat = pack(order(rods, "[1, 1]"));
  CHECK(flat.groups[0].order->nematic == Approx(0.4).epsilon(1e-10));
  CHECK(flat.groups[0].order->rho == Approx(7.0 / 3).epsilon(1e-10));
}

TEST_CASE("redrawn orientations are reported beside those that were drawn") {
  const PackOutcome redrawn = pack(order(kMixture + "[packing.rsa]\nredraw_orientations = true\n"));
  CHECK(redrawn.groups[0].redrawn);
  CHECK_FALSE(redrawn.groups[1].redrawn);
  REQUIRE(redrawn.groups[0].tensor.has_value());
  REQUIRE(redrawn.groups[0].ordered_tensor.has_value());
  CHECK(redrawn.groups[0].tensor != redrawn.groups[0].ordered_tensor);
  CHECK_FALSE(redrawn.groups[1].tensor.has_value());
  const PackOutcome kept = pack(order(kMixture));
  CHECK_FALSE(kept.groups[0].redrawn);
  // The same axes, summed in another order.
  CHECK(trace(*kept.groups[0].tensor - *kept.groups[0].ordered_tensor) ==
        Approx(0.0).margin(1e-13));
  CHECK(kept.groups[0].tensor->xx == Approx(kept.groups[0].ordered_tensor->xx).margin(1e-13));
}

TEST_CASE("what is met only roughly is said beside what was derived") {
  const std::string open_rods =
      "[[inclusions]]\nshape = \"ellipse\"\nsemi_axes = [0.1, 0.05]\n"
      "orientation = { tensor = [[0.7, 0], [0, 0.3]] }\n";
  const PackOutcome open = pack(order(open_rods + "[packing.rsa]\nmax_trials = 100\n", "[1, 1]"));
  REQUIRE(open.derived.size() == 1);
  CHECK_THAT(open.derived[0], Catch::Contains("tensor is met by chance only"));

  const std::string grains =
      "[[inclusions]]\nname = \"grains\"\nshape = \"ellipsoid\"\naspect = [2, 3]\ncount = 5\n"
      "fraction = 0.02\n";
  CHECK(pack(order(grains)).derived.size() == 1);
  const PackOutcome redrawn =
      pack(order(grains + "[packing.rsa]\nredraw_orientations = true\nmax_trials = 77\n"));
  REQUIRE(redrawn.derived.size() == 2);
  CHECK_THAT(redrawn.derived[1],
             Catch::StartsWith("grains: ") && Catch::Contains("given up after max_trials = 77"));
}

TEST_CASE("what cannot be is refused before any work") {
  const std::string ball = "[[inclusions]]\nshape = \"sphere\"\n";
  CHECK_THROWS_WITH(pack(order(ball + "count = 100\nfraction = 0.75\n")),
                    Catch::Contains("0.74") && Catch::Contains("densest"));
  CHECK_THROWS_WITH(
      pack(order("[[inclusions]]\nshape = \"disk\"\ncount = 9\nfraction = 0.91\n", "[1, 1]")),
      Catch::Contains("densest"));
  CHECK_THROWS_WITH(pack(order(kMixture + "[packing]\nmin_gap = 0.5\n")),
                    Catch::Contains("need") && Catch::Contains("min_gap"));
  CHECK_THROWS_AS(pack(order(ball + "radius = 0.6\n")), InvalidArgument);
  CHECK_THROWS_AS(pack(Recipe{}), InvalidArgument);
  Recipe negative = order(kMixture);
  negative.min_gap = -1.0;
  CHECK_THROWS_WITH(pack(negative), Catch::Contains("min_gap = -1"));
  Recipe timeless = order(kMixture);
  timeless.time_limit = 0.0;
  CHECK_THROWS_WITH(pack(timeless), Catch::Contains("time_limit = 0"));
}

TEST_CASE("what cannot be is named by file, line, key and value") {
  const auto refused = [](const std::string& groups, const std::string& message) {
    CHECK_THROWS_WITH(pack(order(groups)), Catch::Contains(message));
  };
  const std::string ball = "[[inclusions]]\nshape = \"sphere\"\n";
  const std::string rod = "[[inclusions]]\nname = \"rods\"\nshape = \"cylinder\"\n";
  refused(ball + "count = 1\nradius = 0.6\n",
          "test.toml:6: inclusions[0].radius = 0.6; inclusion 0 cannot stand in the cell: with "
          "diameter 1.2 it ");
  refused(ball + "diameter = 1.2\n", "test.toml:5: inclusions[0].diameter = 1.2; inclusion 0");
  refused(rod + "diameter = 0.1\nlength = 1.2\ncount = 3\norientation = { axis = [0, 0, 1] }\n",
          "test.toml:7: inclusions[0].length = 1.2; inclusion 0 cannot stand");
  // The size follows from the fraction.
  refused(rod + "aspect = 1e6\ncount = 3\nfraction = 0.01\n",
          "test.toml:8: inclusions[0].fraction = 0.01; inclusion 0 cannot stand");
  refused(ball + "count = 200000000\nfraction = 0.1\n",
          "test.toml:5: inclusions[0].count = 200000000; ");
  refused(ball + "radius = 1e-6\nfraction = 0.1\n",
          "test.toml:6: inclusions[0].fraction = 0.1; it takes some 2.39e+16 inclusions");
  refused(ball + "radius = 0.3\nfraction = 0.01\n",
          "test.toml:6: inclusions[0].fraction = 0.01; it is less than half an inclusion");
  // The group that takes most of the room.
  refused(kMixture + ball + "count = 300\nradius = 0.1\n",
          "test.toml:18: inclusions[2].count = 300; all inclusions together need 1.39664");
  refused(kMixture + "[packing]\nmin_gap = 0.4\n",
          "test.toml:17: packing.min_gap = 0.4; all inclusions together with their gaps");
  refused(rod + "diameter = 0.1\nlength = 0.2\ncount = 2\n" +
              "orientation = { tensor = [[0.5, 0, 0], [0, 0.3, 0], [0, 0, 0.2]] }\n",
          "test.toml:9: inclusions[0].orientation = { tensor");

  Recipe made;  // in code: no line, but a group
  made.groups.resize(1);
  made.groups[0].count = 0;
  CHECK_THROWS_WITH(pack(made), Catch::Contains("group 0: count = 0; allowed"));
  CHECK_THROWS_WITH(
      pack(recipe_from_toml("[cell]\nsize = [1, 1, 1]\n" + ball + "count = 1\nradius = 0.4\n",
                            "test.toml", {"inclusions[0].radius=0.6"})),
      Catch::StartsWith("--set inclusions[0].radius=0.6: inclusions[0].radius = 0.6; inclusion"));
}

TEST_CASE("more inclusions than fit into any memory are refused before work") {
  const std::string wide = "[1e6, 1e6, 1e6]";
  const std::string balls = "[[inclusions]]\nshape = \"sphere\"\n";
  for (const std::string& order_text :
       {std::string("count = 2000000000\nradius = 1\n"),
        std::string("fraction = 0.1\nradius = 1\n"), std::string("radius = 1\n")}) {
    CHECK_THROWS_WITH(pack(order(balls + order_text, wide)), Catch::Contains("; allowed are "));
  }
  CHECK_THROWS_WITH(pack(order(balls + "radius = 1\n", wide)),
                    Catch::Contains("test.toml:5: inclusions[0].radius = 1; to fill the cell takes "
                                    "some 8.36e+16"));
}

TEST_CASE("bodies that may be turned are not refused as they were drawn") {
  const std::string slab = "[1, 1, 0.25]\nperiodic = [true, true, false]";
  const std::string rods =
      "[[inclusions]]\nshape = \"spherocylinder\"\naspect = 12\ncount = 20\nfraction = 0.04\n";
  CHECK_THROWS_WITH(pack(order(rods + "[packing]\nmethod = \"rsa\"\n", slab)),
                    Catch::Contains("wide along z"));
  CHECK(pack(order(rods + "[packing.rsa]\nredraw_orientations = true\n", slab)).target_reached);
}

TEST_CASE("bounds that refuse do not refuse what is possible") {
  // One sphere as wide as the cell and a hair less, between walls.
  const std::string tight = "[[inclusions]]\nshape = \"sphere\"\ncount = 1\nradius = 0.4999\n";
  const Recipe recipe = order(
      "[[inclusions]]\nshape = \"sphere\"\ncount = 1\nradius = 0.4\n"
      "[packing]\nmin_gap = 0.19\n");
  CHECK(pack(recipe).target_reached);
  CHECK(pack(order(tight)).target_reached);
}
