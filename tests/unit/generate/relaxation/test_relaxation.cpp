#include "packstone/generate/relaxation.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>

#include "growth_scenes.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "scenes.hpp"

namespace packstone {
namespace {

using Catch::Matchers::Contains;

const Cell kCube{3, {1, 1, 1}, {true, true, true}};
const Cell kSquare{2, {1, 1, 0}, {true, true, false}};

void require_done(const RelaxationResult& result, double min_gap = 0.0) {
  REQUIRE(result.stop == RelaxationStop::target_reached);
  const Certificate certificate = check_packing(result.packing, {.min_gap = min_gap});
  REQUIRE(certificate.passed());
}

std::vector<OrderedBody> copies(const Body& body, int count) {
  return std::vector<OrderedBody>(static_cast<std::size_t>(count), OrderedBody{body, 0});
}

// Fibers whose tensor is exactly `tensor`.
std::vector<OrderedBody> fibers(const SymMat3& tensor, double aspect, double fraction,
                                ShapeKind shape, std::uint64_t seed) {
  InclusionGroup group;
  group.name = "fibers";
  group.shape = shape;
  group.dimensions = Vec3{0.2 / aspect, 0.2, 0};
  group.fraction = fraction;
  group.orientation = TensorOrientation{tensor};
  return draw_inclusions(kCube, {group}, seed).bodies;
}

SymMat3 tensor_of(const Packing& packing) { return orientation_tensor(symmetry_axes(packing, 0)); }

double largest_difference(const SymMat3& a, const SymMat3& b) {
  const SymMat3 d = a - b;
  return std::max({std::abs(d.xx), std::abs(d.yy), std::abs(d.zz), std::abs(d.yz), std::abs(d.xz),
                   std::abs(d.xy)});
}

}  // namespace

TEST_CASE("bodies of every shape are relaxed to a certified packing") {
  for (const std::uint64_t seed : {1, 2}) {
    const RelaxationOptions options{.seed = seed};
    require_done(relaxation_pack(kCube, scenes::equal_spheres(100, 0.55), options));
    require_done(relaxation_pack(kCube, scenes::equal_ellipsoids(60, 0.55, 2.0, seed), options));
    require_done(relaxation_pack(kCube, scenes::equal_ellipsoids(60, 0.4, 0.3, seed), options));
    require_done(relaxation_pack(
        kCube, scenes::ellipsoids(scenes::alike("scalene", 60, 0.5, 1.5, 2.5), seed), options));
    require_done(relaxation_pack(kCube, scenes::equal_cylinders(50, 0.5, 1.0, seed), options));
    require_done(
        relaxation_pack(kCube, scenes::cylinders_and_spheres(20, 0.25, 0.25, 5, seed), options));
    require_done(relaxation_pack(kSquare, scenes::equal_disks(100, 0.75), options));
    require_done(relaxation_pack(kSquare, scenes::equal_ellipses(100, 0.75, 2.0, seed), options));
  }
}

TEST_CASE("a relaxation keeps the least gap that is ordered, as well as walls") {
  const Cell walled{3, {1, 1, 1}, {true, false, false}};
  const RelaxationOptions options{.min_gap = 0.01, .seed = 3};
  const RelaxationResult result =
      relaxation_pack(walled, scenes::cylinders_and_spheres(15, 0.15, 0.15, 3, 3), options);
  require_done(result, 0.01);
  CHECK(result.packing.inclusions.size() == 30);
}

TEST_CASE("bodies a thousand times smaller than others are relaxed among them") {
  std::vector<OrderedBody> bodies = copies(Sphere{0.3}, 1);
  for (int k = 0; k < 300; ++k) bodies.push_back({Sphere{3e-4}, 0});
  require_done(relaxation_pack(kCube, bodies, {.seed = 4}));
}

TEST_CASE("one body keeps off its own images by turning") {
  // Along an edge of the cell it would overlap itself; along a diagonal it does not.
  const Spherocylinder needle{0.03, 0.5, {1, 0, 0}};
  const std::vector<OrderedBody> one = copies(needle, 1);
  require_done(relaxation_pack(kCube, one, {.turn = {RelaxationTurn::free}, .seed = 5}));
}

TEST_CASE("a held tensor stays what it is while the bodies turn; a free one drifts") {
  const SymMat3 tensor{0.7, 0.25, 0.05, 0, 0, 0};
  for (const ShapeKind shape : {ShapeKind::spherocylinder, ShapeKind::cylinder}) {
    const std::vector<OrderedBody> bodies = fibers(tensor, 10, 0.2, shape, 6);
    const RelaxationResult held = relaxation_pack(kCube, bodies, {.seed = 6});
    require_done(held);
    CHECK(largest_difference(tensor_of(held.packing), tensor) < 1e-12);
    const RelaxationResult free =
        relaxation_pack(kCube, bodies, {.turn = {RelaxationTurn::free}, .seed = 6});
    require_done(free);
    CHECK(largest_difference(tensor_of(free.packing), tensor) > 1e-5);
    int turned = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      turned += *symmetry_axis(held.packing.inclusions[i].body) != *symmetry_axis(bodies[i].body);
    }
    CHECK(turned > static_cast<int>(bodies.size()) / 2);
  }
}

TEST_CASE("planar fibers stay in their plane, and locked ones as they are") {
  const std::vector<OrderedBody> bodies =
      fibers({0.5, 0.5, 0, 0, 0, 0}, 10, 0.12, ShapeKind::spherocylinder, 7);
  const RelaxationResult planar = relaxation_pack(kCube, bodies, {.seed = 7});
  require_done(planar);
  for (const Vec3& axis : symmetry_axes(planar.packing, 0)) REQUIRE(std::abs(axis.z) < 1e-14);
  CHECK(largest_difference(tensor_of(planar.packing), {0.5, 0.5, 0, 0, 0, 0}) < 1e-12);

  const RelaxationResult locked =
      relaxation_pack(kCube, bodies, {.turn = {RelaxationTurn::locked}, .seed = 7});
  require_done(locked);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    REQUIRE(locked.packing.inclusions[i].body == bodies[i].body);
  }
}

TEST_CASE("a relaxation gives the same bits for any number of threads") {
  const std::vector<OrderedBody> bodies = scenes::cylinders_and_spheres(400, 0.2, 0.2, 3, 8);
  const auto hash = [&](int threads) {
    const auto result = relaxation_pack(kCube, bodies, {.seed = 8}, RunContext{}.threads(threads));
    require_done(result);
    return scenes::state_hash(result.packing);
  };
  const std::uint64_t one = hash(1);
  CHECK(hash(2) == one);
  CHECK(hash(5) == one);
}

TEST_CASE("relax() opens the gaps of a packing, and moves one that has them by nothing") {
  const RelaxationResult first =
      relaxation_pack(kCube, scenes::equal_ellipsoids(80, 0.4, 2.0, 9), {.seed = 9});
  require_done(first);
  const RelaxationResult wider = relax(first.packing, {.min_gap = 0.005, .seed = 9});
  require_done(wider, 0.005);
  const RelaxationResult same = relax(wider.packing, {.min_gap = 0.0, .seed = 9});
  require_done(same);
  CHECK(same.report.iterations == 0);
  CHECK(scenes::state_hash(same.packing) == scenes::state_hash(wider.packing));
}

TEST_CASE("what cannot be relaxed ends with the best state, which the check calls overlapping") {
  const RelaxationOptions options{.max_relocations = 2, .max_restarts = 1, .seed = 10};
  const RelaxationResult result =
      relaxation_pack(kCube, scenes::equal_ellipsoids(30, 0.8, 2.0, 10), options);
  CHECK(result.stop == RelaxationStop::stalled);
  CHECK(result.report.restarts == 1);
  CHECK(result.report.relocated > 0);
  CHECK(result.report.energy > 0.0);
  const Certificate certificate = check_packing(result.packing);
  CHECK_FALSE(certificate.passed());
  CHECK(-certificate.smallest_gap <= 1.01 * result.report.deepest);
}

TEST_CASE("a relaxation that is told to stop hands out the best state so far") {
  std::atomic<bool> cancel{true};
  const auto bodies = scenes::equal_spheres(200, 0.6);
  const RelaxationResult cancelled =
      relaxation_pack(kCube, bodies, {.seed = 11}, RunContext{}.cancel_flag(&cancel));
  CHECK(cancelled.stop == RelaxationStop::cancelled);
  CHECK(cancelled.packing.inclusions.size() == bodies.size());
  const RelaxationResult late =
      relaxation_pack(kCube, bodies, {.seed = 11}, RunContext{}.deadline(RunContext::Clock::now()));
  CHECK(late.stop == RelaxationStop::out_of_time);
}

TEST_CASE("bodies for which no start is given start at random places of their own") {
  std::atomic<bool> cancel{true};
  const RelaxationStart first_only = [](std::int64_t) {
    return std::vector<Vec3>{{0.3, 0.4, 0.5}};
  };
  const RelaxationResult result =
      relaxation_pack(kCube, scenes::equal_spheres(200, 0.1), {.seed = 11},
                      RunContext{}.cancel_flag(&cancel), first_only);
  const std::vector<Inclusion>& inclusions = result.packing.inclusions;
  REQUIRE(inclusions.size() == 200);
  CHECK(inclusions[0].center == Vec3{0.3, 0.4, 0.5});
  for (std::size_t i = 1; i < inclusions.size(); ++i) {
    CHECK(inclusions[i].center != inclusions[i - 1].center);
  }
}

TEST_CASE("the energy of the history never rises but where bodies are relocated") {
  const RelaxationResult result =
      relaxation_pack(kCube, scenes::equal_spheres(200, 0.6), {.relocated_share = 0.0, .seed = 12});
  require_done(result);
  REQUIRE(result.history.size() > 10);
  for (std::size_t k = 1; k < result.history.size(); ++k) {
    REQUIRE(result.history[k].energy <= result.history[k - 1].energy);
    REQUIRE(result.history[k].iteration > result.history[k - 1].iteration);
  }
}

TEST_CASE("options and bodies that cannot be are refused by name, value and range") {
  const auto bodies = scenes::equal_spheres(10, 0.2);
  const auto refused = [&](const RelaxationOptions& options, const char* words) {
    CHECK_THROWS_WITH(relaxation_pack(kCube, bodies, options), Contains(words));
  };
  refused({.min_gap = -1.0}, "RelaxationOptions::min_gap is -1");
  refused({.inflation = 0.0}, "RelaxationOptions::inflation is 0; allowed is (0, 0.1]");
  refused({.patience = 0}, "RelaxationOptions::patience is 0");
  refused({.relocated_share = 1.5}, "RelaxationOptions::relocated_share is 1.5");
  refused({.max_relocations = -1}, "max_relocations is -1; allowed is >= 0");
  refused({.max_restarts = -1}, "max_restarts is -1; allowed is >= 0");
  CHECK_THROWS_WITH(relaxation_pack(kCube, {{Sphere{0.1}, 0}, {Sphere{0.1}, 1}},
                                    {.turn = {RelaxationTurn::free}}),
                    Contains("turn has 1 entries"));
  CHECK_THROWS_AS(relaxation_pack(kCube, copies(Sphere{0.6}, 1)), InvalidArgument);
  CHECK_THROWS_AS(relaxation_pack(kCube, copies(Sphere{0.3}, 20)), InvalidArgument);
  CHECK_THROWS_AS(relaxation_pack(kSquare, bodies), InvalidArgument);
}

}  // namespace packstone
