#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"

namespace packstone {
namespace {

// A few roundings of numbers of size 1.
constexpr double kRounding = 1e-15;

double difference(const Vec3& a, const Vec3& b) { return norm(a - b); }

TEST_CASE("the product of quaternions turns by the right one first") {
  RandomStream random(1, StreamId::test);
  for (int i = 0; i < 200; ++i) {
    const Quaternion p = random_rotation(random), q = random_rotation(random);
    const Vec3 v = random_direction(random);
    CHECK(difference(rotate(p * q, v), rotate(p, rotate(q, v))) < 4 * kRounding);
    CHECK(difference(rotate(conjugate(p), rotate(p, v)), v) < 4 * kRounding);
  }
}

TEST_CASE("the matrix of a quaternion is a rotation and its columns are the body axes") {
  RandomStream random(2, StreamId::test);
  for (int i = 0; i < 200; ++i) {
    const Quaternion q = random_rotation(random);
    const Mat3 m = to_matrix(q);
    CHECK(difference(cross(m.col_x, m.col_y), m.col_z) < 4 * kRounding);
    CHECK(difference(rotate(q, {0, 1, 0}), m.col_y) == 0.0);
  }
}

TEST_CASE("a turn about an axis leaves it and moves what is perpendicular by the angle") {
  const Vec3 axis = normalized(Vec3{1, 2, -2});
  const Vec3 v = any_perpendicular(axis);
  const Quaternion q = from_axis_angle(axis, 0.7);
  CHECK(difference(rotate(q, axis), axis) < 2 * kRounding);
  CHECK(dot(rotate(q, v), v) == Approx(std::cos(0.7)).epsilon(1e-14));
  CHECK(dot(cross(v, rotate(q, v)), axis) == Approx(std::sin(0.7)).epsilon(1e-14));
}

TEST_CASE("from_z_to turns z to the axis to full precision, also next to -z") {
  RandomStream random(3, StreamId::test);
  std::vector<Vec3> axes{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  for (int i = 0; i < 200; ++i) axes.push_back(random_direction(random));
  for (double tilt : {1e-3, 1e-6, 1e-7, 1e-8, 1e-12, 1e-200}) {
    axes.push_back(normalized(Vec3{tilt, -2 * tilt, -1}));
    axes.push_back(normalized(Vec3{tilt, 0.5 * tilt, 1}));
  }
  for (const Vec3& u : axes) {
    const Quaternion q = from_z_to(u);
    CHECK(norm(q) == Approx(1.0).epsilon(1e-15));
    CHECK(difference(rotate(q, {0, 0, 1}), u) < 4 * kRounding);
    // The shortest rotation has its axis perpendicular to z.
    CHECK(q.z == 0.0);
    CHECK(q.w >= 0.0);
  }
}

}  // namespace
}  // namespace packstone
