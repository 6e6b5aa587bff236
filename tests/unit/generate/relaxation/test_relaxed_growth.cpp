#include "packstone/generate/relaxed_growth.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>

#include "growth_scenes.hpp"
#include "packstone/core/error.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "scenes.hpp"

namespace packstone {
namespace {

using Catch::Matchers::Contains;

const Cell kCube{};
const RelaxationOptions kQuick{.max_relocations = 0, .max_restarts = 3, .seed = 3};

SymMat3 tensor_of(const Packing& packing) { return orientation_tensor(symmetry_axes(packing, 0)); }

}  // namespace

TEST_CASE("spheres and disks grow until they jam, certified, near what random packings reach") {
  const RelaxedGrowthResult spheres =
      grow_relaxed(kCube, scenes::equal_spheres(150, 0.3), {.relaxation = kQuick});
  CHECK(spheres.stop == RelaxationStop::jammed);
  CHECK(spheres.at_rest);
  CHECK(check_packing(spheres.packing).passed());
  CHECK(fraction(spheres.packing) > 0.58);
  CHECK(fraction(spheres.packing) == Approx(0.3 * std::pow(spheres.size_factor, 3)));
  const RelaxedGrowthResult disks =
      grow_relaxed(cell_2d(1, 1), scenes::equal_disks(150, 0.3), {.relaxation = kQuick});
  CHECK(check_packing(disks.packing).passed());
  CHECK(fraction(disks.packing) > 0.78);
  CHECK(fraction(disks.packing) == Approx(0.3 * std::pow(disks.size_factor, 2)));
}

TEST_CASE("growing fibers keep their tensor, the least gap and all their proportions") {
  InclusionGroup group;
  group.shape = ShapeKind::spherocylinder;
  group.aspect.law = ConstantLaw{10.0};
  group.count = 60;
  group.fraction = 0.1;
  group.orientation = TensorOrientation{{0.7, 0.25, 0.05, 0, 0, 0}};
  const auto bodies = draw_inclusions(kCube, {group}, 5).bodies;
  RelaxedGrowthOptions options{.relaxation = kQuick};
  options.relaxation.min_gap = 1e-3;
  const RelaxedGrowthResult grown = grow_relaxed(kCube, bodies, options);
  CHECK(grown.stop == RelaxationStop::jammed);
  CHECK(check_packing(grown.packing, {.min_gap = 1e-3}).passed());
  CHECK(fraction(grown.packing) > 0.25);
  const SymMat3 change = tensor_of(grown.packing) - SymMat3{0.7, 0.25, 0.05, 0, 0, 0};
  CHECK(std::abs(change.xx) + std::abs(change.yy) + std::abs(change.xy) < 1e-12);
  const auto& one = std::get<Spherocylinder>(grown.packing.inclusions[0].body);
  CHECK(one.half_length / one.radius == Approx(10.0).epsilon(1e-12));
}

TEST_CASE("growth begins smaller where the size at the start does not come to rest") {
  const RelaxedGrowthResult grown = grow_relaxed(
      kCube, scenes::equal_spheres(60, 0.5),
      {.relaxation = {.patience = 20, .max_relocations = 0, .max_restarts = 0, .seed = 4},
       .start_factor = std::cbrt(0.72 / 0.5)});
  CHECK(grown.stop == RelaxationStop::jammed);
  CHECK(grown.at_rest);
  CHECK(check_packing(grown.packing).passed());
  CHECK(fraction(grown.packing) > 0.4);
}

TEST_CASE("growth that is told to stop hands out the last state at rest, if there was one") {
  std::atomic<bool> cancel{true};
  const auto bodies = scenes::equal_spheres(200, 0.3);
  const RelaxedGrowthResult at_once =
      grow_relaxed(kCube, bodies, {}, RunContext{}.cancel_flag(&cancel));
  CHECK(at_once.stop == RelaxationStop::cancelled);
  CHECK_FALSE(at_once.at_rest);
  CHECK(at_once.packing.inclusions.size() == bodies.size());
  const RelaxedGrowthResult late = grow_relaxed(kCube, scenes::equal_ellipsoids(400, 0.2, 3.0, 6),
                                                {.least_step = 1e-9}, RunContext{}.time_limit(0.3));
  CHECK(late.stop == RelaxationStop::out_of_time);
  CHECK(late.at_rest);
  CHECK(late.size_factor > 1.0);
  CHECK(check_packing(late.packing).passed());
}

TEST_CASE("growth gives the same bits for any number of threads") {
  const auto bodies = scenes::equal_ellipsoids(100, 0.3, 2.0, 7);
  const RelaxedGrowthOptions options{.relaxation = kQuick, .least_step = 0.02};
  const RelaxedGrowthResult one = grow_relaxed(kCube, bodies, options);
  const RelaxedGrowthResult three = grow_relaxed(kCube, bodies, options, RunContext{}.threads(3));
  CHECK(scenes::state_hash(one.packing) == scenes::state_hash(three.packing));
  CHECK(one.report.iterations == three.report.iterations);
}

TEST_CASE("options of growth that cannot be are refused by name, value and range") {
  const auto bodies = scenes::equal_spheres(5, 0.1);
  CHECK_THROWS_WITH(grow_relaxed(kCube, bodies, {.start_factor = 0.0}),
                    "RelaxedGrowthOptions::start_factor is 0; allowed is > 0");
  CHECK_THROWS_WITH(grow_relaxed(kCube, bodies, {.first_step = 1.5}),
                    Contains("first_step is 1.5; allowed is (0, 1]"));
  CHECK_THROWS_WITH(grow_relaxed(kCube, bodies, {.least_step = 0.1}),
                    Contains("least_step is 0.1; allowed is (0, first_step]"));
  CHECK_THROWS_AS(grow_relaxed(kCube, bodies, {.relaxation = {.patience = 0}}), InvalidArgument);
}

}  // namespace packstone
