#include "packstone/core/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace packstone {

void RandomStream::fill_block() noexcept {
  const r123::Philox4x64::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const r123::Philox4x64::key_type key{{key_[0], key_[1]}};
  const auto block = r123::Philox4x64{}(counter, key);
  for (unsigned i = 0; i < 4; ++i) block_[i] = block[i];
  ++counter_[0];
  next_ = 0;
}

std::uint64_t RandomStream::below(std::uint64_t n) noexcept {
  // Lemire's multiply-shift with rejection: D. Lemire, ACM Trans. Model. Comput. Simul. 29
  // (2019) 3.
  __extension__ using Wide = unsigned __int128;
  Wide product = static_cast<Wide>(bits()) * n;
  if (static_cast<std::uint64_t>(product) < n) {
    const std::uint64_t threshold = (0 - n) % n;
    while (static_cast<std::uint64_t>(product) < threshold) {
      product = static_cast<Wide>(bits()) * n;
    }
  }
  return static_cast<std::uint64_t>(product >> 64);
}

double RandomStream::normal() noexcept {
  // The half step keeps p inside (0, 1).
  return normal_quantile((static_cast<double>(bits() >> 12) + 0.5) * 0x1.0p-52);
}

Vec3 random_direction(RandomStream& random) noexcept {
  const double z = random.uniform(-1.0, 1.0);
  const double phi = 2.0 * std::numbers::pi * random.uniform();
  const double rho = std::sqrt((1.0 - z) * (1.0 + z));
  return normalized(Vec3{rho * std::cos(phi), rho * std::sin(phi), z});
}

Quaternion random_rotation(RandomStream& random) noexcept {
  const double u = random.uniform();
  const double alpha = 2.0 * std::numbers::pi * random.uniform();
  const double beta = 2.0 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(1.0 - u);
  const double s = std::sqrt(u);
  return normalized(
      Quaternion{s * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), s * std::sin(beta)});
}

namespace {

// Acklam's rational approximation, relative error below 1.2e-9: the start of the refinement.
double quantile_start(double p) noexcept {
  constexpr double a[] = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                          1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr double b[] = {-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02,
                          6.680131188771972e+01, -1.328068155288572e+01};
  constexpr double c[] = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                          -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr double d[] = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                          3.754408661907416e+00};
  const auto tail = [&](double q) {
    return (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
           ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1.0);
  };
  constexpr double low = 0.02425;
  if (p < low) return tail(std::sqrt(-2.0 * std::log(p)));
  if (p > 1.0 - low) return -tail(std::sqrt(-2.0 * std::log1p(-p)));
  const double q = p - 0.5;
  const double r = q * q;
  return (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
         (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1.0);
}

}  // namespace

double normal_quantile(double p) noexcept {
  // Work in the lower tail, where erfc keeps its relative accuracy.
  if (p > 0.5) return -normal_quantile(1.0 - p);
  const double x = quantile_start(p);
  const double error = 0.5 * std::erfc(-x / std::numbers::sqrt2) - p;
  const double u = error * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * x * x);
  return x - u / (1.0 + 0.5 * x * u);
}

}  // namespace packstone
