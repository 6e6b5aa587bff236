#include "recipe/choose_method.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "packstone/core/error.hpp"
#include "packstone/geometry/measures.hpp"
#include "recipe/draw_mix.hpp"
#include "support/order.hpp"

namespace packstone {
namespace {

using recipe::choose_method;
using recipe::crowding;
using recipe::MethodChoice;

MethodChoice choice_for(const std::string& groups, const std::string& size = "[1, 1, 1]") {
  const Recipe ordered = test::order(groups, size);
  return choose_method(ordered, recipe::draw_mix(ordered));
}

double crowding_of(const std::string& groups, const std::string& size = "[1, 1, 1]") {
  const Recipe ordered = test::order(groups, size);
  return crowding(ordered.cell, recipe::draw_mix(ordered).bodies, ordered.min_gap,
                  ordered.rsa.order);
}

const std::string kBalls = "[[inclusions]]\nshape = \"sphere\"\ncount = 5000\nfraction = ";
const std::string kDisks = "[[inclusions]]\nshape = \"disk\"\ncount = 5000\nfraction = ";

TEST_CASE("crowding is 1 at a fraction of 0.30 of equal spheres and 0.45 of equal disks") {
  // The last of 5000 has one less before it.
  CHECK(crowding_of(kBalls + "0.3\n") == Approx(1.0).epsilon(1e-3));
  CHECK(crowding_of(kDisks + "0.45\n", "[1, 1]") == Approx(1.0).epsilon(1e-3));
  CHECK(crowding_of(kBalls + "0.2\n") < 0.6);
  CHECK(crowding_of(kBalls + "0.38\n") > 1.3);
}

TEST_CASE("crowding knows no unit, and a ball by any name") {
  const double spheres = crowding_of(kBalls + "0.25\n");
  CHECK(crowding_of(kBalls + "0.25\n", "[1000, 1000, 1000]") == Approx(spheres).epsilon(1e-12));
  std::vector<OrderedBody> balls;
  std::vector<OrderedBody> ellipsoids;
  for (int i = 0; i < 100; ++i) {
    balls.push_back({Sphere{0.07}, 0});
    ellipsoids.push_back({Ellipsoid{{0.07, 0.07, 0.07}, {}}, 0});
  }
  const double as_balls = crowding({}, balls, 0.01, RsaOrder::largest_first);
  CHECK(crowding({}, ellipsoids, 0.01, RsaOrder::largest_first) == Approx(as_balls).epsilon(1e-12));
  // A gap is kept by balls that are larger by half of it.
  for (OrderedBody& ball : balls) ball.body = Sphere{0.075};
  CHECK(crowding({}, balls, 0.0, RsaOrder::largest_first) == Approx(as_balls).epsilon(1e-12));
}

TEST_CASE("rods of random directions exclude what Onsager found") {
  // Two spherocylinders of diameter D and length L: 4 pi D^3 / 3 + 2 pi L D^2 + pi L^2 D / 2.
  const double radius = 0.01;
  const double half = 0.1;
  const double d = 2 * radius;
  const double l = 2 * half;
  const double pi = std::numbers::pi;
  const double excluded = 4 * pi / 3 * d * d * d + 2 * pi * l * d * d + pi / 2 * l * l * d;
  const Body rod = Spherocylinder{radius, half, {0, 0, 1}};
  const double itself = excluded / volume(rod);
  const double expected =
      excluded / (1.0 - volume(rod)) / (8 * 0.3 / 0.7 * std::pow(itself / 8.0, 0.2));
  CHECK(crowding({}, {{rod, 0}, {rod, 0}}, 0.0, RsaOrder::largest_first) ==
        Approx(expected).epsilon(1e-12));
}

TEST_CASE("small bodies after large ones crowd less than small ones before") {
  std::vector<OrderedBody> bodies(400, {Sphere{0.03}, 0});
  bodies.insert(bodies.end(), 10, {Sphere{0.17}, 1});
  const double sorted = crowding({}, bodies, 0.0, RsaOrder::largest_first);
  CHECK(sorted < 1.0);
  CHECK(crowding({}, bodies, 0.0, RsaOrder::as_given) > 2.0 * sorted);
}

TEST_CASE("walls leave less room") {
  const std::string layer = "[[inclusions]]\nshape = \"sphere\"\nradius = 0.1\ncount = 20\n";
  CHECK(crowding_of(layer, "[2, 2, 0.3]\nperiodic = [true, true, false]") >
        1.5 * crowding_of(layer, "[2, 2, 0.3]"));
}

TEST_CASE("auto takes rsa where it surely places all, then relaxation, then dynamics") {
  CHECK(choice_for(kBalls + "0.29\n").method == PackMethod::rsa);
  CHECK_THAT(choice_for(kBalls + "0.29\n").reason, Catch::Contains("surely"));
  CHECK(choice_for(kBalls + "0.4\n").method == PackMethod::relaxation);
  CHECK_THAT(choice_for(kBalls + "0.4\n").reason, Catch::Contains("denser than rsa"));
  CHECK(choice_for(kBalls + "0.6\n").method == PackMethod::event_driven);
  CHECK_THAT(choice_for(kBalls + "0.6\n").reason, Catch::Contains("denser than a relaxation"));
  CHECK(choice_for(kDisks + "0.5\n", "[1, 1]").method == PackMethod::relaxation);
  CHECK(choice_for(kDisks + "0.8\n", "[1, 1]").method == PackMethod::event_driven);
  const std::string cylinders = "[[inclusions]]\nshape = \"cylinder\"\ncount = 200\n";
  CHECK(choice_for(cylinders + "aspect = 2\nfraction = 0.6\n").method == PackMethod::event_driven);
  const std::string rods = cylinders + "aspect = 10\n";
  CHECK(choice_for(rods + "fraction = 0.1\n").method == PackMethod::rsa);
  CHECK(choice_for(rods + "fraction = 0.2\n").method == PackMethod::relaxation);
  // They would block each other as they grow.
  CHECK(choice_for(rods + "fraction = 0.4\n").method == PackMethod::relaxation);
  // Dynamics would have to lock them.
  const std::string planar = "orientation = { planar = \"xy\" }\n";
  CHECK(choice_for(cylinders + planar + "aspect = 2\nfraction = 0.6\n").method ==
        PackMethod::relaxation);
}

TEST_CASE("an order is followed, and a goal beyond the target asks for dynamics") {
  CHECK(choice_for(kBalls + "0.4\n[packing]\nmethod = \"rsa\"\n").method == PackMethod::rsa);
  CHECK(choice_for(kBalls + "0.1\n[packing]\nmethod = \"event-driven\"\n").method ==
        PackMethod::event_driven);
  const MethodChoice densest =
      choice_for(kBalls + "0.1\n[packing.event-driven]\ngoal = \"densest\"\n");
  CHECK(densest.method == PackMethod::event_driven);
  CHECK_THAT(densest.reason, Catch::Contains("goal"));
}

TEST_CASE("an open count is filled by rsa, and refused where bodies are to move") {
  const std::string open = "[[inclusions]]\nshape = \"sphere\"\nradius = 0.05\n";
  CHECK(choice_for(open).method == PackMethod::rsa);
  for (const std::string& motion : {std::string("[packing]\nmethod = \"event-driven\"\n"),
                                    std::string("[packing]\nmethod = \"relaxation\"\n"),
                                    std::string("[packing.event-driven]\ngoal = \"densest\"\n")}) {
    CHECK_THROWS_AS(choice_for(open + motion), InvalidGroup);
    CHECK_THROWS_WITH(choice_for(open + motion), Catch::Contains("leaves the count open"));
  }
}

}  // namespace
}  // namespace packstone
