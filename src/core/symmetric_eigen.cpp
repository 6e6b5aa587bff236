#include "packstone/core/symmetric_eigen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace packstone {
namespace {

using Dense = std::array<std::array<double, 3>, 3>;

// Turns the rows and columns p, q of `a` so that a[p][q] = 0, and the rows of `vectors` with them.
void jacobi_rotation(Dense& a, std::array<Vec3, 3>& vectors, std::size_t p, std::size_t q) {
  const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(1.0, theta));
  const double c = 1.0 / std::hypot(1.0, t);
  const double s = c * t;
  const std::size_t r = 3 - p - q;
  a[p][p] -= t * a[p][q];
  a[q][q] += t * a[p][q];
  a[p][q] = a[q][p] = 0.0;
  const double rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  const Vec3 vp = vectors[p], vq = vectors[q];
  vectors[p] = c * vp - s * vq;
  vectors[q] = s * vp + c * vq;
}

double largest_entry(const SymMat3& m) {
  return std::max({std::abs(m.xx), std::abs(m.yy), std::abs(m.zz), std::abs(m.yz), std::abs(m.xz),
                   std::abs(m.xy)});
}

}  // namespace

SymmetricEigen symmetric_eigen(const SymMat3& m) noexcept {
  Dense a{{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}};
  std::array<Vec3, 3> vectors{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  // Below rounding: turning by it would only stir equal eigenvalues.
  const double nothing = 0x1p-56 * largest_entry(m);
  // Convergence is quadratic: five sweeps do in practice.
  bool turned = true;
  for (int sweep = 0; sweep < 30 && turned; ++sweep) {
    turned = false;
    for (const auto& [p, q] : {std::pair{0U, 1U}, std::pair{0U, 2U}, std::pair{1U, 2U}}) {
      if (std::abs(a[p][q]) <= nothing) continue;
      jacobi_rotation(a, vectors, p, q);
      turned = true;
    }
  }
  std::array<double, 3> values{a[0][0], a[1][1], a[2][2]};
  const auto order = [&](std::size_t i, std::size_t j) {
    if (values[i] >= values[j]) return;
    std::swap(values[i], values[j]);
    std::swap(vectors[i], vectors[j]);
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  if (dot(cross(vectors[0], vectors[1]), vectors[2]) < 0.0) vectors[2] = -vectors[2];
  return {{values[0], values[1], values[2]}, {vectors[0], vectors[1], vectors[2]}};
}

}  // namespace packstone
