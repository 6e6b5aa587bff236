#pragma once

/// @file
/// The two families of axial laws that a prescribed tensor is drawn from, in its own eigenframe.

#include <cstddef>

#include "packstone/core/random.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// Angular central Gaussian law: u = L z / |L z|, z standard normal, L diagonal.
/// D. E. Tyler, Biometrika 74 (1987) 579-589.
struct AngularCentralGaussian {
  Vec3 root_lambda{1, 1, 1};  ///< Diagonal of L; 0 where u has no component.
};

/// The law with <u_i^2> = moments[i], descending, >= 0, of sum 1.
///
/// With b_i = 1 / lambda_i
///   (1)  <u_i^2> = sqrt(b_1 b_2 b_3) R_D(b_j, b_k, b_i) / 3,
/// R_D after B. C. Carlson, Numer. Algorithms 10 (1995) 13-26. Newton on log lambda_2 / lambda_1
/// and log lambda_3 / lambda_1. In the plane <u_i^2> is proportional to sqrt(lambda_i).
[[nodiscard]] AngularCentralGaussian acg_with_moments(const Vec3& moments);

/// Moments (1) of the law; entries of root_lambda > 0.
[[nodiscard]] Vec3 acg_moments(const AngularCentralGaussian& law);

[[nodiscard]] Vec3 sample(const AngularCentralGaussian& law, RandomStream& random) noexcept;

/// Bingham law: density proportional to exp(-sum kappa_i u_i^2), kappa_1 = 0, in `rank` dimensions
/// (components from `rank` on are 0). C. Bingham, Ann. Stat. 2 (1974) 1201-1225.
struct Bingham {
  Vec3 kappa;  ///< 0 <= kappa_2 <= kappa_3 up to rounding.
  std::size_t rank = 3;
  double envelope = 3.0;  ///< b of the rejection from an angular central Gaussian; 1 <= b <= rank.
};

/// The law with <u_i^2> = moments[i], descending, >= 0, of sum 1; zeros lower the rank.
///
/// About axis 1, with w = u_2^2 + u_3^2 and d = kappa_3 - kappa_2,
///   (2)  <f(w)> = integral_0^1 f exp(-kappa_2 w - d w / 2) I_0(d w / 2) dt / Z,  w = 1 - t^2,
///   (3)  <u_2^2 - u_3^2> = <w I_1 / I_0>,
/// by Gauss-Legendre on panels graded towards w = 0. Newton on kappa with the covariance of u_i^2
/// and u_j^2 as derivative, which is exact for an exponential family.
[[nodiscard]] Bingham bingham_with_moments(const Vec3& moments);

/// Moments <u_i^2> of the law.
[[nodiscard]] Vec3 bingham_moments(const Bingham& law);

/// By rejection from the angular central Gaussian law with 1 / lambda_i = 1 + 2 kappa_i / b:
/// J. T. Kent, A. M. Ganeiban, K. V. Mardia, J. Comput. Graph. Stat. 27 (2018) 291-301.
/// Accepts at least half of the trials for rank 3.
[[nodiscard]] Vec3 sample(const Bingham& law, RandomStream& random) noexcept;

}  // namespace packstone
