#include "packstone/generate/advancing_layer.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../constructive/resting.hpp"
#include "constructive_scenes.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"

namespace packstone {
namespace {

std::vector<OrderedBody> first_of(const BodySource& supply, std::int64_t count) {
  std::vector<OrderedBody> bodies;
  for (std::int64_t k = 0; k < count; ++k) bodies.push_back(supply(k));
  return bodies;
}

void require_valid(const ConstructiveResult& result, double min_gap = 0.0) {
  Packing packing = result.packing;
  packing.groups = {"bodies", "others"};
  REQUIRE_FALSE(packing.inclusions.empty());
  CHECK(check_packing(packing, {.min_gap = min_gap}).passed());
}

void require_all_placed(const ConstructiveResult& result, const std::vector<OrderedBody>& bodies,
                        double min_gap = 0.0) {
  require_valid(result, min_gap);
  CHECK(result.stop == ConstructiveStop::target_reached);
  REQUIRE(result.packing.inclusions.size() == bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    CHECK(result.packing.inclusions[k].body == bodies[k].body);
    CHECK(result.packing.inclusions[k].group == bodies[k].group);
  }
}

ConstructiveResult pack_scene(const BodySource& supply, std::int64_t count, double fraction,
                              bool periodic, const AdvancingLayerOptions& options = {}) {
  const Cell cell = scenes::cell_for(supply, count, fraction, periodic);
  const auto bodies = first_of(supply, count);
  ConstructiveResult result = advancing_layer_pack(cell, bodies, options);
  require_all_placed(result, bodies, options.min_gap);
  return result;
}

std::string message_of(const Cell& cell, const std::vector<OrderedBody>& bodies,
                       const AdvancingLayerOptions& options = {}) {
  try {
    static_cast<void>(advancing_layer_pack(cell, bodies, options));
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("advancing_layer_pack places every disk of an order, as dense as published or denser") {
  // Log-normal, ratio 48: 0.8493 of 5220 disks (Ilin and Bernacki 2016, figure 13).
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto supply = scenes::lognormal_balls(2, 0.55, 48.0, seed);
    const auto result = pack_scene(supply, 2000, 0.86, false, {.seed = seed});
    CHECK(scenes::interior_fraction(result.packing, 8.0) > 0.87);
  }
  pack_scene(scenes::normal_balls(2, 4.0, 3), 2000, 0.80, true, {.seed = 3});
  pack_scene(scenes::bimodal_balls(2, 4.0, 3), 2000, 0.79, false, {.seed = 3});
}

TEST_CASE("advancing_layer_pack spreads sizes evenly over the height where an order fits so") {
  const auto supply = scenes::lognormal_balls(2, 0.55, 48.0, 4);
  const Cell cell = scenes::cell_for(supply, 5000, 0.865, false);
  // Mean radius, weighted by area, of those in the uppermost tenth over that of all.
  const auto at_top = [&](const AdvancingLayerOptions& options) {
    const auto result = advancing_layer_pack(cell, first_of(supply, 5000), options);
    require_valid(result);
    double area[2] = {}, sum[2] = {};
    for (const Inclusion& i : result.packing.inclusions) {
      for (const int top : {0, 1}) {
        if (top == 1 && i.center.y < 0.9 * cell.size.y) continue;
        area[top] += volume(i.body);
        sum[top] += volume(i.body) * circum_radius(i.body);
      }
    }
    return (sum[1] / area[1]) / (sum[0] / area[0]);
  };
  CHECK(at_top({}) == Approx(1.0).margin(0.12));
  CHECK(at_top({.held_back = 0.15}) < 0.6);
}

TEST_CASE("advancing_layer_pack places ellipses that keep their orientations and never overlap") {
  // Aspect 1.5: 0.8133 of 5081 ellipses, aspect 4: 0.7284 of 4596 (figures 9 and 10), by circles.
  pack_scene(scenes::uniform_ellipses(1.5, 10.0, 1), 700, 0.78, false, {.seed = 1});
  pack_scene(scenes::uniform_ellipses(4.0, 10.0, 1), 700, 0.70, true, {.seed = 1});
  pack_scene(scenes::aligned_ellipses(3.0, 10.0, 30.0, 1), 500, 0.73, false, {.seed = 1});
}

TEST_CASE("advancing_layer_pack places spheres and ellipsoids") {
  pack_scene(scenes::lognormal_balls(3, 0.0, 1.0, 1), 3000, 0.57, true, {.seed = 1});
  pack_scene(scenes::lognormal_balls(3, 0.35, 10.0, 1), 1500, 0.58, true, {.seed = 1});
  pack_scene(scenes::lognormal_balls(3, 0.3, 6.0, 1), 600, 0.50, false, {.seed = 1});
  pack_scene(scenes::prolate_ellipsoids(2.0, 0.0, 1), 250, 0.48, true, {.seed = 1});
}

TEST_CASE("advancing_layer_pack takes every shape, mixed, and least gaps") {
  RandomStream random(5, StreamId::test);
  std::vector<OrderedBody> solids, flats;
  for (int k = 0; k < 60; ++k) {
    solids.push_back({Sphere{random.uniform(0.3, 0.8)}, 0});
    solids.push_back({Cylinder{0.3, random.uniform(0.3, 1.0), random_direction(random)}, 1});
    solids.push_back({Spherocylinder{0.2, 0.8, random_direction(random)}, 0});
    solids.push_back({Ellipsoid{{0.9, 0.5, 0.3}, random_rotation(random)}, 1});
    flats.push_back({Disk{random.uniform(0.2, 0.9)}, 0});
    flats.push_back({Ellipse{{0.9, 0.2}, random.uniform(0.0, 3.1)}, 1});
  }
  const double gap = 0.02;
  const Cell box{3, {9.0, 9.0, 9.0}, {true, true, false}};
  require_all_placed(advancing_layer_pack(box, solids, {.min_gap = gap}), solids, gap);
  const Cell square = cell_2d(13.5, 13.5, true, false);
  require_all_placed(advancing_layer_pack(square, flats, {.min_gap = gap}), flats, gap);
}

TEST_CASE("advancing_layer_pack fills cells that are periodic along every axis") {
  const auto disks = scenes::lognormal_balls(2, 0.4, 20.0, 2);
  Cell square = scenes::cell_for(disks, 1500, 0.83, true);
  square.periodic[1] = true;
  const auto bodies = first_of(disks, 1500);
  const auto packed = advancing_layer_pack(square, bodies, {.seed = 1});
  require_all_placed(packed, bodies);
  const auto crosses = [](const Cell& cell, std::size_t axis) {
    return [&cell, axis](const Inclusion& i) {
      const double reach = half_extents(i.body)[axis];
      return i.center[axis] < reach || i.center[axis] > cell.size[axis] - reach;
    };
  };
  CHECK(std::any_of(packed.packing.inclusions.begin(), packed.packing.inclusions.end(),
                    crosses(square, 1)));

  const auto ellipses = scenes::uniform_ellipses(2.0, 10.0, 3);
  Cell other = scenes::cell_for(ellipses, 400, 0.77, true);
  other.periodic[1] = true;
  const auto bent = first_of(ellipses, 400);
  require_all_placed(advancing_layer_pack(other, bent, {.seed = 1}), bent);

  const auto spheres = scenes::lognormal_balls(3, 0.0, 1.0, 1);
  Cell cube = scenes::cell_for(spheres, 800, 0.56, true);
  cube.periodic[2] = true;
  const auto balls = first_of(spheres, 800);
  require_all_placed(advancing_layer_pack(cube, balls, {.seed = 1}), balls);
}

TEST_CASE(
    "advancing_layer_pack places bodies of extreme shapes, in cells hardly larger than they") {
  RandomStream random(9, StreamId::test);
  const auto turned = [&](const Vec3& semi_axes) {
    return OrderedBody{Ellipsoid{semi_axes, random_rotation(random)}, 0};
  };
  std::vector<OrderedBody> needles, plates, mixed, few;
  for (int k = 0; k < 80; ++k) {
    if (k % 2 == 0) needles.push_back(turned({1.0, 0.1, 0.1}));
    if (k % 4 == 0) plates.push_back(turned({1.0, 1.0, 0.05}));
    mixed.push_back(turned({0.2, 0.25, 0.3}));
    if (k % 16 == 0) mixed.push_back(turned({3.0, 0.3, 0.2}));
    if (k % 4 == 0) few.push_back(turned({0.4, 0.8, 0.3}));
  }
  const auto pack = [](const Cell& cell, const std::vector<OrderedBody>& bodies, double gap) {
    require_all_placed(advancing_layer_pack(cell, bodies, {.min_gap = gap}), bodies, gap);
  };
  pack({3, {3.0, 3.0, 5.0}, {true, true, false}}, needles, 0.0);
  pack({3, {4.0, 4.0, 6.0}, {true, true, true}}, plates, 0.01);
  pack({3, {6.5, 6.5, 6.5}, {true, true, false}}, mixed, 0.0);
  pack({3, {1.7, 1.7, 12.0}, {true, true, false}}, few, 0.02);
  pack({3, {2.0, 2.0, 9.0}, {true, false, true}}, few, 0.0);
}

TEST_CASE("advancing_layer: each disk touches two others, walls or the floor") {
  const auto supply = scenes::normal_balls(2, 4.0, 7);
  const auto bodies = first_of(supply, 400);
  Cell cell = scenes::cell_for(supply, 400, 0.6, false);
  const auto result = advancing_layer_pack(cell, bodies, {.held_back = 0.0});
  // Contacts with those placed later count as well.
  int loose = 0;
  for (std::size_t i = 0; i < result.packing.inclusions.size(); ++i) {
    Packing turned = result.packing;
    std::swap(turned.inclusions[i], turned.inclusions.back());
    const auto normals =
        resting::contact_normals(turned, turned.inclusions.size() - 1, 1e-8 * cell.size.x);
    loose += normals.size() < 2 ? 1 : 0;
  }
  CHECK(loose == 0);
}

TEST_CASE("advancing_layer of equal spheres takes the lowest place there is") {
  // Interior of 2000 spheres; 0.605 is what the exactly lowest place gives.
  const auto result = pack_scene(scenes::lognormal_balls(3, 0.0, 1.0, 1), 4000, 0.55, true);
  CHECK(scenes::interior_fraction(result.packing, 2.0) > 0.59);
}

TEST_CASE("advancing_layer_fill leaves no body of the supply out, and fills the cell") {
  const auto supply = scenes::lognormal_balls(2, 0.55, 48.0, 4);
  const Cell cell = scenes::cell_for(supply, 1000, 0.86, false);
  const auto result = advancing_layer_fill(cell, supply, {.seed = 4});
  require_valid(result);
  CHECK(result.stop == ConstructiveStop::full);
  for (std::size_t k = 0; k < result.packing.inclusions.size(); ++k) {
    CHECK(result.packing.inclusions[k].body == supply(static_cast<std::int64_t>(k)).body);
  }
  CHECK(fraction(result.packing) > 0.84);
}

TEST_CASE("advancing_layer gives the same bits again, and others for another seed") {
  const auto hash = [](const BodySource& supply, double fraction, std::uint64_t seed, int threads) {
    const Cell cell = scenes::cell_for(supply, 200, fraction, true);
    const auto result = advancing_layer_pack(cell, first_of(supply, 200), {.seed = seed},
                                             RunContext{}.threads(threads));
    return scenes::state_hash(result.packing);
  };
  const auto ellipses = scenes::uniform_ellipses(2.0, 10.0, 1);
  const std::uint64_t flat = hash(ellipses, 0.7, 1, 1);
  CHECK(flat == hash(ellipses, 0.7, 1, 1));
  CHECK(flat == hash(ellipses, 0.7, 1, 3));
  CHECK(flat != hash(ellipses, 0.7, 2, 1));
  const auto ellipsoids = scenes::prolate_ellipsoids(2.0, 0.2, 1);
  CHECK(hash(ellipsoids, 0.48, 1, 1) == hash(ellipsoids, 0.48, 1, 3));
}

TEST_CASE("advancing_layer_pack says when not all have room, and keeps what stands") {
  const auto supply = scenes::lognormal_balls(2, 0.3, 6.0, 1);
  const auto bodies = first_of(supply, 300);
  const Cell cell = scenes::cell_for(supply, 300, 0.93, false);
  const auto result = advancing_layer_pack(cell, bodies);
  CHECK(result.stop == ConstructiveStop::full);
  CHECK(result.packing.inclusions.size() < bodies.size());
  CHECK(fraction(result.packing) > 0.78);
  require_valid(result);
}

TEST_CASE("advancing_layer_fill with an open top ends at the first body without a place") {
  const auto supply = scenes::lognormal_balls(2, 0.55, 48.0, 4);
  const Cell cell = scenes::cell_for(supply, 1000, 0.86, false);
  const auto open = advancing_layer_fill(cell, supply, {.close_top = false, .seed = 4});
  require_valid(open);
  CHECK(open.stop == ConstructiveStop::full);
  for (std::size_t k = 0; k < open.packing.inclusions.size(); ++k) {
    CHECK(open.packing.inclusions[k].body == supply(static_cast<std::int64_t>(k)).body);
  }
  const auto closed = advancing_layer_fill(cell, supply, {.seed = 4});
  CHECK(fraction(closed.packing) > fraction(open.packing) + 0.01);
}

TEST_CASE("advancing_layer keeps what stands when it is cancelled or out of time") {
  const auto supply = scenes::lognormal_balls(2, 0.55, 48.0, 1);
  const auto bodies = first_of(supply, 2000);
  const Cell cell = scenes::cell_for(supply, 2000, 0.85, false);
  std::atomic<bool> stop{false};
  RunContext run;
  run.cancel_flag(&stop).on_progress([&](const Progress& progress) {
    CHECK(progress.wanted == 2000);
    if (progress.placed > 0) stop = true;
  });
  const auto cancelled = advancing_layer_pack(cell, bodies, {}, run);
  CHECK(cancelled.stop == ConstructiveStop::cancelled);
  require_valid(cancelled);
  CHECK(cancelled.packing.inclusions.size() < bodies.size());
  const auto late = advancing_layer_fill(cell, supply, {}, RunContext{}.time_limit(1e-4));
  CHECK(late.stop == ConstructiveStop::out_of_time);
}

TEST_CASE("advancing_layer refuses what cannot be, and says what is allowed") {
  const Cell cell = cell_2d(10.0, 10.0, true, false);
  const std::vector<OrderedBody> one{{Disk{1.0}, 0}};
  CHECK(message_of(cell, one, {.min_gap = -1.0}).find("AdvancingLayerOptions::min_gap is -1") == 0);
  CHECK(message_of(cell, one, {.top_layer = 1.1}) ==
        "AdvancingLayerOptions::top_layer is 1.1; allowed is >= 2");
  CHECK(message_of(cell, one, {.candidates = 0}) ==
        "AdvancingLayerOptions::candidates is 0; allowed is >= 1");
  CHECK(message_of(cell, one, {.held_back = 1.5}) ==
        "AdvancingLayerOptions::held_back is 1.5; allowed is [0, 1]");
  CHECK(message_of(cell, one, {.max_restarts = -1}) ==
        "AdvancingLayerOptions::max_restarts is -1; allowed is >= 0");
  CHECK(message_of(cell, {{Disk{5.1}, 0}}).find("body 0 (disk, group 0) cannot stand") == 0);
  CHECK(message_of(cell, {{Sphere{1.0}, 0}}).find("body 0 is a sphere") == 0);
  CHECK(message_of(cell, std::vector<OrderedBody>(40, {Disk{1.0}, 0})) != "");
  CHECK(advancing_layer_pack(cell, {}).packing.inclusions.empty());
}

}  // namespace packstone
