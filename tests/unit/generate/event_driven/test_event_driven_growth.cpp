#include "packstone/generate/event_driven.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "orders.hpp"

namespace packstone {
namespace {

using namespace orders;

// Radii from 1 down to 1 / range, as many of each size as fills the space between the larger ones.
Bodies spheres_of_sizes(int count, double range) {
  Bodies bodies;
  for (int k = 0; k < count; ++k) {
    bodies.push_back({Sphere{std::pow(range, -k / (count - 1.0))}, 0});
  }
  return bodies;
}

void check_packs(const Cell& cell, const Bodies& bodies, const EventDrivenOptions& options = {}) {
  check_reached(cell, bodies, pack(cell, bodies, options), options.min_gap);
}

TEST_CASE("event_driven_pack packs every shape in space to the size ordered") {
  const Cell cell{};
  check_packs(cell, filling(cell, copies(kBall, 50), 0.55));
  check_packs(cell, filling(cell, copies(kProlate, 40), 0.55));
  check_packs(cell, filling(cell, copies(kOblate, 40), 0.45));
  check_packs(cell, filling(cell, copies(kScalene, 30), 0.5));
  check_packs(cell, filling(cell, copies(kRod, 15), 0.35));
  check_packs(cell, filling(cell, copies(kCoin, 15), 0.3));
  check_packs(cell, filling(cell, copies(kCapsule, 20), 0.4));
}

TEST_CASE("event_driven_pack packs disks and ellipses, and they stay in the plane") {
  const Cell cell = cell_2d(1.0, 0.7);
  for (const Body& shape :
       {Body{Disk{1}}, Body{Ellipse{{2, 1}, 0.0}}, Body{Ellipse{{10, 1}, 0.0}}}) {
    const Bodies bodies = filling(cell, copies(shape, 40), 0.6);
    const EventDrivenResult result = pack(cell, bodies);
    check_reached(cell, bodies, result);
    for (const Inclusion& inclusion : result.packing.inclusions) CHECK(inclusion.center.z == 0.0);
    for (const Vec3& velocity : result.state.velocity) CHECK(velocity.z == 0.0);
  }
  check_packs(cell, filling(cell, mixture(2, 40, 8), 0.6));
}

TEST_CASE("event_driven_pack packs mixtures of all shapes and of very unequal sizes") {
  const Cell cell{3, {1.0, 1.5, 0.8}, {true, true, true}};
  check_packs(cell, filling(cell, mixture(3, 40, 8), 0.4));
  check_packs(cell, filling(cell, spheres_of_sizes(80, 100.0), 0.4));
  check_packs(cell, filling(cell, spheres_of_sizes(60, 1000.0), 0.3));
}

TEST_CASE("event_driven_pack packs needles and lenses of aspect 100") {
  const Cell cell{};
  check_packs(cell, filling(cell, copies(Ellipsoid{{100, 1, 1}, {}}, 30), 0.005));
  check_packs(cell, filling(cell, copies(Ellipsoid{{100, 100, 1}, {}}, 10), 0.02));
  check_packs(cell, filling(cell, copies(Spherocylinder{1, 100}, 15), 0.005));
}

TEST_CASE("event_driven_pack packs between walls across one axis or all of them") {
  for (const auto& periodic : {std::array<bool, 3>{true, true, false}, {false, false, false}}) {
    const Cell cell{3, {1.0, 0.8, 1.2}, periodic};
    check_packs(cell, filling(cell, copies(kBall, 30), 0.4));
    check_packs(cell, filling(cell, copies(kProlate, 20), 0.4));
    check_packs(cell, filling(cell, mixture(3, 16, 9), 0.25));
    check_packs(cell, filling(cell, copies(kRod, 8), 0.15));
  }
  const Cell plane = cell_2d(1.0, 1.0, false, false);
  check_packs(plane, filling(plane, mixture(2, 20, 9), 0.5));
  const EventDrivenResult box =
      pack({3, {1, 1, 1}, {false, false, false}}, filling(Cell{}, copies(kBall, 10), 0.3));
  CHECK(box.report.wall_collisions > 0);
  CHECK(box.report.wall_collisions <= box.report.collisions);
}

TEST_CASE("event_driven_pack packs one body, and two") {
  const Cell cell{};
  for (const int count : {1, 2}) {
    check_packs(cell, filling(cell, copies(kBall, count), 0.4));
    check_packs(cell, filling(cell, copies(kScalene, count), 0.25));
    check_packs(cell, filling(cell, copies(kRod, count), 0.1));
  }
  check_packs({3, {1, 1, 1}, {false, false, false}}, filling(cell, copies(kBall, 1), 0.5));
}

TEST_CASE("event_driven_pack packs bodies longer than the cell, clear of their own images") {
  const Cell cell{};
  for (const int count : {1, 2, 6}) {
    check_packs(cell, copies(Ellipsoid{{0.55, 0.05, 0.05}, {}}, count));
    check_packs(cell, copies(Ellipsoid{{0.8, 0.02, 0.02}, {}}, count));
    check_packs(cell, copies(Spherocylinder{0.02, 0.7}, count));
    check_packs(cell, copies(Cylinder{0.02, 0.7}, count));
  }
  const Cell flat{3, {1, 1, 0.3}, {true, true, true}};
  check_packs(flat, copies(Ellipsoid{{0.3, 0.04, 0.04}, {}}, 10));
}

TEST_CASE("event_driven_pack leaves fixed orientations as they are, to the last bit") {
  const Cell cell{};
  Bodies bodies = filling(cell, mixture(3, 30, 10), 0.3);
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].group = k % 2 == 0 ? 0 : 2;
  EventDrivenOptions options;
  options.fixed_orientation = {false, false, true};
  const EventDrivenResult result = pack(cell, bodies, options);
  check_reached(cell, bodies, result);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const bool stays = bodies[k].group == 2 || is_round(kind(bodies[k].body));
    CHECK((result.packing.inclusions[k].body == bodies[k].body) == stays);
  }
  // Cylinders side by side, which their rounded kin could not be packed as.
  options.fixed_orientation = {true};
  check_packs(cell, filling(cell, Bodies(20, {Cylinder{1, 2, {0, 0, 1}}, 0}), 0.4), options);
}

TEST_CASE("event_driven_pack keeps the least gap that is ordered") {
  const Cell cell{};
  const EventDrivenOptions options{.min_gap = 0.03};
  check_packs(cell, filling(cell, copies(kBall, 40), 0.3), options);
  check_packs(cell, filling(cell, copies(kProlate, 30), 0.2), options);
  check_packs(cell, filling(cell, mixture(3, 30, 11), 0.15), options);
  check_packs(cell, filling(cell, copies(kRod, 10), 0.1), options);
  const Cell plane = cell_2d(1.0, 1.0);
  check_packs(plane, filling(plane, mixture(2, 20, 11), 0.3), options);
  const Cell walls{3, {1, 1, 1}, {false, false, false}};
  check_packs(walls, filling(walls, copies(kBall, 10), 0.15), options);
}

TEST_CASE("the least gap is one between inclusions: a wall may be nearer") {
  const Cell walls{3, {1, 1, 1}, {false, false, false}};
  check_packs(walls, {{Sphere{0.45}, 0}}, {.min_gap = 0.2});
}

TEST_CASE("looking at all pairs after every event finds nothing wrong") {
  EventDrivenOptions options;
  options.check_every_event = true;
  const Cell cell{};
  for (const Body& shape : {kBall, kProlate, kOblate, kScalene, kRod, kCapsule}) {
    check_packs(cell, filling(cell, copies(shape, 8), 0.25), options);
  }
  check_packs(cell, copies(Ellipsoid{{0.8, 0.02, 0.02}, {}}, 3), options);
  const Cell walls{3, {1, 0.8, 1}, {false, true, false}};
  check_packs(walls, filling(walls, mixture(3, 8, 12), 0.2), options);
  options.min_gap = 0.02;
  check_packs(cell, filling(cell, copies(kProlate, 8), 0.2), options);
}

TEST_CASE("event_driven_pack gives the same bits again, and others for another seed") {
  const Cell cell{};
  for (const Bodies& bodies :
       {filling(cell, copies(kBall, 30), 0.4), filling(cell, copies(kProlate, 30), 0.4),
        filling(cell, mixture(3, 15, 13), 0.3)}) {
    const EventDrivenResult once = pack(cell, bodies), again = pack(cell, bodies);
    CHECK(hash_of(once) == hash_of(again));
    CHECK(once.report.collisions == again.report.collisions);
    CHECK(once.report.steps == again.report.steps);
    CHECK(hash_of(pack(cell, bodies, {.seed = 99})) != hash_of(once));
  }
}

TEST_CASE("only a gas that is dilute or thin grows faster than is ordered") {
  const Cell cell{};
  // The dilute one has no pressure yet.
  constexpr double kThin = 12.0, kDilute = 0.12;
  for (const double growth : {0.1, 0.01}) {
    const EventDrivenResult result =
        pack(cell, filling(cell, mixture(3, 30, 15), 0.55), {.growth_rate = growth});
    REQUIRE(result.stop == EventDrivenStop::target_reached);
    int crowded = 0;
    double fraction = 0.0, pressure = 0.0;
    for (const EventDrivenSample& sample : result.history) {
      const double part = pressure > 0.0 && pressure < kThin ? kThin / pressure : 1.0;
      const double most = std::min(1.0, growth * part * part);
      if (fraction >= kDilute) CHECK(sample.growth_rate <= most * 1.001);
      if (fraction >= kDilute && part == 1.0) ++crowded;
      fraction = sample.fraction;
      pressure = sample.reduced_pressure;
    }
    // The fast one may come to its end before it crowds.
    CHECK((crowded > 0 || growth == 0.1));
  }
}

}  // namespace
}  // namespace packstone
