#pragma once

/// @file
/// The least value of a quadratic function of unit vectors, bounded from below.
///
/// For every t with Q + t I positive definite, weak duality gives
///
///     d.Qd / 2 - g.d  >=  -t/2 - g.(Q + t I)^-1 g / 2        for all |d| = 1                (1)
///
/// with equality for the t at which the solution d0 of (Q + t I) d = g has length 1, or, where
/// there is none, at the end of the range: many local minima, but no duality gap. From d0 on,
///
///     d.Qd / 2 - g.d  =  bound + (d - d0).(Q + t I)(d - d0) / 2                             (2)
///
/// Reference: J. J. More, D. C. Sorensen, SIAM J. Sci. Stat. Comput. 4 (1983) 553-572.

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/secular_equation.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/symmetric_eigen.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// d.Qd / 2 - g.d + constant.
struct SphereQuadratic {
  SymMat3 q;
  Vec3 g;
  double constant = 0.0;

  double at(const Vec3& d) const { return 0.5 * dot(d, q * d) - dot(g, d) + constant; }
  friend SphereQuadratic operator+(const SphereQuadratic& x, const SphereQuadratic& y) {
    return {x.q + y.q, x.g + y.g, x.constant + y.constant};
  }
};

struct LeastOnSphere {
  double bound = 0.0;      ///< Equation (1) at its best t, as evaluated.
  double roundoff = 0.0;   ///< The true least value is no less than bound - roundoff.
  Vec3 at;                 ///< d0, unit.
  double stiffness = 0.0;  ///< Least eigenvalue of Q + t I: how fast (2) rises from d0.
};

/// Bounds f over the unit sphere; the entries of f may be off by 4 units of rounding themselves.
inline LeastOnSphere least_on_sphere(const SphereQuadratic& f) {
  const SymmetricEigen eigen = symmetric_eigen(f.q);
  const Vec3& values = eigen.values;
  const Vec3 g = mul_transposed(eigen.vectors, f.g);
  const SecularEquation<3> equation{{std::abs(g.x), std::abs(g.y), std::abs(g.z)},
                                    {values.x - values.z, values.y - values.z, 0.0}};
  const bool degenerate = equation.is_degenerate();
  const double sigma = degenerate ? 0.0 : equation.root();
  std::array<double, 3> w = equation.w(sigma);
  double twice = values.z - sigma;
  for (std::size_t i = 0; i < 3; ++i) twice -= w[i] * equation.numerator[i];
  if (degenerate) w[2] = std::sqrt(std::fmax(0.0, 1.0 - w[0] * w[0] - w[1] * w[1]));
  const Vec3 unit{std::copysign(w[0], g.x), std::copysign(w[1], g.y), std::copysign(w[2], g.z)};
  // |d.dQ d| / 2 for the error of the eigenvalues, 9 units of |Q|, and of its entries; the rest is
  // a few products and sums.
  const double roundoff = 12 * kUnitRoundoff * (norm(values) + norm(f.g) + std::abs(f.constant));
  return {0.5 * twice + f.constant, roundoff, eigen.vectors * normalized(unit), sigma};
}

}  // namespace packstone
