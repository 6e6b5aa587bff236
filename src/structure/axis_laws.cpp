#include "structure/axis_laws.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <cmath>
#include <numbers>
#include <utility>

namespace packstone {
namespace {

constexpr int kMostNewtonSteps = 100;
constexpr int kMostTrials = 10'000;

std::size_t rank_of(const Vec3& moments) { return moments.z > 0.0 ? 3 : moments.y > 0.0 ? 2 : 1; }

// Solves the 2x2 system with columns `a`, `b`.
Vec2 solve(const Vec2& a, const Vec2& b, const Vec2& right) {
  const double determinant = a.x * b.y - a.y * b.x;
  return {(right.x * b.y - right.y * b.x) / determinant,
          (a.x * right.y - a.y * right.x) / determinant};
}

// --- angular central Gaussian ------------------------------------------------------------------

AngularCentralGaussian acg_from_logs(const Vec2& log_ratio) {
  return {{1.0, std::exp(0.5 * log_ratio.x), std::exp(0.5 * log_ratio.y)}};
}

Vec2 acg_residual(const Vec2& log_ratio, const Vec3& wanted) {
  const Vec3 found = acg_moments(acg_from_logs(log_ratio));
  return {std::log(found.y / wanted.y), std::log(found.z / wanted.z)};
}

// --- Bessel functions, scaled ------------------------------------------------------------------

struct BesselRatios {
  double scaled_i0;       // exp(-x) I_0(x)
  double one_minus_i1i0;  // 1 - I_1 / I_0
  double i1_over_x_i0;    // I_1 / (x I_0)
};

// Hankel's expansion of sqrt(2 pi x) exp(-x) I_n(x), mu = 4 n^2; below 1e-16 for x >= 30.
double hankel_series(double mu, double x) {
  double term = 1.0, sum = 1.0;
  for (int k = 1; k <= 24; ++k) {
    term *= -(mu - (2.0 * k - 1.0) * (2.0 * k - 1.0)) / (8.0 * x * k);
    sum += term;
  }
  return sum;
}

BesselRatios bessel_ratios(double x) {
  if (x < 1e-6) return {1.0 - x, 1.0 - 0.5 * x, 0.5};
  if (x < 30.0) {
    const double i0 = boost::math::cyl_bessel_i(0, x);
    const double ratio = boost::math::cyl_bessel_i(1, x) / i0;
    return {i0 * std::exp(-x), 1.0 - ratio, ratio / x};
  }
  const double i0 = hankel_series(0.0, x);
  const double ratio = hankel_series(4.0, x) / i0;
  // 1 - I1/I0 = 1/(2x) + 1/(8x^2) + 1/(8x^3) + O(x^-4), free of cancellation.
  const double rest = x < 1e4 ? 1.0 - ratio : (0.5 + (0.125 + 0.125 / x) / x) / x;
  return {i0 / std::sqrt(2.0 * std::numbers::pi * x), rest, ratio / x};
}

// --- Bingham -----------------------------------------------------------------------------------

// Moments of u_2^2 and u_3^2 up to the second, equations (2) and (3).
struct BinghamMoments {
  double weight = 0.0;
  double m2 = 0.0, m3 = 0.0;
  double m22 = 0.0, m23 = 0.0, m33 = 0.0;

  void add(const BinghamMoments& p) {
    weight += p.weight;
    m2 += p.m2;
    m3 += p.m3;
    m22 += p.m22;
    m23 += p.m23;
    m33 += p.m33;
  }
};

// The integrand of (2) at e = 1 - t.
BinghamMoments integrand(double kappa2, double kappa3, double e) {
  const double w = e * (2.0 - e);
  const BesselRatios bessel = bessel_ratios(0.5 * (kappa3 - kappa2) * w);
  const double p = std::exp(-kappa2 * w) * bessel.scaled_i0;
  const double minus = bessel.one_minus_i1i0;  // 1 - <cos 2 phi>
  const double sin_sq = bessel.i1_over_x_i0;   // <sin^2 2 phi>
  const double w2 = 0.25 * w * w;
  return {p,
          p * w * (1.0 - 0.5 * minus),
          p * w * 0.5 * minus,
          p * w2 * (4.0 - 2.0 * minus - sin_sq),
          p * w2 * sin_sq,
          p * w2 * std::max(0.0, 2.0 * minus - sin_sq)};
}

BinghamMoments panel_moments(double kappa2, double kappa3, double lo, double hi) {
  using Rule = boost::math::quadrature::gauss<double, 15>;
  const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  BinghamMoments sum;
  const auto add = [&](double node, double weight) {
    BinghamMoments p = integrand(kappa2, kappa3, middle + half * node);
    for (double* value : {&p.weight, &p.m2, &p.m3, &p.m22, &p.m23, &p.m33}) {
      *value *= half * weight;
    }
    sum.add(p);
  };
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double node = Rule::abscissa()[i], weight = Rule::weights()[i];
    add(node, weight);
    if (node != 0.0) add(-node, weight);
  }
  return sum;
}

BinghamMoments bingham_moments_3d(double kappa2, double kappa3) {
  BinghamMoments sum;
  double hi = 1.0;
  while (hi * std::max(1.0, kappa3) > 0.05) {
    sum.add(panel_moments(kappa2, kappa3, 0.5 * hi, hi));
    hi *= 0.5;
  }
  sum.add(panel_moments(kappa2, kappa3, 0.0, hi));
  for (double* value : {&sum.m2, &sum.m3, &sum.m22, &sum.m23, &sum.m33}) *value /= sum.weight;
  return sum;
}

// Plane: density exp(-kappa sin^2 phi), so that <u_1^2> - <u_2^2> = I_1 / I_0 at kappa / 2.
double kappa_in_plane(double wanted) {
  double kappa = 0.5 / wanted - 0.5 / (1.0 - wanted);
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const BesselRatios bessel = bessel_ratios(0.5 * kappa);
    const double found = 0.5 * bessel.one_minus_i1i0;
    const double variance =
        0.25 * (2.0 * bessel.one_minus_i1i0 - bessel.i1_over_x_i0) - found * found;
    const double step =
        std::clamp(found * std::log(found / wanted) / variance, -0.5 * kappa - 1.0, kappa + 1.0);
    kappa = std::max(0.0, kappa + step);
    if (std::abs(step) <= 1e-13 * (1.0 + kappa)) break;
  }
  return kappa;
}

std::pair<double, double> kappa_in_space(const Vec3& wanted) {
  // The Gaussian limit, and exact for the isotropic tensor.
  double kappa2 = 0.5 / wanted.y - 0.5 / wanted.x;
  double kappa3 = 0.5 / wanted.z - 0.5 / wanted.x;
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const BinghamMoments m = bingham_moments_3d(kappa2, kappa3);
    // d<u_i^2> / d kappa_j = -cov(u_i^2, u_j^2)
    const double cov = m.m23 - m.m2 * m.m3;
    const Vec2 step = solve({(m.m22 - m.m2 * m.m2) / m.m2, cov / m.m3},
                            {cov / m.m2, (m.m33 - m.m3 * m.m3) / m.m3},
                            {std::log(m.m2 / wanted.y), std::log(m.m3 / wanted.z)});
    const double step2 = std::clamp(step.x, -0.5 * kappa2 - 1.0, kappa2 + 1.0);
    const double step3 = std::clamp(step.y, -0.5 * kappa3 - 1.0, kappa3 + 1.0);
    kappa2 = std::max(0.0, kappa2 + step2);
    kappa3 = std::max(kappa2, kappa3 + step3);
    if (std::abs(step2) <= 1e-12 * (1.0 + kappa2) && std::abs(step3) <= 1e-12 * (1.0 + kappa3)) {
      break;
    }
  }
  return {kappa2, kappa3};
}

// sum over the rank of 1 / (b + 2 kappa_i) = 1; convex and falling, so Newton from b = 1 climbs.
double envelope_of(const Vec3& kappa, std::size_t rank) {
  double b = 1.0;
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    double excess = -1.0, slope = 0.0;
    for (std::size_t k = 0; k < rank; ++k) {
      const double inverse = 1.0 / (b + 2.0 * kappa[k]);
      excess += inverse;
      slope += inverse * inverse;
    }
    const double step = excess / slope;
    b += step;
    if (std::abs(step) <= 1e-14 * b) break;
  }
  return b;
}

}  // namespace

Vec3 acg_moments(const AngularCentralGaussian& law) {
  Vec3 b;
  for (std::size_t i = 0; i < 3; ++i) b[i] = 1.0 / (law.root_lambda[i] * law.root_lambda[i]);
  const double root = std::sqrt(b.x) * std::sqrt(b.y) * std::sqrt(b.z) / 3.0;
  return {root * boost::math::ellint_rd(b.y, b.z, b.x),
          root * boost::math::ellint_rd(b.x, b.z, b.y),
          root * boost::math::ellint_rd(b.x, b.y, b.z)};
}

AngularCentralGaussian acg_with_moments(const Vec3& wanted) {
  if (rank_of(wanted) < 3) return {wanted};
  Vec2 p{2.0 * std::log(wanted.y / wanted.x), 2.0 * std::log(wanted.z / wanted.x)};
  constexpr double h = 1e-6;
  constexpr double longest_step = 2.0;
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const Vec2 f = acg_residual(p, wanted);
    const Vec2 fx = acg_residual(p + Vec2{h, 0}, wanted);
    const Vec2 fy = acg_residual(p + Vec2{0, h}, wanted);
    const Vec2 step = solve((fx - f) / h, (fy - f) / h, -f);
    p = p + std::min(1.0, longest_step / std::max(norm(step), 1e-300)) * step;
    if (norm(step) < 1e-12) break;
  }
  return acg_from_logs(p);
}

Vec3 sample(const AngularCentralGaussian& law, RandomStream& random) noexcept {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return normalized(scale(law.root_lambda, {x, y, z}));
}

Vec3 bingham_moments(const Bingham& law) {
  if (law.rank == 1) return {1, 0, 0};
  if (law.rank == 2) {
    const double m2 = 0.5 * bessel_ratios(0.5 * law.kappa.y).one_minus_i1i0;
    return {1.0 - m2, m2, 0.0};
  }
  const BinghamMoments m = bingham_moments_3d(law.kappa.y, law.kappa.z);
  return {1.0 - m.m2 - m.m3, m.m2, m.m3};
}

Bingham bingham_with_moments(const Vec3& wanted) {
  Bingham law;
  law.rank = rank_of(wanted);
  if (law.rank == 2) law.kappa.y = kappa_in_plane(wanted.y);
  if (law.rank == 3) std::tie(law.kappa.y, law.kappa.z) = kappa_in_space(wanted);
  law.envelope = envelope_of(law.kappa, law.rank);
  return law;
}

Vec3 sample(const Bingham& law, RandomStream& random) noexcept {
  const double b = law.envelope;
  const auto q = static_cast<double>(law.rank);
  AngularCentralGaussian envelope{{0, 0, 0}};
  for (std::size_t i = 0; i < law.rank; ++i) {
    envelope.root_lambda[i] = 1.0 / std::sqrt(1.0 + 2.0 * law.kappa[i] / b);
  }
  Vec3 u;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    u = sample(envelope, random);
    const double s = dot(law.kappa, scale(u, u));
    // exp(-s) (1 + 2 s / b)^(q/2) is largest at s = (q - b) / 2.
    const double log_accept =
        -s + 0.5 * q * std::log1p(2.0 * s / b) + 0.5 * (q - b) - 0.5 * q * std::log(q / b);
    if (std::log(1.0 - random.uniform()) <= log_accept) break;
  }
  return u;
}

}  // namespace packstone
