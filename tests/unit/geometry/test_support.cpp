#include "packstone/geometry/support.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "support/oracle.hpp"
#include "support/pair_zoo.hpp"

using namespace packstone;
using zoo::Zoo;

namespace {

constexpr ShapeKind kKinds[] = {ShapeKind::sphere,   ShapeKind::ellipsoid,
                                ShapeKind::cylinder, ShapeKind::spherocylinder,
                                ShapeKind::disk,     ShapeKind::ellipse};

template <class Check>
void for_bodies(std::uint64_t seed, int count, Check&& check) {
  for (const ShapeKind kind : kKinds) {
    Zoo zoo(seed + static_cast<std::uint64_t>(kind));
    for (int k = 0; k < count; ++k) {
      CAPTURE(name(kind), k);
      check(zoo.body(kind, zoo.log_uniform(1e-3, 1e3)), dimension(kind), zoo);
    }
  }
}

// A point of the surface along d.
Vec3 surface_point(const Body& body, const Vec3& d) {
  return (1.0 / static_cast<double>(oracle::gauge(body, d))) * d;
}

}  // namespace

TEST_CASE("support is within its stated rounding of long double, for aspects 0.02 to 100") {
  for_bodies(1, 5000, [](const Body& body, int dim, Zoo& zoo) {
    const Vec3 d = zoo.direction(dim);
    const double error = std::abs(static_cast<double>(support(body, d) - oracle::support(body, d)));
    REQUIRE(error <= kSupportRoundoff * circum_radius(body) * norm(d));
  });
}

TEST_CASE("support is homogeneous and even") {
  for_bodies(2, 500, [](const Body& body, int dim, Zoo& zoo) {
    const Vec3 d = zoo.direction(dim);
    REQUIRE(support(body, 4.0 * d) == 4.0 * support(body, d));
    REQUIRE(support(body, -d) == support(body, d));
  });
}

// With the next case, which attains the support by a point of the body, this pins its value.
TEST_CASE("no point of the surface reaches beyond the support plane") {
  for_bodies(3, 200, [](const Body& body, int dim, Zoo& zoo) {
    const Vec3 d = zoo.direction(dim);
    const double reach = support(body, d) + kSupportRoundoff * circum_radius(body);
    // Half of the points close to where the plane touches.
    const Vec3 touch = support_point(body, d);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 at =
          trial % 2 == 0 ? zoo.direction(dim) : touch + 1e-3 * in_radius(body) * zoo.direction(dim);
      REQUIRE(dot(d, surface_point(body, at)) <= reach);
    }
  });
}

TEST_CASE("support points lie on the body and attain the support, also next to the axis") {
  for_bodies(4, 3000, [](const Body& body, int dim, Zoo& zoo) {
    Vec3 d = zoo.direction(dim);
    if (const auto* rod = std::get_if<Cylinder>(&body); rod && zoo.uniform(0, 1) < 0.5) {
      d = normalized(rod->axis + zoo.log_uniform(1e-17, 1e-2) * d);
    }
    const Vec3 p = support_point(body, d);
    const double rounding = 2 * kSupportRoundoff * circum_radius(body);
    REQUIRE(std::abs(dot(d, p) - support(body, d)) <= rounding);
    REQUIRE((static_cast<double>(oracle::gauge(body, p)) - 1.0) * in_radius(body) <= rounding);
  });
}

TEST_CASE("contains never takes a point that long double puts outside") {
  long taken = 0;
  for_bodies(5, 5000, [&](const Body& body, int dim, Zoo& zoo) {
    const double factor = 1.0 + zoo.uniform(-1, 1) * zoo.log_uniform(1e-17, 1e-12);
    const Vec3 x = factor * surface_point(body, zoo.direction(dim));
    if (!contains(body, x)) return;
    ++taken;
    REQUIRE(oracle::gauge(body, x) <= 1.0L);
  });
  CHECK(taken > 1000);
}

TEST_CASE("contains takes points 1e-11 inside and refuses points 1e-11 outside") {
  for_bodies(6, 2000, [](const Body& body, int dim, Zoo& zoo) {
    const Vec3 x = surface_point(body, zoo.direction(dim));
    REQUIRE(contains(body, (1.0 - 1e-11) * x));
    REQUIRE_FALSE(contains(body, (1.0 + 1e-11) * x));
    REQUIRE(contains(body, Vec3{}));
  });
}
