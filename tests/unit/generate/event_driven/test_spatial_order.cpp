#include "generate/event_driven/spatial_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "movers.hpp"

namespace packstone::event_driven {
namespace {

// Spheroids, some of them without a turn, at random places; the last one scalene.
Bodies scattered_bodies(const Cell& cell, int count, zoo::Zoo& zoo) {
  movers::Scene scene;
  scene.cell = cell;
  for (int k = 0; k < count; ++k) {
    const Vec3 axes{2.0 + k, 1.0, k == count - 1 ? 0.5 : 1.0};
    // Also outside the cell: bodies are not wrapped into it while they fly.
    const Vec3 center{zoo.uniform(-1, 2) * cell.size.x, zoo.uniform(-1, 2) * cell.size.y,
                      zoo.uniform(-1, 2) * cell.size.z};
    scene.movers.push_back(
        {Ellipsoid{axes, zoo.rotation()}, center, zoo.direction(3), zoo.direction(3), k % 3 != 0});
  }
  return bodies_of(scene);
}

double path_length(const Bodies& bodies, const Cell& cell) {
  double length = 0.0;
  for (std::size_t k = 1; k < bodies.flight.size(); ++k) {
    const Vec3 step = bodies.flight[k].center - bodies.flight[k - 1].center;
    length += norm(Vec3{std::remainder(step.x, cell.size.x), std::remainder(step.y, cell.size.y),
                        std::remainder(step.z, cell.size.z)});
  }
  return length;
}

}  // namespace

TEST_CASE("an order names every body once, and is undone bit for bit") {
  zoo::Zoo zoo(1);
  const Cell cell{3, {2.0, 3.0, 5.0}, {true, true, true}};
  for (const int count : {0, 1, 2, 100}) {
    const Bodies bodies = scattered_bodies(cell, count, zoo);
    std::vector<std::int32_t> order = spatial_order(bodies, cell);
    const Bodies back = out_of_order(in_order(bodies, order), order);
    for (std::size_t k = 0; k < bodies.flight.size(); ++k) {
      REQUIRE(back.flight[k].center == bodies.flight[k].center);
      REQUIRE(back.flight[k].velocity == bodies.flight[k].velocity);
      REQUIRE(back.spin[k].axis == bodies.spin[k].axis);
      REQUIRE(back.spin[k].angular == bodies.spin[k].angular);
      REQUIRE(back.second[k].axis == bodies.second[k].axis);
      REQUIRE(back.form[k] == bodies.form[k]);
      REQUIRE(back.reach[k] == bodies.reach[k]);
      REQUIRE(back.inverse_mass[k] == bodies.inverse_mass[k]);
      REQUIRE(back.inverse_inertia[k] == bodies.inverse_inertia[k]);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::int32_t> all(order.size());
    std::iota(all.begin(), all.end(), 0);
    REQUIRE(order == all);
  }
}

TEST_CASE("bodies next to each other in the order stand next to each other in the cell") {
  zoo::Zoo zoo(2);
  const Cell cell{3, {1.0, 1.0, 1.0}, {true, true, true}};
  const Bodies bodies = scattered_bodies(cell, 4000, zoo);
  const Bodies sorted = in_order(bodies, spatial_order(bodies, cell));
  CHECK(path_length(sorted, cell) < 0.3 * path_length(bodies, cell));
}

}  // namespace packstone::event_driven
