#include "recipe/rod_order.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "recipe/draw_mix.hpp"
#include "support/order.hpp"

namespace packstone::recipe {
namespace {

std::vector<OrderedBody> drawn(const std::string& group) {
  return draw_mix(test::order("[[inclusions]]\nfraction = 0.01\n" + group, "[1, 1, 1]")).bodies;
}

std::string rods(const std::string& orientation) {
  return "shape = \"spherocylinder\"\ncount = 400\naspect = 30\n" + orientation;
}

}  // namespace

TEST_CASE("how rods are: their aspect, and how they cross, against random directions") {
  const auto random = rod_order(drawn(rods("")));
  REQUIRE(random.has_value());
  CHECK(random->aspect == Approx(30.0));
  CHECK(random->crossing == Approx(1.0).epsilon(0.03));
  // <|sin|> is 2 / pi in the plane and pi / 4 in space.
  const auto planar = rod_order(drawn(rods("orientation = { planar = \"xy\" }\n")));
  CHECK(planar->crossing == Approx(8.0 / (std::numbers::pi * std::numbers::pi)).epsilon(0.03));
  const auto parallel = rod_order(drawn(rods("orientation = { axis = [0, 0, 1] }\n")));
  CHECK(parallel->crossing == Approx(0.0).margin(1e-6));
}

TEST_CASE(
    "the aspect of rods of several lengths is that of the means, and of others there is none") {
  const std::vector<OrderedBody> two{{Cylinder{1.0, 2.0, {0, 0, 1}}, 0},
                                     {Spherocylinder{2.0, 10.0, {1, 0, 0}}, 0}};
  CHECK(rod_order(two)->aspect == Approx(4.0));
  CHECK(rod_order(two)->crossing == Approx(4.0 / std::numbers::pi));
  CHECK(rod_sizes(two[0].body) == std::pair{1.0, 2.0});
  CHECK(rod_sizes(two[1].body) == std::pair{2.0, 10.0});
  CHECK_FALSE(rod_order({}).has_value());
  CHECK_FALSE(rod_order({two[0], {Sphere{1.0}, 0}}).has_value());
}

}  // namespace packstone::recipe
