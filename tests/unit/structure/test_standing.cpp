#include "packstone/structure/standing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "support/random_body.hpp"

namespace packstone {
namespace {

const Cell kCube;
const Cell kWalled{3, {1, 1, 1}, {true, true, false}};

std::string why(const Cell& cell, const Body& body, double min_gap = 0.0,
                Turn turn = Turn::as_given) {
  return why_it_cannot_stand(cell, body, min_gap, turn).value_or("it can");
}

std::string message_of(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap) {
  try {
    check_standing(cell, bodies, min_gap);
    check_room(cell, bodies, min_gap);
  } catch (const InvalidGroup& problem) {
    return problem.what();
  }
  return "it can";
}

std::vector<OrderedBody> copies(const Body& body, std::size_t count) {
  return std::vector<OrderedBody>(count, {body, 0});
}

TEST_CASE("bodies that a cell cannot hold as they are turned, and those that it just can") {
  const Vec3 up{0, 0, 1};
  CHECK(why(kWalled, Cylinder{0.05, 0.6, up}) ==
        "with diameter 0.1 and length 1.2 it is 1.2 wide along z; allowed between the walls is "
        "less than 1");
  CHECK(why(kCube, Cylinder{0.05, 0.6, up}) ==
        "with diameter 0.1 and length 1.2 it touches or overlaps its own periodic image "
        "[0, 0, 1]; make it smaller or the cell larger");
  CHECK(why(kWalled, Cylinder{0.05, 0.6, normalized(Vec3{1, 0.3, 0})}) == "it can");
  CHECK_THAT(why(kWalled, Cylinder{0.05, 0.75, normalized(Vec3{1, 1, 0})}),
             Catch::Contains("[1, 1, 0]"));

  const Cell flat = cell_2d(1, 0.5);
  CHECK(why(flat, Disk{0.2499}) == "it can");
  CHECK_THAT(why(flat, Disk{0.25}), Catch::Contains("its own periodic image [0, 1];"));
  const double upright = std::acos(0.0);
  CHECK_THAT(why(flat, Ellipse{{0.3, 0.1}, upright}), Catch::Contains("image [0, 1];"));
  CHECK(why(flat, Ellipse{{0.3, 0.1}, 0.0}) == "it can");

  const Cell slab{3, {1, 2, 2}, {true, true, true}};
  CHECK_THAT(why(slab, Ellipsoid{{0.6, 0.1, 0.1}, {}}), Catch::Contains("image [1, 0, 0]"));
  CHECK(why(slab, Ellipsoid{{0.49, 0.1, 0.1}, {}}) == "it can");
  CHECK_THAT(why(slab, Spherocylinder{0.1, 0.41, {1, 0, 0}}), Catch::Contains("image [1, 0, 0]"));
  CHECK(why(slab, Spherocylinder{0.1, 0.39, {1, 0, 0}}) == "it can");
}

TEST_CASE("the least gap counts between a body and its own images, not towards walls") {
  CHECK(why(kCube, Sphere{0.45}, 0.09) == "it can");
  CHECK(why(kCube, Sphere{0.45}, 0.11) ==
        "with diameter 0.9 it does not keep a gap of 0.11 to its own periodic image [1, 0, 0]; "
        "make it smaller or the cell larger");
  CHECK(why({3, {1, 1, 1}, {false, false, false}}, Sphere{0.45}, 0.2) == "it can");
}

TEST_CASE("of a body that may be turned only what holds for every orientation counts") {
  const Cylinder fiber{0.05, 0.6, {0, 0, 1}};
  CHECK(why(kWalled, fiber, 0.0, Turn::any) == "it can");
  CHECK_THAT(why(kWalled, Cylinder{0.55, 0.6, {0, 0, 1}}, 0.0, Turn::any),
             Catch::Contains("however it is turned, it is 1.1 wide along z"));
  CHECK_NOTHROW(check_standing(kWalled, {{fiber, 0}}, 0.0, {true}));
  CHECK_THROWS_WITH(check_standing(kWalled, {{Sphere{0.1}, 1}, {fiber, 1}}, 0.0, {true}),
                    Catch::Contains("group 1: inclusion 1 cannot stand in the cell: with"));
}

TEST_CASE("a fiber of very many periods is refused at once") {
  CHECK_THAT(why(kCube, Cylinder{1e-4, 300, {1, 0, 0}}),
             Catch::Contains("600 periods long along x") && Catch::Contains("allowed are 500"));
  CHECK_THAT(why(kCube, Cylinder{1e-4, 200, normalized(Vec3{1, 1, 1})}),
             Catch::Contains("1000000 images"));
}

TEST_CASE("whether a body can stand agrees with the check of a packing of it alone") {
  int standing = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    RandomStream random(seed, StreamId::test);
    const Cell cell{3, {1, 0.8, 1.1}, {seed % 2 == 0, true, seed % 3 != 0}};
    const Body body = test::random_body(test::random_shape(3, random), random,
                                        [&] { return random.uniform(0.05, 0.7); });
    const bool can = !why_it_cannot_stand(cell, body, 0.0, Turn::as_given);
    const CenterBox box = centers_inside_walls(cell, half_extents(body));
    const bool has_place = box.lo.x <= box.hi.x && box.lo.z <= box.hi.z;
    Vec3 center = 0.5 * (box.lo + box.hi);
    if (!has_place) center = 0.5 * cell.size;
    CAPTURE(seed, has_place);
    CHECK(can == check_packing({cell, {"one"}, {{center, body, 0}}, {}, {}}).passed());
    standing += can ? 1 : 0;
  }
  // Both answers occur often.
  CHECK(standing > 200);
  CHECK(standing < 800);
}

TEST_CASE("orders beyond a proven bound are refused") {
  const auto ball_of = [](double fraction, double count) {
    return Sphere{std::cbrt(fraction / count / (4.0 / 3.0 * std::acos(-1.0)))};
  };
  CHECK_THAT(message_of(kCube, copies(ball_of(0.741, 999), 999), 0.0),
             Catch::Contains("group 0") && Catch::Contains("would fill 0.741") &&
                 Catch::Contains("at most 0.74048"));
  CHECK(message_of(kCube, copies(ball_of(0.74, 999), 999), 0.0) == "it can");
  const Cell square = cell_2d(1, 1);
  const auto disk_of = [](double fraction, double count) {
    return Disk{std::sqrt(fraction / count / std::acos(-1.0))};
  };
  CHECK_THAT(message_of(square, copies(disk_of(0.907, 999), 999), 0.0),
             Catch::Contains("at most 0.9069"));
  CHECK(message_of(square, copies(disk_of(0.9068, 999), 999), 0.0) == "it can");
  const Ellipse ellipse{{0.05, 0.01}, 0.3};
  CHECK_THAT(message_of(square, copies(ellipse, 578), 0.0), Catch::Contains("shape ellipse"));
  // Unequal spheres may be denser, but not denser than everything.
  std::vector<OrderedBody> unequal = copies(Sphere{0.1}, 180);
  unequal.push_back({Sphere{0.05}, 1});
  CHECK(message_of(kCube, unequal, 0.0) == "it can");
  unequal.insert(unequal.end(), 60, {Sphere{0.1}, 1});
  CHECK_THAT(message_of(kCube, unequal, 0.0),
             Catch::Contains("group 0: all inclusions together need 1.005"));
}

TEST_CASE("gaps take room too, beyond walls half of one") {
  CHECK_THAT(message_of(kCube, copies(Sphere{0.1}, 60), 0.1),
             Catch::Contains("with their gaps (min_gap = 0.1) would fill 0.848"));
  CHECK_THAT(message_of(kCube, copies(Cylinder{0.1, 0.1, {0, 0, 1}}, 100), 0.1),
             Catch::Contains("with their gaps (min_gap = 0.1) need"));
  // One sphere between walls may keep any distance it likes from nobody.
  CHECK(message_of({3, {1, 1, 1}, {false, false, false}}, copies(Sphere{0.49}, 1), 0.9) ==
        "it can");
  CHECK(message_of(kCube, {}, 0.1) == "it can");
}

}  // namespace
}  // namespace packstone
