#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/oracle.hpp"
#include "support/pair_zoo.hpp"

using namespace packstone;
using std::numbers::pi;
using zoo::Zoo;

namespace {

// Integrals over the body from its gauge alone: the surface stands at distance 1 / gauge(d).
struct Quadrature {
  double volume = 0.0;
  SymMat3 second_moment;
};

void add(Quadrature& q, const Body& body, const Vec3& d, double weight, int dim) {
  const double distance = 1.0 / static_cast<double>(oracle::gauge(body, d));
  q.volume += weight * std::pow(distance, dim) / dim;
  q.second_moment = q.second_moment + (weight * std::pow(distance, dim + 2) / (dim + 2)) * dyad(d);
}

Quadrature integrate(const Body& body) {
  Quadrature q;
  constexpr int kCount = 400;
  if (dimension(kind(body)) == 2) {
    for (int i = 0; i < 100 * kCount; ++i) {
      const double phi = 2 * pi * (i + 0.5) / (100 * kCount);
      add(q, body, {std::cos(phi), std::sin(phi), 0}, 2 * pi / (100 * kCount), 2);
    }
    return q;
  }
  for (int i = 0; i < kCount; ++i) {
    const double z = -1.0 + 2.0 * (i + 0.5) / kCount, rho = std::sqrt(1 - z * z);
    for (int j = 0; j < kCount; ++j) {
      const double phi = 2 * pi * (j + 0.5) / kCount;
      add(q, body, {rho * std::cos(phi), rho * std::sin(phi), z}, 4 * pi / (kCount * kCount), 3);
    }
  }
  return q;
}

double distance(const SymMat3& a, const SymMat3& b) {
  const SymMat3 d = a - b;
  return std::sqrt(d.xx * d.xx + d.yy * d.yy + d.zz * d.zz +
                   2 * (d.yz * d.yz + d.xz * d.xz + d.xy * d.xy));
}

// Area of an ellipsoid by the midpoint rule over its parameters, spectral in both.
double parametric_area(const Vec3& s) {
  constexpr int kCount = 1500;
  double area = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double theta = pi * (i + 0.5) / kCount, st = std::sin(theta), ct = std::cos(theta);
    for (int j = 0; j < kCount / 4; ++j) {
      const double phi = 0.5 * pi * (j + 0.5) / (kCount / 4);
      const double sp = std::sin(phi), cp = std::cos(phi);
      area += st * norm(Vec3{s.y * s.z * st * cp, s.x * s.z * st * sp, s.x * s.y * ct});
    }
  }
  return 4 * area * (pi / kCount) * (0.5 * pi / (kCount / 4));
}

}  // namespace

TEST_CASE("volume and second moment agree with quadrature over the gauge, turned bodies") {
  Zoo zoo(1);
  const Quaternion q = zoo.rotation();
  const Body bodies[] = {Sphere{1.3},
                         rotated(Ellipsoid{{0.7, 1.1, 1.9}}, q),
                         rotated(Cylinder{0.8, 1.1}, q),
                         rotated(Cylinder{1.2, 0.5}, q),
                         rotated(Spherocylinder{0.8, 1.2}, q),
                         Disk{0.9},
                         Ellipse{{2.0, 0.7}, 0.6}};
  for (const Body& body : bodies) {
    CAPTURE(name(kind(body)));
    const Quadrature found = integrate(body);
    // The rim of a cylinder costs the midpoint rule its order.
    CHECK(found.volume == Approx(volume(body)).epsilon(3e-4));
    const SymMat3 exact = second_moment(body);
    CHECK(distance(found.second_moment, exact) <= 1e-3 * trace(exact));
  }
}

TEST_CASE("surface of an ellipsoid agrees with quadrature for aspects from 0.02 to 100") {
  for (const Vec3& s : {Vec3{1, 1, 1}, Vec3{1, 2, 3}, Vec3{0.02, 1, 1}, Vec3{100, 1, 1},
                        Vec3{100, 10, 1}, Vec3{0.02, 0.3, 1}}) {
    CAPTURE(s.x, s.y, s.z);
    CHECK(surface(Ellipsoid{s}) == Approx(parametric_area(s)).epsilon(1e-5));
  }
}

TEST_CASE("perimeter of an ellipse agrees with quadrature for aspects from 0.02 to 100") {
  for (const double aspect : {0.02, 0.5, 1.0, 7.0, 100.0}) {
    double length = 0.0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
      const double t = 2 * pi * (i + 0.5) / kCount;
      length += std::hypot(aspect * std::sin(t), std::cos(t)) * 2 * pi / kCount;
    }
    CHECK(surface(Ellipse{{aspect, 1.0}}) == Approx(length).epsilon(1e-12));
  }
}

TEST_CASE("volume grows by surface times thickness") {
  const double e = 1e-6;
  CHECK((volume(Sphere{1 + e}) - volume(Sphere{1})) / e ==
        Approx(surface(Sphere{1})).epsilon(1e-5));
  const auto grown = (volume(Spherocylinder{0.5 + e, 2}) - volume(Spherocylinder{0.5, 2})) / e;
  CHECK(grown == Approx(surface(Spherocylinder{0.5, 2})).epsilon(1e-5));
  CHECK((volume(Disk{1 + e}) - volume(Disk{1})) / e == Approx(surface(Disk{1})).epsilon(1e-5));
  const auto rod = (volume(Cylinder{0.5 + e, 2 + e}) - volume(Cylinder{0.5, 2})) / e;
  CHECK(rod == Approx(surface(Cylinder{0.5, 2})).epsilon(1e-5));
}

TEST_CASE("bodies that are the same in two ways have the same measures") {
  CHECK(volume(Ellipsoid{{2, 2, 2}}) == Approx(volume(Sphere{2})).epsilon(1e-14));
  CHECK(surface(Ellipsoid{{2, 2, 2}}) == Approx(surface(Sphere{2})).epsilon(1e-14));
  CHECK(surface(Ellipse{{2, 2}}) == Approx(surface(Disk{2})).epsilon(1e-14));
  CHECK(volume(Spherocylinder{1, 2}) ==
        Approx(volume(Sphere{1}) + volume(Cylinder{1, 2})).epsilon(1e-14));
}

TEST_CASE("measures follow scale and turn") {
  Zoo zoo(3);
  for (int i = 0; i < 6; ++i) {
    const auto shape = static_cast<ShapeKind>(i);
    const int dim = dimension(shape);
    for (int k = 0; k < 200; ++k) {
      const Body body = zoo.body(shape, 1.0);
      const Body large = scaled(body, 3.0);
      CHECK(volume(large) == Approx(std::pow(3.0, dim) * volume(body)).epsilon(1e-13));
      CHECK(surface(large) == Approx(std::pow(3.0, dim - 1) * surface(body)).epsilon(1e-13));
      const Quaternion q =
          dim == 2 ? from_axis_angle({0, 0, 1}, zoo.uniform(-3, 3)) : zoo.rotation();
      const Body turned = rotated(body, q);
      const Vec3 d = zoo.direction(dim);
      // The moment along d equals that of the turned body along the turned d.
      const double before = dot(d, second_moment(body) * d);
      const Vec3 e = rotate(q, d);
      CHECK(dot(e, second_moment(turned) * e) ==
            Approx(before).margin(1e-13 * trace(second_moment(body))));
      CHECK(static_cast<double>(oracle::support(turned, e) - oracle::support(body, d)) ==
            Approx(0.0).margin(1e-14 * std::sqrt(trace(second_moment(body)) / volume(body))));
    }
  }
}

TEST_CASE("the long axis is where ellipsoids, ellipses and spherocylinders reach farthest") {
  Zoo zoo(4);
  for (const ShapeKind shape :
       {ShapeKind::ellipsoid, ShapeKind::spherocylinder, ShapeKind::ellipse}) {
    for (int k = 0; k < 100; ++k) {
      const Body body = zoo.body(shape, 1.0);
      const Vec3 axis = long_axis(body);
      CHECK(norm(axis) == Approx(1.0).epsilon(1e-12));
      CHECK(support(body, axis) == Approx(circum_radius(body)).epsilon(1e-12));
    }
  }
  CHECK(long_axis(Cylinder{1, 2, {0, 1, 0}}) == Vec3{0, 1, 0});
  CHECK(long_axis(Sphere{1}) == Vec3{});
  CHECK(long_axis(Disk{1}) == Vec3{});
}
