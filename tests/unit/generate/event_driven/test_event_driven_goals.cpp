#include "packstone/generate/event_driven.hpp"

#include <catch2/catch.hpp>
#include <chrono>

#include "orders.hpp"

namespace packstone {
namespace {

using namespace orders;

TEST_CASE("an order that cannot be met ends as jammed, with a valid packing") {
  const Cell cell{};
  Bodies bodies = copies(kBall, 10);
  for (OrderedBody& b : copies(Sphere{1.2}, 10)) bodies.push_back(b);
  bodies = filling(cell, bodies, 0.73);
  const EventDrivenResult result = pack(cell, bodies, {.growth_rate = 0.3, .slowest_growth = 0.05});
  CHECK(result.stop == EventDrivenStop::jammed);
  CHECK(result.size_factor < 1.0);
  CHECK(fraction(result.packing) > 0.5);
  CHECK(fraction(result.packing) < 0.73);
  check_valid(result);
}

TEST_CASE("an empty order is met at once") {
  const EventDrivenResult result = pack(Cell{}, {});
  CHECK(result.stop == EventDrivenStop::target_reached);
  CHECK(result.packing.inclusions.empty());
}

TEST_CASE("the densest packing goes beyond what is ordered, in proportion") {
  const Cell cell{};
  const Bodies bodies = filling(cell, copies(kBall, 20), 0.01);
  const EventDrivenResult result = pack(
      cell, bodies, {.goal = EventDrivenGoal::densest, .growth_rate = 0.1, .slowest_growth = 0.03});
  CHECK(result.stop == EventDrivenStop::jammed);
  CHECK(fraction(result.packing) > 0.58);
  CHECK(fraction(result.packing) < 0.7405);
  const double radius = std::get<Sphere>(bodies[0].body).radius;
  for (const Inclusion& inclusion : result.packing.inclusions) {
    CHECK(std::get<Sphere>(inclusion.body).radius == Approx(result.size_factor * radius));
  }
  check_valid(result);
}

TEST_CASE("the densest packing of one ball is the one that touches its own images") {
  const auto soon = RunContext::Clock::now() + std::chrono::seconds(2);
  const EventDrivenResult result = event_driven_pack(
      Cell{}, {{Sphere{0.1}, 0}}, {.goal = EventDrivenGoal::densest}, RunContext{}.deadline(soon));
  CHECK(result.stop == EventDrivenStop::jammed);
  CHECK(result.size_factor == Approx(5.0).epsilon(1e-9));
  check_valid(result);
}

TEST_CASE("in equilibrium the bodies keep their size and their energy") {
  const Cell cell{};
  for (const Body& shape : {kBall, kProlate, kOblate}) {
    const Bodies bodies = filling(cell, copies(shape, 64), 0.3);
    const EventDrivenResult result =
        pack(cell, bodies, {.goal = EventDrivenGoal::equilibrium, .collisions_per_body = 100.0});
    check_reached(cell, bodies, result);
    CHECK(result.report.energy_drift < 1e-12);
    // That of spheres by N. F. Carnahan and K. E. Starling (1969) is 3.97; statistics of 6400
    // collisions and 64 bodies.
    if (shape == kBall) CHECK(result.report.reduced_pressure == Approx(3.97).epsilon(0.06));
    CHECK(result.report.reduced_pressure > 3.0);
  }
}

TEST_CASE("the published criterion ends a run earlier") {
  const Cell cell{};
  const Bodies bodies = filling(cell, copies(kProlate, 30), 0.64);
  const EventDrivenResult patient = pack(cell, bodies, {.growth_rate = 0.01});
  const EventDrivenResult hasty =
      pack(cell, bodies, {.growth_rate = 0.01, .published_stagnation = true});
  CHECK(hasty.stop == EventDrivenStop::stagnated);
  CHECK(hasty.size_factor < patient.size_factor);
  CHECK(hasty.report.collisions < patient.report.collisions);
  check_valid(hasty);
}

}  // namespace
}  // namespace packstone
