#include "packstone/generate/event_driven.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <vector>

#include "orders.hpp"

namespace packstone {
namespace {

using namespace orders;

std::string refusal(const EventDrivenOptions& options) {
  return message_of([&] {
    static_cast<void>(
        event_driven_pack(Cell{}, filling(Cell{}, copies(Sphere{1}, 4), 0.1), options));
  });
}

TEST_CASE("event_driven_pack refuses options out of range and names field, value and range") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -0.1, 10.5, infinite, nan}) {
    const std::string message = refusal({.growth_rate = bad});
    check_names(message, {"EventDrivenOptions::growth_rate is ", "> 0 and <= 10"});
  }
  check_names(refusal({.growth_rate = 10.5}), {"10.5"});
  for (const double bad : {0.0, -1e-6, 0.2, nan}) {
    check_names(refusal({.slowest_growth = bad}),
                {"EventDrivenOptions::slowest_growth is ", "> 0 and <= growth_rate"});
  }
  check_names(refusal({.slowest_growth = 0.2}), {"0.2"});
  for (const double bad : {0.0, -3.0, infinite, nan}) {
    check_names(refusal({.collisions_per_body = bad}),
                {"EventDrivenOptions::collisions_per_body is ", "> 0"});
  }
  for (const double bad : {-0.01, infinite, nan, 1.5}) {
    check_names(refusal({.min_gap = bad}), {"EventDrivenOptions::min_gap is "});
  }
  CHECK(refusal({.growth_rate = 10.0}).empty());
  CHECK(refusal({.growth_rate = 0.01, .slowest_growth = 0.01}).empty());
}

TEST_CASE("event_driven_pack refuses before any work what no cell can hold") {
  const auto refused = [](const Cell& cell, const Bodies& bodies, EventDrivenOptions options = {}) {
    return message_of([&] { static_cast<void>(event_driven_pack(cell, bodies, options)); });
  };
  const Cell cell{};
  check_names(refused(cell, {{Sphere{0.2}, 0}, {Sphere{0.6}, 0}}), {"body 1", "sphere"});
  check_names(refused(cell, {{Disk{0.2}, 0}}), {"body 0", "dimension"});
  check_names(refused(cell, {{Sphere{-1.0}, 0}}), {"body 0"});
  check_names(refused(cell, {{Sphere{0.1}, -1}}), {"group is -1"});
  CHECK(!refused(cell, filling(cell, copies(kBall, 30), 0.75)).empty());
  CHECK(!refused(cell, filling(cell, copies(kRod, 30), 1.01)).empty());
  CHECK(!refused(cell, filling(cell, copies(kBall, 30), 0.6), {.min_gap = 0.1}).empty());
  // Turned as it is it meets its own image; if it may turn it can stand.
  const Bodies along{{Ellipsoid{{0.55, 0.05, 0.05}, {}}, 0}};
  CHECK(refused(cell, along).empty());
  EventDrivenOptions fixed;
  fixed.fixed_orientation = {true};
  CHECK(!refused(cell, along, fixed).empty());
  CHECK(!refused({4, {1, 1, 1}, {true, true, true}}, {{Sphere{0.1}, 0}}).empty());
}

}  // namespace
}  // namespace packstone
