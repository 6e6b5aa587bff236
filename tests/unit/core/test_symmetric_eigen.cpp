#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/symmetric_eigen.hpp"

namespace packstone {
namespace {

double largest(const SymMat3& a) {
  const double m = std::max({std::abs(a.xx), std::abs(a.yy), std::abs(a.zz)});
  return std::max({m, std::abs(a.yz), std::abs(a.xz), std::abs(a.xy)});
}

void check_eigen(const SymMat3& a) {
  const SymmetricEigen eigen = symmetric_eigen(a);
  CHECK(largest(rotated_diagonal(eigen.vectors, eigen.values) - a) <= 3e-15 * largest(a));
  CHECK((eigen.values.x >= eigen.values.y && eigen.values.y >= eigen.values.z));
  CHECK(norm(cross(eigen.vectors.col_x, eigen.vectors.col_y) - eigen.vectors.col_z) < 3e-15);
}

TEST_CASE("eigenvalues and eigenvectors give the matrix back") {
  RandomStream random(17, StreamId::test);
  for (int i = 0; i < 500; ++i) {
    SymMat3 a;
    for (double* entry : {&a.xx, &a.yy, &a.zz, &a.yz, &a.xz, &a.xy}) *entry = random.normal();
    check_eigen(a);
    check_eigen(1e150 * a);
    check_eigen(1e-150 * a);
  }
}

TEST_CASE("equal and nearly equal eigenvalues keep a right-handed frame") {
  RandomStream random(19, StreamId::test);
  for (double split : {0.0, 1e-16, 1e-12, 1e-8, 1e-4}) {
    for (int i = 0; i < 50; ++i) {
      const Mat3 r = to_matrix(random_rotation(random));
      check_eigen(rotated_diagonal(r, {1 + split, 1, 1 - split}));
      check_eigen(rotated_diagonal(r, {1, split, 0}));
    }
  }
}

TEST_CASE("a diagonal matrix has the coordinate axes as eigenvectors, exactly") {
  const SymmetricEigen eigen = symmetric_eigen({0.25, 0.7, 0.05, 0, 0, 0});
  CHECK(eigen.values == Vec3{0.7, 0.25, 0.05});
  CHECK(eigen.vectors.col_x == Vec3{0, 1, 0});
  CHECK(eigen.vectors.col_y == Vec3{1, 0, 0});
  CHECK(eigen.vectors.col_z == Vec3{0, 0, -1});
}

TEST_CASE("a matrix in the plane keeps z apart, exactly") {
  const SymmetricEigen eigen = symmetric_eigen({0.5, 0.5, 0, 0, 0, 0.3});
  CHECK(eigen.values.x == Approx(0.8).epsilon(1e-15));
  CHECK(eigen.vectors.col_x.z == 0.0);
  CHECK(eigen.vectors.col_y.z == 0.0);
  CHECK(std::abs(eigen.vectors.col_z.z) == 1.0);
}

}  // namespace
}  // namespace packstone
