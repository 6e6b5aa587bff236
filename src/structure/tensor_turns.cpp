#include "structure/tensor_turns.hpp"

#include <numbers>

namespace packstone {

Vec6 components(const SymMat3& a) {
  constexpr double r = std::numbers::sqrt2;
  return {a.xx, a.yy, a.zz, r * a.yz, r * a.xz, r * a.xy};
}

SymMat3 from_components(const Vec6& s) {
  constexpr double r = 1.0 / std::numbers::sqrt2;
  return {s[0], s[1], s[2], r * s[3], r * s[4], r * s[5]};
}

std::array<Vec3, 6> basis_turns(const Vec3& u) {
  constexpr double r = 1.0 / std::numbers::sqrt2;
  std::array<Vec3, 6> t{Vec3{u.x, 0, 0},           Vec3{0, u.y, 0},
                        Vec3{0, 0, u.z},           Vec3{0, r * u.z, r * u.y},
                        Vec3{r * u.z, 0, r * u.x}, Vec3{r * u.y, r * u.x, 0}};
  for (Vec3& v : t) v -= dot(u, v) * u;
  return t;
}

void add_products(const std::array<Vec3, 6>& turns, double weight, Mat6& sum) {
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b <= a; ++b) sum[a][b] += weight * dot(turns[a], turns[b]);
  }
}

Mat6 made_definite(Mat6 g) {
  double tr = 0.0;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b <= a; ++b) g[b][a] = g[a][b];
    tr += g[a][a];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) g[a][b] += tr / 9.0;
  }
  for (std::size_t a = 0; a < 6; ++a) g[a][a] += 1e-13 * tr + 1e-300;
  return g;
}

Vec6 solve(Mat6 g, Vec6 x) {
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = k + 1; i < 6; ++i) {
      const double factor = g[i][k] / g[k][k];
      for (std::size_t j = k; j < 6; ++j) g[i][j] -= factor * g[k][j];
      x[i] -= factor * x[k];
    }
  }
  for (std::size_t k = 6; k-- > 0;) {
    for (std::size_t j = k + 1; j < 6; ++j) x[k] -= g[k][j] * x[j];
    x[k] /= g[k][k];
  }
  return x;
}

}  // namespace packstone
