// Rays against solids, judged by the membership tests of the geometry layer.

#include <catch2/catch.hpp>
#include <cmath>

#include "io/draw/solid.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/support.hpp"
#include "support/random_body.hpp"

namespace packstone::draw {
namespace {

// All shapes of space in turn.
Body random_solid_body(int trial, RandomStream& random) {
  return test::random_body(static_cast<ShapeKind>(trial % 4), random,
                           [&] { return std::exp(random.uniform(-1.5, 1.5)); });
}

TEST_CASE("a ray is inside a solid exactly between enter and leave") {
  RandomStream random(5, StreamId::test);
  int crossed = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const Body body = random_solid_body(trial, random);
    const Vec3 center{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Solid solid = make_solid(body, center, {}, false);
    const double reach = circum_radius(body);
    const Vec3 origin = center + 3.0 * reach * random_direction(random);
    const Ray ray{origin, random.uniform(0.5, 2.0) *
                              normalized(center + reach * random_direction(random) - origin)};
    const Crossing c = crossing(solid, ray);
    crossed += c.empty() ? 0 : 1;
    for (int sample = 0; sample < 20; ++sample) {
      const double t = random.uniform(0.0, 6.0) * reach / norm(ray.direction);
      const bool inside = contains(body, ray.origin + t * ray.direction - center);
      const bool between = !c.empty() && t > c.enter && t < c.leave;
      // A parameter within rounding of an end may fall on either side.
      const double edge = 1e-9 * reach / norm(ray.direction);
      const bool at_end = std::abs(t - c.enter) < edge || std::abs(t - c.leave) < edge;
      if (!at_end) REQUIRE(inside == between);
    }
  }
  CHECK(crossed > 5'000);
}

TEST_CASE("the normal of a crossing is unit, outward, and against the ray") {
  RandomStream random(6, StreamId::test);
  for (int trial = 0; trial < 4'000; ++trial) {
    const Body body = random_solid_body(trial, random);
    const Solid solid = make_solid(body, {}, {}, false);
    const double reach = circum_radius(body);
    const Vec3 origin = 3.0 * reach * random_direction(random);
    const Ray ray{origin, normalized(0.7 * reach * random_direction(random) - origin)};
    const Crossing c = crossing(solid, ray);
    if (c.empty()) continue;
    const Vec3 at = ray.origin + c.enter * ray.direction;
    CHECK(norm(c.normal) == Approx(1.0).epsilon(1e-12));
    CHECK(dot(c.normal, ray.direction) <= 1e-12);
    // The normal of a convex body supports it: no point of the body lies farther along it.
    CHECK(dot(c.normal, at) == Approx(support(body, c.normal)).epsilon(1e-7));
  }
}

TEST_CASE("a box is entered through the face that the ray meets last") {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  const Crossing c = crossing(box, {{-1, 1, 1}, {1, 0, 0}});
  CHECK(c.enter == 1.0);
  CHECK(c.leave == 2.0);
  CHECK(c.normal == Vec3{-1, 0, 0});
  CHECK(crossing(box, {{-1, 5, 1}, {1, 0, 0}}).empty());
  CHECK(crossing(box, {{-1, -1, -1}, {-1, -1, -1}}).leave < 0.0);
}

}  // namespace
}  // namespace packstone::draw
