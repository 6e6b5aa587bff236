#include "packstone/structure/moving_packing.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/error.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

MovingPacking three_bodies() {
  MovingPacking moving;
  moving.packing.groups = {"all"};
  moving.packing.inclusions = {{{0.1, 0.2, 0.3}, Sphere{0.2}, 0},
                               {{0.5, 0.5, 0.5}, Cylinder{0.1, 0.3, {0, 0.6, 0.8}}, 0},
                               {{0.9, 0.9, 0.9}, Ellipsoid{{0.1, 0.2, 0.3}, {}}, 0}};
  moving.size_factor = 0.5;
  moving.velocity = {{1, 0, 0}, {0, -1, 0}, {0, 0, 2}};
  moving.angular_velocity = {{0, 0, 0}, {3, 0, 0}, {1, 2, 3}};
  return moving;
}

TEST_CASE("the present size is the size at factor 1 times the factor, in place and as turned") {
  MovingPacking moving = three_bodies();
  moving.packing.certificate = Certificate{};
  moving.packing.provenance.emplace().method = "event-driven";
  const Packing now = at_present_size(moving);
  CHECK(now.cell == moving.packing.cell);
  CHECK(now.groups == moving.packing.groups);
  CHECK(now.provenance == moving.packing.provenance);
  CHECK_FALSE(now.certificate.has_value());
  CHECK(now.inclusions[0] == Inclusion{{0.1, 0.2, 0.3}, Sphere{0.1}, 0});
  CHECK(now.inclusions[1] == Inclusion{{0.5, 0.5, 0.5}, Cylinder{0.05, 0.15, {0, 0.6, 0.8}}, 0});
  // Volumes go with the cube of the factor; an exact power of two leaves no rounding.
  CHECK(fraction(now) == fraction(moving.packing) / 8);
}

TEST_CASE("at size factor 1 the packing comes back bit for bit") {
  MovingPacking moving = three_bodies();
  moving.size_factor = 1.0;
  CHECK(at_present_size(moving).inclusions == moving.packing.inclusions);
}

TEST_CASE("what cannot move is refused by inclusion and field") {
  CHECK_NOTHROW(check_moving(three_bodies()));
  CHECK_THROWS_AS(check_moving(MovingPacking{}), InvalidArgument);  // a size factor of 0
  const auto refused = [](auto&& change, const char* message) {
    MovingPacking moving = three_bodies();
    change(moving);
    CHECK_THROWS_AS(check_moving(moving), InvalidArgument);
    CHECK_THROWS_WITH(check_moving(moving), Catch::Contains(message));
  };
  refused([](MovingPacking& m) { m.size_factor = -0.5; }, "size_factor = -0.5, allowed are");
  refused([](MovingPacking& m) { m.size_factor = NAN; }, "size_factor = nan");
  refused([](MovingPacking& m) { m.size_factor = INFINITY; }, "size_factor = inf");
  refused([](MovingPacking& m) { m.velocity.pop_back(); },
          "velocity: has 2 vectors, allowed is one for each of the 3 inclusions");
  refused([](MovingPacking& m) { m.angular_velocity.clear(); }, "angular_velocity: has 0 vectors");
  refused([](MovingPacking& m) { m.velocity[1].y = INFINITY; },
          "inclusion 1: velocity[1] = inf, allowed are finite numbers");
  refused([](MovingPacking& m) { m.angular_velocity[2].z = NAN; },
          "inclusion 2: angular_velocity[2] = nan");
  refused([](MovingPacking& m) { m.packing.inclusions[2].group = 1; }, "inclusion 2: group 1");
}

}  // namespace
}  // namespace packstone
