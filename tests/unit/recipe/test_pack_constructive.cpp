#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/recipe/pack.hpp"
#include "recipe/open_supply.hpp"
#include "scenes.hpp"

namespace packstone {
namespace {

Recipe order(const std::string& text) { return recipe_from_toml(text, "layers.toml"); }

const std::string kStrip = "[cell]\nsize = [30, 30]\nperiodic = [true, false]\n";
const std::string kBox = "[cell]\nsize = [9, 9, 9]\nperiodic = [true, true, false]\n";
const std::string kDisks =
    "[[inclusions]]\nname = \"disks\"\nshape = \"disk\"\n"
    "radius = { lognormal = { mu = -0.6, sigma = 0.5, min = 0.1, max = 2.5 } }\n";

std::string method(const std::string& name, const std::string& options = "") {
  return "[packing]\nmethod = \"" + name + "\"\n" + options;
}

std::string message_of(const std::string& text) {
  try {
    static_cast<void>(pack(order(text)));
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("advancing layers place what a recipe orders, orientations as drawn") {
  const PackOutcome outcome = pack(order(
      kStrip +
      "[[inclusions]]\nname = \"grains\"\nshape = \"ellipse\"\naspect = { uniform = [1.5, 3] }\n"
      "area = { uniform = [0.5, 5] }\nfraction = 0.74\norientation = { degrees = { normal = { "
      "mean = 20, std = 30, min = -70, max = 110 } } }\n" +
      method("advancing-layer")));
  CHECK(outcome.target_reached);
  CHECK(outcome.method == "advancing-layer");
  CHECK(outcome.packing.certificate->passed());
  REQUIRE(outcome.groups.size() == 1);
  CHECK(outcome.groups[0].count == outcome.groups[0].ordered_count);
  CHECK_FALSE(outcome.groups[0].turned);
  CHECK(outcome.groups[0].tensor->xx ==
        Approx(outcome.groups[0].ordered_tensor->xx).epsilon(1e-12));
  CHECK(outcome.trials > 0);
}

TEST_CASE("advancing layers tell where an order ends low, or has its sizes graded") {
  const auto derived = [](const std::string& fraction) {
    std::string all;
    for (const std::string& s :
         pack(order(kStrip + kDisks + "fraction = " + fraction + "\n" + method("advancing-layer")))
             .derived) {
      all += s + "\n";
    }
    return all;
  };
  CHECK_THAT(derived("0.5"), Catch::Contains("the cell is empty above"));
  CHECK_THAT(derived("0.8"), !Catch::Contains("the cell is empty above"));
  CHECK_THAT(derived("0.8"), !Catch::Contains("came last"));
  CHECK_THAT(derived("0.875"), Catch::Contains("came last"));
}

TEST_CASE("constructive methods fill a cell with a group of open count") {
  const PackOutcome layered = pack(order(kStrip + kDisks + method("advancing-layer")));
  const PackOutcome dropped = pack(order(kStrip + kDisks + method("drop-and-roll")));
  const PackOutcome published = pack(order(kStrip + kDisks + method("published-advancing-layer")));
  for (const PackOutcome* outcome : {&layered, &dropped, &published}) {
    CHECK(outcome->target_reached);
    CHECK(outcome->stop == "full");
    CHECK(outcome->packing.certificate->passed());
    CHECK_FALSE(outcome->groups[0].ordered_count.has_value());
  }
  CHECK(layered.groups[0].fraction > published.groups[0].fraction);
  CHECK(published.groups[0].fraction > 0.75);
  CHECK(layered.groups[0].fraction > dropped.groups[0].fraction + 0.02);
}

TEST_CASE("groups of known count stand among those of a group of open count") {
  const std::string text =
      kStrip + kDisks +
      "[[inclusions]]\nname = \"few\"\nshape = \"disk\"\nradius = 1\ncount = 20\n";
  for (const char* name : {"advancing-layer", "drop-and-roll"}) {
    const PackOutcome outcome = pack(order(text + method(name)));
    CHECK(outcome.target_reached);
    REQUIRE(outcome.groups[1].count == 20);
    std::vector<double> heights;
    for (const Inclusion& inclusion : outcome.packing.inclusions) {
      if (inclusion.group == 1) heights.push_back(inclusion.center.y);
    }
    CHECK(*std::min_element(heights.begin(), heights.end()) < 10.0);
    CHECK(*std::max_element(heights.begin(), heights.end()) > 18.0);
  }
}

TEST_CASE("OpenSupply gives every body of known number once, evenly or first") {
  const Recipe recipe = order(kStrip + kDisks);
  std::vector<OrderedBody> counted;
  for (int k = 1; k <= 7; ++k) counted.push_back({Disk{100.0 + k}, 1});
  for (const std::int64_t among : {std::int64_t{0}, std::int64_t{3}, std::int64_t{50}}) {
    recipe::OpenSupply supply(recipe, counted, among);
    std::vector<double> radii;
    for (std::int64_t k = 0; k < 120; ++k) {
      radii.push_back(std::get<Disk>(supply(k).body).radius);
    }
    double last = 0.0;
    std::int64_t seen = 0;
    for (std::size_t k = 0; k < radii.size(); ++k) {
      if (radii[k] < 100.0) continue;
      ++seen;
      CHECK(radii[k] > last);
      last = radii[k];
      CHECK(k < 7 + static_cast<std::size_t>(among));
    }
    CHECK(seen == 7);
  }
}

TEST_CASE("published advancing layers say what they overlap") {
  const PackOutcome outcome = pack(
      order(kStrip + "[[inclusions]]\nshape = \"ellipse\"\naspect = 2\narea = 1\nfraction = 0.6\n" +
            method("published-advancing-layer",
                   "[packing.published-advancing-layer]\n"
                   "spacing = 1\n")));
  REQUIRE(outcome.published_layer.has_value());
  CHECK(outcome.published_layer->overlaps.pairs > 0);
  CHECK(outcome.published_layer->overlaps.deepest > 0.0);
  CHECK_FALSE(outcome.packing.certificate->passed());
  CHECK_FALSE(outcome.target_reached);
}

TEST_CASE("spheres are dropped, and laid in cells periodic along every axis") {
  const std::string spheres =
      "[[inclusions]]\nshape = \"sphere\"\ncount = 400\nfraction = 0.5\n"
      "size = { lognormal = { mean = 1, std = 0.2, min = 0.5, max = 2 } }\n";
  CHECK(pack(order(kBox + spheres + method("drop-and-roll"))).target_reached);
  const PackOutcome laid =
      pack(order("[cell]\nsize = [9, 9, 9]\n" + spheres + method("advancing-layer")));
  CHECK(laid.target_reached);
  CHECK(laid.packing.certificate->passed());
}

TEST_CASE("an order that is too dense ends with what stands, and says so") {
  const PackOutcome outcome =
      pack(order(kStrip +
                 "[[inclusions]]\nshape = \"disk\"\ncount = 400\nfraction = 0.89\n"
                 "size = { uniform = [0.6, 1.4] }\n" +
                 method("advancing-layer")));
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.stop == "full");
  CHECK(outcome.packing.certificate->passed());
  CHECK(outcome.groups[0].count < 400);
  CHECK(outcome.groups[0].fraction > 0.77);
}

TEST_CASE("interrupted layers keep what stands") {
  std::atomic<bool> stop{false};
  RunContext run;
  run.cancel_flag(&stop).on_progress([&](const Progress&) { stop = true; });
  const PackOutcome outcome = pack(order("[cell]\nsize = [200, 200]\nperiodic = [true, false]\n" +
                                         kDisks + method("advancing-layer")),
                                   run);
  CHECK(outcome.stop == "cancelled");
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.packing.certificate->passed());
}

TEST_CASE("options of constructive methods are read, kept and written") {
  const Recipe read =
      order(kStrip + kDisks +
            method("advancing-layer",
                   "[packing.advancing-layer]\ntop_layer = 2.5\ncandidates = 7\nheld_back = 0.2\n"
                   "close_top = false\nmax_restarts = 1\n[packing.drop-and-roll]\ndrops = 9\n"
                   "[packing.published-advancing-layer]\nspacing = 0.25\ntop_layer = 1.1\n"));
  const Recipe again = recipe_from_json(recipe_to_json(read), "again");
  for (const Recipe& recipe : {read, again}) {
    CHECK(recipe.method == PackMethod::advancing_layer);
    CHECK(recipe.advancing_layer.top_layer == 2.5);
    CHECK(recipe.advancing_layer.candidates == 7);
    CHECK(recipe.advancing_layer.held_back == 0.2);
    CHECK_FALSE(recipe.advancing_layer.close_top);
    CHECK(recipe.advancing_layer.max_restarts == 1);
    CHECK(recipe.drop_and_roll.drops == 9);
    CHECK(recipe.published_advancing_layer.spacing == 0.25);
    CHECK(recipe.published_advancing_layer.top_layer == 1.1);
  }
  CHECK(recipe_to_json(read) == recipe_to_json(again));
}

TEST_CASE("constructive methods refuse what they do not take, with the line that orders them") {
  const auto starts = [](const std::string& text, const std::string& start) {
    CHECK(message_of(text).find(start) == 0);
  };
  const std::string rods = "[[inclusions]]\nshape = \"cylinder\"\naspect = 2\nradius = 0.3\n";
  starts(kBox + rods + method("drop-and-roll"),
         "layers.toml:9: packing.method = \"drop-and-roll\"; it takes disks and spheres, and group "
         "\"cylinder\" has the shape cylinder");
  starts(kBox + rods + method("published-advancing-layer"),
         "layers.toml:9: packing.method = \"published-advancing-layer\"; it takes disks and "
         "ellipses");
  starts(
      "[cell]\nsize = [30, 30]\n" + kDisks + method("drop-and-roll"),
      "layers.toml:8: packing.method = \"drop-and-roll\"; it lays bodies upon a floor: allowed are "
      "cells with cell.periodic = false along y");
  starts(kStrip + kDisks + method("published-advancing-layer", "min_gap = 0.1\n"),
         "layers.toml:9: packing.method = \"published-advancing-layer\"; it keeps no "
         "packing.min_gap");
  starts(
      kStrip + kDisks + method("advancing-layer", "[packing.advancing-layer]\ntop_layer = 1.1\n"),
      "layers.toml:11: packing.advancing-layer.top_layer = 1.1; allowed is a number >= 2");
  starts(
      kStrip + kDisks + method("advancing-layer", "[packing.advancing-layer]\nheld_back = 1.5\n"),
      "layers.toml:11: packing.advancing-layer.held_back = 1.5; allowed is a number >= 0 and <= "
      "1");
  starts(kStrip + kDisks + method("drop-and-roll", "[packing.drop-and-roll]\ndrops = 0\n"),
         "layers.toml:11: packing.drop-and-roll.drops = 0");
  starts(
      kStrip + kDisks +
          method("published-advancing-layer", "[packing.published-advancing-layer]\nspacing = 2\n"),
      "layers.toml:11: packing.published-advancing-layer.spacing = 2; allowed is a number >= 0.01 "
      "and <= 1");
  // Impossible laws.
  starts(kStrip + "[[inclusions]]\nshape = \"ellipse\"\naspect = -1\narea = 1\nfraction = 0.5\n" +
             method("advancing-layer"),
         "layers.toml:6: inclusions[0].aspect = -1; allowed is");
  starts(kStrip + "[[inclusions]]\nshape = \"ellipse\"\naspect = 0.5\narea = 1\nfraction = 0.5\n" +
             method("advancing-layer"),
         "layers.toml:6: inclusions[0].aspect = 0.5; aspect can be as small as 0.5, allowed of "
         "ellipses are values >= 1");
  starts(kStrip +
             "[[inclusions]]\nshape = \"ellipse\"\naspect = 2\narea = { uniform = [-1, 2] }\n"
             "fraction = 0.5\n" +
             method("advancing-layer"),
         "layers.toml:7: inclusions[0].area");
  starts(kStrip + "[[inclusions]]\nshape = \"disk\"\nradius = 16\n" + method("advancing-layer"),
         "layers.toml:6: inclusions[0].radius = 16; inclusion 0 cannot stand in the cell");
}

}  // namespace packstone
