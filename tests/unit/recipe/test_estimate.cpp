#include "recipe/estimate.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/geometry/measures.hpp"
#include "recipe/draw_mix.hpp"
#include "support/order.hpp"

namespace packstone {
namespace {

using Catch::Matchers::Contains;
using recipe::random_ceiling;
using test::order;

std::optional<double> ceiling_of(const std::string& groups, const std::string& size = "[1, 1, 1]") {
  return random_ceiling(recipe::draw_mix(order(groups, size)).bodies);
}

std::string rods(const std::string& more) {
  return "[[inclusions]]\nshape = \"spherocylinder\"\ncount = 400\n" + more + "\n";
}

const std::string kBalls = "[[inclusions]]\nshape = \"sphere\"\ncount = 1000\nfraction = ";

TEST_CASE("equal balls, disks, ellipsoids and ellipses are known to reach so much, others not") {
  CHECK(ceiling_of(kBalls + "0.1\n") == 0.64);
  const std::string two_axes = "count = 50\nfraction = 0.1\naspect = 2\n";
  CHECK(ceiling_of("[[inclusions]]\nshape = \"ellipsoid\"\n" + two_axes) == 0.74);
  CHECK(ceiling_of("[[inclusions]]\nshape = \"ellipse\"\n" + two_axes, "[1, 1]") == 0.90);
  CHECK(ceiling_of("[[inclusions]]\nshape = \"disk\"\ncount = 9\nfraction = 0.1\n", "[1, 1]") ==
        0.84);
  CHECK_FALSE(ceiling_of(kBalls + "0.1\nsize = { uniform = [1, 2] }\n").has_value());
  CHECK_FALSE(
      ceiling_of(kBalls + "0.1\n" + rods("name = \"r\"\nfraction = 0.1\naspect = 9")).has_value());
  CHECK_FALSE(ceiling_of("[[inclusions]]\nshape = \"cylinder\"\ncount = 9\nfraction = 0.1\n"
                         "aspect = 0.1\n")
                  .has_value());
}

TEST_CASE("long rods reach 7 over their aspect, and more the less they cross") {
  for (const double aspect : {50.0, 100.0, 200.0}) {
    const auto random = ceiling_of(rods("fraction = 0.01\naspect = " + std::to_string(aspect)));
    REQUIRE(random.has_value());
    CHECK(*random * aspect == Approx(7.0).epsilon(0.03));  // of 400 axes
  }
  // <|sin|> is 2 / pi in the plane and pi / 4 in space.
  const auto planar =
      ceiling_of(rods("fraction = 0.01\naspect = 50\norientation = { planar = \"xy\" }"));
  REQUIRE(planar.has_value());
  CHECK(*planar * 50 == Approx(7.0 * std::numbers::pi * std::numbers::pi / 8.0).epsilon(0.03));
  // Relaxations reached 0.175 in half a minute.
  const auto injected =
      ceiling_of(rods("fraction = 0.01\naspect = 50\n"
                      "orientation = { tensor = [[0.7, 0, 0], [0, 0.25, 0], [0, 0, 0.05]] }"));
  CHECK(*injected * 50 == Approx(9.1).epsilon(0.05));
  const auto parallel =
      ceiling_of(rods("fraction = 0.01\naspect = 50\norientation = { axis = [0, 0, 1] }"));
  CHECK(*parallel == Approx(std::numbers::pi / std::sqrt(12.0)));
}

TEST_CASE("rods of several lengths count by their mean aspect, shorter ones by a table") {
  const auto mixed = ceiling_of(
      "[[inclusions]]\nshape = \"spherocylinder\"\nfraction = 0.01\ndiameter = 0.005\n"
      "aspect = { uniform = [20, 60] }\n");
  REQUIRE(mixed.has_value());
  CHECK(*mixed == Approx(6.73 / 40.0).epsilon(0.05));
  CHECK(*ceiling_of(rods("fraction = 0.01\naspect = 10")) == Approx(0.46).epsilon(0.02));
  CHECK(*ceiling_of(rods("fraction = 0.01\naspect = 5")) < 0.62);
  CHECK(*ceiling_of(rods("fraction = 0.01\naspect = 0.5")) == Approx(0.72).epsilon(0.01));
}

TEST_CASE("a plan tells the method, the reason, what is reachable and a time") {
  const PackPlan plan = plan_pack(order(kBalls + "0.5\n"));
  CHECK(plan.method == "relaxation");
  CHECK_THAT(plan.method_reason, Contains("denser than rsa"));
  CHECK(plan.count == 1000);
  CHECK(plan.fraction == Approx(0.5));
  CHECK(plan.reachable == 0.64);
  REQUIRE(plan.seconds.has_value());
  CHECK(*plan.seconds > 1e-3);
  CHECK(*plan.seconds < 0.2);
  CHECK(plan.warning.empty());
}

TEST_CASE("a plan warns of what is denser than random packings, and knows no time for it") {
  for (const std::string& method : {std::string("relaxation"), std::string("event-driven")}) {
    const PackPlan plan =
        plan_pack(order(kBalls + "0.66\n[packing]\nmethod = \"" + method + "\"\n"));
    CHECK_THAT(plan.warning, Contains("above the 0.64"));
    CHECK_FALSE(plan.seconds.has_value());
  }
  const PackPlan stuck = plan_pack(order(kBalls + "0.5\n[packing]\nmethod = \"rsa\"\n"));
  CHECK_THAT(stuck.warning, Contains("saturates before such a fraction"));
  // Gaps take room.
  const std::string wide = "[packing]\nmethod = \"relaxation\"\nmin_gap = 0.01\n";
  CHECK_THAT(plan_pack(order(kBalls + "0.55\n" + wide)).warning, Contains("above the 0.64"));
  CHECK(plan_pack(order(kBalls + "0.66\n[packing.event-driven]\ngoal = \"densest\"\n"))
            .warning.empty());
}

TEST_CASE("goals of any size are not warned of, and take what jamming takes") {
  for (const std::string& method : {std::string("relaxation"), std::string("event-driven")}) {
    const PackPlan plan = plan_pack(order(kBalls + "0.5\n[packing]\nmethod = \"" + method +
                                          "\"\n[packing." + method + "]\ngoal = \"densest\"\n"));
    CHECK(plan.warning.empty());
    CHECK(plan.seconds.value_or(0.0) >= 1.0);
  }
}

TEST_CASE("a plan is told before the work, stands in the outcome, and refuses what is impossible") {
  std::string told;
  const PackOutcome outcome =
      pack(order(kBalls + "0.1\n"), {}, {}, [&](const PackPlan& plan) { told = plan.method; });
  CHECK(told == "rsa");
  CHECK(outcome.plan.count == 1000);
  CHECK_THROWS_AS(plan_pack(order(kBalls + "0.75\n")), InvalidArgument);
  const PackPlan open = plan_pack(order("[[inclusions]]\nshape = \"sphere\"\nradius = 0.05\n"));
  CHECK(open.count == 0);
  CHECK_FALSE(open.seconds.has_value());
}

}  // namespace
}  // namespace packstone
