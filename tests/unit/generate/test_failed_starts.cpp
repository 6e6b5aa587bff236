// What happens when a start of random sequential adsorption fails: another one, or none.

#include "generate/rsa/failed_starts.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "rsa_oracle.hpp"

namespace packstone {

using namespace rsa_oracle;

TEST_CASE("starts are hopeless when eight of them end far below the order, and not before") {
  RandomStream random(17, StreamId::test);
  rsa::FailedStarts failed(0.50, 0.002);
  for (int start = 0; start < 7; ++start) {
    failed.add(0.36 + 0.003 * random.normal());
    CHECK_FALSE(failed.hopeless());
  }
  failed.add(0.36);
  CHECK(failed.hopeless());
}

TEST_CASE("starts that end a few deviations or a few bodies short are never hopeless") {
  RandomStream random(18, StreamId::test);
  rsa::FailedStarts scattered(0.36, 1e-4);
  rsa::FailedStarts alike(0.36, 0.05);
  for (int start = 0; start < 1000; ++start) {
    scattered.add(0.33 + 0.005 * random.normal());
    alike.add(0.31);
    REQUIRE_FALSE(scattered.hopeless());
    REQUIRE_FALSE(alike.hopeless());
  }
}

TEST_CASE("an order far above what RSA reaches ends by itself with the best packing") {
  // Disks saturate near 0.547, parallel cylinders below 0.5.
  const auto equal = [](const Body& body, double wanted) {
    const auto count = static_cast<std::size_t>(wanted / volume(body));
    return std::vector<OrderedBody>(count, {body, 0});
  };
  const std::vector<OrderedBody> disks = equal(Disk{0.02}, 0.70);
  const std::vector<OrderedBody> rods = equal(Cylinder{0.04, 0.12, {0, 0, 1}}, 0.75);
  for (const auto& [cell, bodies] : {std::pair{cell_2d(1, 1), disks}, {Cell{}, rods}}) {
    RsaResult result = rsa_pack(cell, bodies, with_seed(5));
    CHECK(result.stop == RsaStop::saturated);
    CHECK(result.restarts < 100);
    CHECK(result.packing.inclusions.size() < bodies.size());
    result.packing.groups = {"all"};
    CHECK(check_packing(result.packing).passed());
  }
}

TEST_CASE("rsa_pack starts afresh when a body is proven not to fit, and says how often") {
  // 21 spheres at 0.34 of the cell fit in some starts only.
  const double radius = std::cbrt(0.34 * 3.0 / (4.0 * std::numbers::pi * 21));
  const std::vector<OrderedBody> bodies(21, OrderedBody{Sphere{radius}, 0});
  RsaOptions options = with_seed(3);
  options.max_restarts = 0;
  const RsaResult once = rsa_pack(Cell{}, bodies, options);
  options.max_restarts = 1000;
  const RsaResult result = rsa_pack(Cell{}, bodies, options);
  REQUIRE(result.stop == RsaStop::target_reached);
  require_valid(result.packing);
  if (once.stop == RsaStop::target_reached) {
    CHECK(result.restarts == 0);
  } else {
    CHECK(once.stop == RsaStop::saturated);
    CHECK(once.restarts == 0);
    CHECK(result.restarts > 0);
  }
  // 0.52 is out of reach: the fullest start is kept.
  const double large = std::cbrt(0.52 * 3.0 / (4.0 * std::numbers::pi * 21));
  options.max_restarts = 20;
  const RsaResult best =
      rsa_pack(Cell{}, std::vector<OrderedBody>(21, OrderedBody{Sphere{large}, 0}), options);
  CHECK(best.stop == RsaStop::saturated);
  CHECK(best.restarts == 20);
  CHECK(best.packing.inclusions.size() > 12);
  require_valid(best.packing);
}

TEST_CASE("rsa_pack keeps the fullest start of many equal spheres, and stops when asked to") {
  const std::vector<OrderedBody> bodies(400, OrderedBody{Sphere{0.067}, 0});  // 0.50 of the cell.
  RsaOptions options = with_seed(4);
  options.max_restarts = 0;
  const RsaResult once = rsa_pack(Cell{}, bodies, options);
  options.max_restarts = 4;
  const RsaResult best = rsa_pack(Cell{}, bodies, options);
  CHECK(once.stop == RsaStop::saturated);
  CHECK(best.stop == RsaStop::saturated);
  CHECK(best.restarts == 4);
  CHECK(best.trials > once.trials);
  CHECK(best.packing.inclusions.size() > once.packing.inclusions.size());
  CHECK(best.packing.inclusions.size() < 330);
  require_valid(best.packing);
  CHECK(count_fitting(best.packing, bodies.front().body, false, 8'000) == 0);

  const std::atomic<bool> cancel{true};
  const RsaResult cancelled = rsa_pack(Cell{}, bodies, options, RunContext{}.cancel_flag(&cancel));
  CHECK(cancelled.stop == RsaStop::cancelled);
  CHECK(cancelled.restarts == 0);
}

TEST_CASE("rsa_pack gives a body up after max_trials") {
  const double radius = std::cbrt(0.45 * 3.0 / (4.0 * std::numbers::pi * 21));
  RsaOptions options = with_seed(3);
  options.max_trials = 20;
  options.max_restarts = 2;
  const RsaResult result =
      rsa_pack(Cell{}, std::vector<OrderedBody>(21, OrderedBody{Sphere{radius}, 0}), options);
  CHECK(result.stop == RsaStop::given_up);
  CHECK(result.restarts == 2);
  require_valid(result.packing);
}

}  // namespace packstone
