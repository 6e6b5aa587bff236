#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "support/order.hpp"

namespace packstone {
namespace {

using test::order;

// More than random sequential adsorption places, and a tensor to keep.
const std::string kFibers = R"(
[[inclusions]]
name = "fibers"
shape = "spherocylinder"
aspect = 10
count = 60
fraction = 0.25
orientation = { tensor = [[0.7, 0, 0], [0, 0.25, 0], [0, 0, 0.05]] }
[packing]
)";

const std::string kTooMany = R"(
[[inclusions]]
shape = "ellipsoid"
aspect = 2
count = 30
fraction = 0.8
[packing]
method = "relaxation"
[packing.relaxation]
max_restarts = 0
max_relocations = 1
)";

double tensor_change(const GroupOutcome& group) {
  const SymMat3 d = *group.tensor - *group.ordered_tensor;
  return std::max({std::abs(d.xx), std::abs(d.yy), std::abs(d.zz), std::abs(d.xy), std::abs(d.xz),
                   std::abs(d.yz)});
}

TEST_CASE("auto relaxes what rsa does not surely place, with the tensor ordered, certified") {
  const PackOutcome outcome = pack(order(kFibers + "min_gap = 0.001\n"));
  CHECK(outcome.target_reached);
  CHECK(outcome.method == "relaxation");
  CHECK_THAT(outcome.method_reason, Catch::StartsWith("auto"));
  CHECK(outcome.packing.certificate == check_packing(outcome.packing, {.min_gap = 0.001}));
  CHECK(outcome.packing.certificate->passed());
  REQUIRE(outcome.relaxation.has_value());
  CHECK(outcome.relaxation->report.iterations > 0);
  CHECK(outcome.relaxation->history.size() > 1);
  CHECK(outcome.groups[0].turned);
  CHECK(tensor_change(outcome.groups[0]) < 1e-12);
}

TEST_CASE("fibers of one diameter and many lengths are relaxed with the tensor ordered") {
  const std::string group =
      "[[inclusions]]\nshape = \"spherocylinder\"\ndiameter = 0.03\n"
      "length = { lognormal = { mean = 0.4, std = 0.2, min = 0.1, max = 0.9 } }\n"
      "fraction = 0.15\norientation = { tensor = [[0.7, 0, 0], [0, 0.25, 0], [0, 0, 0.05]] }\n";
  const PackOutcome outcome = pack(order(group + "[packing]\nmethod = \"relaxation\"\n"));
  CHECK(outcome.target_reached);
  CHECK(outcome.packing.certificate->passed());
  CHECK(outcome.groups[0].turned);
  CHECK(tensor_change(outcome.groups[0]) < 1e-10);
  CHECK(std::abs(outcome.groups[0].tensor->xx - 0.7) < 1e-10);
  double shortest = 1.0, longest = 0.0;
  for (const Inclusion& inclusion : outcome.packing.inclusions) {
    const auto& fiber = std::get<Spherocylinder>(inclusion.body);
    CHECK(fiber.radius == 0.015);
    shortest = std::min(shortest, 2.0 * fiber.half_length);
    longest = std::max(longest, 2.0 * fiber.half_length);
  }
  CHECK(shortest >= 0.1 * (1.0 - 1e-12));
  CHECK(longest <= 0.9 * (1.0 + 1e-12));
  CHECK(longest > 2.0 * shortest);
}

TEST_CASE("lengths by volume weigh as their law says") {
  const InclusionMix mix = draw_inclusions(
      Cell{},
      order("[[inclusions]]\nshape = \"cylinder\"\ndiameter = 0.001\ncount = 20000\n"
            "length = { uniform = [0.1, 0.3], by = \"volume\" }\n")
          .groups,
      1);
  double sum = 0.0, weighted = 0.0;
  for (const OrderedBody& ordered : mix.bodies) {
    const double length = 2.0 * std::get<Cylinder>(ordered.body).half_length;
    sum += length;
    weighted += length * length;
  }
  CHECK(weighted / sum == Approx(0.2).epsilon(0.01));
  CHECK(sum / 20000 == Approx(0.2 / std::log(3.0)).epsilon(0.01));  // density as 1 / length
}

TEST_CASE("a relaxation gives the same bits for the recipe in the provenance") {
  const PackOutcome first = pack(order(kFibers));
  const Recipe again = recipe_of_packing(first.packing, "again.json");
  CHECK(again.method == PackMethod::automatic);
  CHECK(scenes::state_hash(pack(again, RunContext{}.threads(3)).packing) ==
        scenes::state_hash(first.packing));
}

TEST_CASE("a recipe says how bodies turn and where they start") {
  const std::string ordered = kFibers + "method = \"relaxation\"\n[packing.relaxation]\n";
  const PackOutcome free = pack(order(ordered + "rotate = \"free\"\nstart = \"random\"\n"));
  CHECK(free.target_reached);
  CHECK(tensor_change(free.groups[0]) > 1e-6);
  const PackOutcome locked =
      pack(order(ordered + "rotate = \"locked\"\nstart_fraction = 0.05\n", "[1, 1, 1]"));
  CHECK_FALSE(locked.groups[0].turned);
  CHECK(tensor_change(locked.groups[0]) == 0.0);
}

TEST_CASE("auto goes on as growth where relaxations stall, but not where tensors are ordered") {
  const std::string impatient = "[packing.relaxation]\npatience = 1\nmax_relocations = 0\n";
  const std::string rods =
      "[[inclusions]]\nshape = \"spherocylinder\"\naspect = 20\ncount = 150\nfraction = 0.2\n";
  const PackOutcome grown = pack(order(rods + impatient + "start = \"random\"\n"));
  CHECK(grown.method == "event-driven");
  CHECK(grown.method_reason == "auto: relaxations stalled");
  CHECK(grown.target_reached);
  const PackOutcome kept =
      pack(order(kFibers + "[packing.relaxation]\npatience = 1\nrelocated_share = 0\n"
                           "start = \"random\"\nmax_restarts = 0\n"));
  CHECK(kept.method == "relaxation");
}

TEST_CASE("a relaxation that ends with overlaps is kept, with the certificate that says so") {
  const PackOutcome outcome = pack(order(kTooMany));
  CHECK_FALSE(outcome.target_reached);
  CHECK(outcome.stop == "stalled");
  CHECK(outcome.packing.inclusions.size() == 30);
  REQUIRE(outcome.packing.certificate.has_value());
  CHECK_FALSE(outcome.packing.certificate->passed());
  CHECK(outcome.packing.certificate->overlaps > 0);
  CHECK_FALSE(outcome.deepest_crossing.has_value());
}

TEST_CASE("what crosses a wall when a relaxation is interrupted is told") {
  const std::atomic<bool> cancelled{true};
  const PackOutcome outcome =
      pack(order(kTooMany + "start = \"random\"\n", "[1, 1, 1]\nperiodic = [true, true, false]"),
           RunContext{}.cancel_flag(&cancelled));
  REQUIRE(outcome.deepest_crossing.has_value());
  CHECK(outcome.deepest_crossing->axis == 2);
  CHECK(outcome.deepest_crossing->depth > 0.01);
}

const std::string kDensest = R"(
[[inclusions]]
shape = "spherocylinder"
aspect = 20
count = 60
fraction = 0.05
orientation = { tensor = [[0.7, 0, 0], [0, 0.25, 0], [0, 0, 0.05]] }
[packing.relaxation]
goal = "densest"
max_relocations = 0
least_step = 0.02
)";

TEST_CASE("the goal densest grows fibers far beyond the size ordered, with their tensor") {
  const PackOutcome outcome = pack(order(kDensest));
  CHECK(outcome.method == "relaxation");
  CHECK_THAT(outcome.method_reason, Catch::Contains("goal"));
  CHECK(outcome.stop == "jammed");
  CHECK(outcome.target_reached);
  CHECK(outcome.packing.certificate->passed());
  CHECK(outcome.packing.certificate->fraction > 0.15);
  CHECK(outcome.relaxation->size_factor ==
        Approx(std::cbrt(outcome.packing.certificate->fraction / 0.05)));
  CHECK(tensor_change(outcome.groups[0]) < 1e-10);
  const Recipe again = recipe_of_packing(outcome.packing, "again.json");
  CHECK(scenes::state_hash(pack(again).packing) == scenes::state_hash(outcome.packing));
}

TEST_CASE("with the goal densest nothing is too large, and a time limit is an end like another") {
  std::string larger = kDensest;
  larger.replace(larger.find("0.05"), 4, "0.90");
  const PackOutcome outcome = pack(order(larger), RunContext{}.time_limit(1.0));
  CHECK(outcome.target_reached);
  CHECK(outcome.relaxation->size_factor < 0.8);
  CHECK(outcome.packing.certificate->passed());
  const std::atomic<bool> cancelled{true};
  const PackOutcome halted = pack(order(larger), RunContext{}.cancel_flag(&cancelled));
  CHECK_FALSE(halted.target_reached);
  CHECK(halted.stop == "cancelled");
}

TEST_CASE("an interrupted relaxation keeps its state and says that it was interrupted") {
  const std::atomic<bool> cancelled{true};
  const PackOutcome outcome = pack(order(kTooMany), RunContext{}.cancel_flag(&cancelled));
  CHECK(outcome.stop == "cancelled");
  CHECK(outcome.packing.certificate.has_value());
}

}  // namespace
}  // namespace packstone
