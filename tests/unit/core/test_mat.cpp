#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"

namespace packstone {
namespace {

constexpr double kRounding = 1e-15;

TEST_CASE("a product of matrices acts like one after the other") {
  const Mat3 a{{1, 2, 3}, {-4, 5, 6}, {7, 8, -9}};
  const Mat3 b{{0, 1, 0}, {2, 0, 1}, {1, -1, 3}};
  const Vec3 v{0.5, -2, 4};
  CHECK((a * b) * v == a * (b * v));
  CHECK(transposed(a) * v == mul_transposed(a, v));
  CHECK(transposed(transposed(a)) == a);
}

TEST_CASE("a dyad projects, and its trace is the square of the length") {
  const Vec3 u{1, -2, 3}, v{4, 0, -5};
  CHECK(dyad(u) * v == dot(u, v) * u);
  CHECK(trace(dyad(u)) == norm_sq(u));
}

TEST_CASE("a rotated diagonal has the columns as eigenvectors") {
  RandomStream random(5, StreamId::test);
  const Vec3 d{3, -1, 0.25};
  for (int i = 0; i < 50; ++i) {
    const Mat3 r = to_matrix(random_rotation(random));
    const SymMat3 a = rotated_diagonal(r, d);
    CHECK(norm(a * r.col_x - d.x * r.col_x) < 10 * kRounding);
    CHECK(norm(a * r.col_y - d.y * r.col_y) < 10 * kRounding);
    CHECK(norm(a * r.col_z - d.z * r.col_z) < 10 * kRounding);
  }
}

TEST_CASE("sums, differences and multiples go entry by entry") {
  const SymMat3 a{1, 2, 3, 4, 5, 6}, b{6, 5, 4, 3, 2, 1};
  CHECK(a + b == SymMat3{7, 7, 7, 7, 7, 7});
  CHECK(a - b == SymMat3{-5, -3, -1, 1, 3, 5});
  CHECK(2.0 * a == SymMat3{2, 4, 6, 8, 10, 12});
}

}  // namespace
}  // namespace packstone
