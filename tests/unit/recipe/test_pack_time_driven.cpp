#include <catch2/catch.hpp>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/recipe/pack.hpp"
#include "scenes.hpp"
#include "support/order.hpp"

namespace packstone {
namespace {

using test::order;

std::string mixture(const std::string& fraction) {
  return "[[inclusions]]\nname = \"rods\"\nshape = \"cylinder\"\naspect = 3\ncount = 20\nfraction "
         "= " +
         fraction +
         "\n[[inclusions]]\nname = \"balls\"\nshape = \"sphere\"\ncount = 20\nfraction = " +
         fraction + "\n[packing]\nmethod = \"time-driven\"\n";
}

TEST_CASE("the published relaxation is done where the certificate says so, whatever it believes") {
  const PackOutcome thin = pack(order(mixture("0.02")));
  REQUIRE(thin.time_driven.has_value());
  CHECK(thin.method == "time-driven");
  CHECK(thin.target_reached == thin.packing.certificate->passed());
  const PackOutcome dense = pack(order(mixture("0.25")));
  CHECK_FALSE(dense.target_reached);
  CHECK(dense.stop == "relaxed");
  CHECK(dense.time_driven->potential_energy < 1e-6 * dense.time_driven->start_energy);
  CHECK(dense.time_driven->overlaps > 0);
  CHECK(dense.packing.certificate->overlaps > 0);
  CHECK(dense.time_driven->history.size() > 3);
}

TEST_CASE("options of the published relaxation are read, kept and written") {
  const std::string options =
      "[packing.time-driven]\nliteral = true\nintegrator = \"leapfrog\"\ntime_step = 0.05\n"
      "damping = 2\nberendsen = 0.2\nberendsen_temperature = 0.01\nnose_hoover = 0.5\n"
      "nose_hoover_temperature = 0.2\nstagnation_steps = 100\nstagnation_drop = 0.25\n"
      "reshuffles = 1\nreshuffle_steps = 50\nrescale = 3\nrescale_limit = 9\n"
      "energy_threshold = 1e-9\nmax_steps = 10\nhistory_every = 2\noverlap_volume_every = 1\n"
      "overlap_points = 32\n";
  const Recipe recipe = order(mixture("0.1") + options);
  const TimeDrivenOptions& read = recipe.time_driven;
  CHECK(read.literal);
  CHECK(read.integrator == TimeDrivenIntegrator::leapfrog);
  CHECK(read.time_step == 0.05);
  CHECK(read.nose_hoover_temperature == 0.2);
  CHECK(read.reshuffles == 1);
  CHECK(read.overlap_points == 32);
  const std::string json = recipe_to_json(recipe);
  CHECK(recipe_to_json(recipe_from_json(json, "again.json")) == json);
  const PackOutcome outcome = pack(recipe);
  CHECK(outcome.stop == "steps_used_up");
  CHECK(outcome.time_driven->steps == 10);
  CHECK(outcome.time_driven->history.back().overlap_measured);
}

TEST_CASE("what the published relaxation cannot do is refused") {
  CHECK_THROWS_WITH(pack(order(mixture("0.1") + "min_gap = 0.01\n")),
                    Catch::Contains("knows no least gap"));
  CHECK_THROWS_AS(
      pack(order("[[inclusions]]\nshape = \"ellipsoid\"\naspect = 2\ncount = 5\nfraction "
                 "= 0.1\n[packing]\nmethod = \"time-driven\"\n")),
      InvalidArgument);
}

}  // namespace
}  // namespace packstone
