#include "packstone/geometry/inscribed_balls.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"
#include "support/oracle.hpp"
#include "support/random_body.hpp"

using namespace packstone;
using std::numbers::pi;

namespace {

constexpr double kSpacings[] = {1.0, 0.5, 0.25};

// Of every shape, sizes over a range of 1 to 8.
std::vector<Body> some_bodies() {
  RandomStream random(1, StreamId::test, 0);
  const auto length = [&] { return std::exp(random.uniform(0.0, std::log(8.0))); };
  std::vector<Body> bodies;
  for (int i = 0; i < 60; ++i) {
    bodies.push_back(test::random_body(static_cast<ShapeKind>(i % 6), random, length));
  }
  return bodies;
}

Vec3 direction(const Body& body, RandomStream& random) {
  if (dimension(kind(body)) == 3) return random_direction(random);
  const double angle = random.uniform(0.0, 2 * pi);
  return {std::cos(angle), std::sin(angle), 0.0};
}

// 2 int max_i sqrt(r_i^2 - (x - x_i)^2) dx of circles along x.
double union_area(const std::vector<InscribedBall>& circles, double a) {
  constexpr int kCount = 20000;
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = a * (2.0 * (i + 0.5) / kCount - 1.0);
    double height_sq = 0.0;
    for (const InscribedBall& c : circles) {
      height_sq = std::max(height_sq, c.radius * c.radius - (x - c.center.x) * (x - c.center.x));
    }
    sum += std::sqrt(height_sq);
  }
  return 4.0 * a * sum / kCount;
}

// Share of the body that the balls cover, from random points of its box.
double covered(const Body& body, const std::vector<InscribedBall>& balls) {
  RandomStream random(2, StreamId::test, 0);
  const Vec3 half = half_extents(body);
  int inside = 0, hit = 0;
  while (inside < 20000) {
    const Vec3 p{random.uniform(-half.x, half.x), random.uniform(-half.y, half.y),
                 random.uniform(-half.z, half.z)};
    if (oracle::gauge(body, p) > 1.0L) continue;
    ++inside;
    hit += std::any_of(balls.begin(), balls.end(), [&](const InscribedBall& b) {
      return norm_sq(p - b.center) <= b.radius * b.radius;
    });
  }
  return hit / 20000.0;
}

Body turned(const Vec3& semi_axes) {
  return Ellipsoid{semi_axes, normalized(Quaternion{0.3, -0.5, 0.7, 0.2})};
}

}  // namespace

TEST_CASE("inscribed balls never reach out of the body, and touch its surface") {
  RandomStream random(3, StreamId::test, 0);
  for (const Body& body : some_bodies()) {
    for (const double spacing : kSpacings) {
      const auto balls = inscribed_balls(body, spacing);
      double nearest = circum_radius(body);
      for (int k = 0; k < 400; ++k) {
        const Vec3 d = direction(body, random);
        const double reach = support(body, d);
        for (const InscribedBall& ball : balls) {
          const double room = reach - dot(ball.center, d) - ball.radius;
          REQUIRE(room >= -1e-14 * circum_radius(body));
          nearest = std::min(nearest, room);
        }
      }
      CHECK(nearest < 0.03 * circum_radius(body));
    }
  }
}

TEST_CASE("inscribed balls of an ellipse: number and area of the union at every spacing") {
  const struct {
    double spacing;
    std::size_t count[4];
    double lacking_percent[4];
  } table[] = {{1.0, {3, 5, 9, 11}, {8.6, 6.6, 6.3, 5.4}},
               {0.5, {5, 9, 15, 23}, {2.3, 1.7, 1.3, 1.2}},
               {0.25, {11, 17, 31, 45}, {0.57, 0.39, 0.31, 0.29}},
               {0.1, {25, 45, 81, 115}, {0.08, 0.06, 0.05, 0.05}}};
  const double aspects[] = {1.5, 2.0, 3.0, 4.0};
  for (const auto& row : table) {
    for (int k = 0; k < 4; ++k) {
      const double a = aspects[k];
      const auto circles = inscribed_balls(Ellipse{{a, 1.0}, 0.0}, row.spacing);
      CHECK(circles.size() == row.count[k]);
      const double lacking = 100.0 * (1.0 - union_area(circles, a) / (pi * a));
      CHECK(lacking == Approx(row.lacking_percent[k]).margin(row.spacing > 0.3 ? 0.055 : 0.0055));
    }
  }
}

TEST_CASE("inscribed balls satisfy the equations of the multi-circles") {
  const double a = 3.0, b = 1.25, spacing = 0.4;
  const auto circles = inscribed_balls(Ellipse{{b, a}, -pi / 2}, spacing);
  const std::size_t middle = circles.size() / 2;
  CHECK(circles[middle] == InscribedBall{{0, 0, 0}, b});
  CHECK(circles[middle + 1].center.x == Approx(spacing * b));
  CHECK(circles.back().center.x == Approx(a - b * b / a));
  CHECK(circles.back().radius == Approx(b * b / a));
  for (std::size_t i = middle + 1; i + 2 < circles.size(); ++i) {
    const auto contact = [&](std::size_t k) {
      const double x = circles[k].center.x * a * a / (a * a - b * b);
      return b * std::sqrt(1 - x * x / (a * a));
    };
    const double steps = (circles[i + 1].center.x - circles[i].center.x) /
                         (circles[i].center.x - circles[i - 1].center.x);
    CHECK(steps == Approx(contact(i) / contact(i - 1)));
  }
}

TEST_CASE("inscribed balls are symmetric about the center and in order along a line") {
  for (const Body& body : some_bodies()) {
    const auto balls = inscribed_balls(body, 0.5);
    Vec3 sum;
    for (const InscribedBall& ball : balls) sum += ball.center;
    CHECK(norm(sum) <= 1e-12 * static_cast<double>(balls.size()) * circum_radius(body));
    if (kind(body) != ShapeKind::spherocylinder && kind(body) != ShapeKind::ellipse) continue;
    const Vec3 axis = normalized(balls.back().center - balls.front().center);
    CHECK(std::is_sorted(balls.begin(), balls.end(), [&](const auto& p, const auto& q) {
      return dot(p.center, axis) < dot(q.center, axis);
    }));
  }
}

TEST_CASE("a round body is one ball, whatever it is called") {
  for (const Body& body :
       {Body{Sphere{2}}, Body{Disk{2}}, Body{Ellipse{{2, 2}, 1}}, turned({2, 2, 2})}) {
    const auto balls = inscribed_balls(body, 0.5);
    REQUIRE(balls.size() == 1);
    CHECK(balls[0] == InscribedBall{{0, 0, 0}, 2});
  }
}

TEST_CASE("a prolate ellipsoid has the spheres of its ellipse") {
  const auto spheres = inscribed_balls(Ellipsoid{{1, 3, 1}, {}}, 0.5);
  const auto circles = inscribed_balls(Ellipse{{1, 3}, 0.0}, 0.5);
  REQUIRE(spheres.size() == circles.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    CHECK(std::abs(spheres[i].center.y) == Approx(std::abs(circles[i].center.y)).margin(1e-15));
    CHECK(spheres[i].radius == Approx(circles[i].radius));
  }
}

TEST_CASE("inscribed balls cover bodies in space, the better the closer they are") {
  const struct {
    Body body;
    double least[3];
  } table[] = {{turned({2, 1, 1}), {0.87, 0.965, 0.99}},
               {turned({4, 1, 1}), {0.89, 0.97, 0.99}},
               {turned({2, 2, 1}), {0.82, 0.96, 0.985}},
               {turned({4, 4, 1}), {0.89, 0.97, 0.99}},
               {turned({3, 2, 1}), {0.85, 0.97, 0.99}},
               {turned({4, 1.1, 1}), {0.85, 0.93, 0.975}},
               {Spherocylinder{1, 3, {0, 0.6, 0.8}}, {0.90, 0.975, 0.99}},
               {Cylinder{1, 3, {0, 0.6, 0.8}}, {0.91, 0.96, 0.98}},
               {Cylinder{1, 1, {0, 0.6, 0.8}}, {0.91, 0.935, 0.955}},
               {Cylinder{3, 1, {0, 0.6, 0.8}}, {0.92, 0.96, 0.98}}};
  for (const auto& row : table) {
    for (int k = 0; k < 3; ++k) {
      const auto balls = inscribed_balls(row.body, kSpacings[k]);
      const double share = covered(row.body, balls);
      INFO(name(kind(row.body)) << ", spacing " << kSpacings[k] << ": " << balls.size()
                                << " balls cover " << share);
      CHECK(share >= row.least[k]);
    }
  }
}

TEST_CASE("inscribed balls scale with the body") {
  for (const Body& body : some_bodies()) {
    const auto balls = inscribed_balls(body, 0.5);
    const auto large = inscribed_balls(scaled(body, 4.0), 0.5);
    REQUIRE(large.size() == balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
      CHECK(large[i].center == 4.0 * balls[i].center);
      CHECK(large[i].radius == 4.0 * balls[i].radius);
    }
  }
}

TEST_CASE("inscribed_balls refuses a spacing out of range") {
  for (const double spacing : {0.0, -1.0, 0.0099, 1.01, std::nan("")}) {
    CHECK_THROWS_AS(inscribed_balls(Disk{1}, spacing), InvalidArgument);
  }
}
