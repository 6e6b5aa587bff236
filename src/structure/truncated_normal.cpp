#include "structure/truncated_normal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "packstone/core/random.hpp"

namespace packstone {
namespace {

constexpr double kNarrow = 1e-4;
constexpr double kTail = 5.0;

double lower_tail(double x) noexcept { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double log_density(double x) noexcept {
  return -0.5 * x * x - 0.5 * std::log(2.0 * std::numbers::pi);
}

}  // namespace

double mills_ratio(double x) noexcept {
  // R = 1/(x + 1/(x + 2/(x + 3/...))); at x = 5 the 30th convergent errs by exp(-10 sqrt(60)).
  double tail = x;
  for (int k = 30; k >= 1; --k) tail = x + k / tail;
  return 1.0 / tail;
}

TruncatedNormal::TruncatedNormal(double lo, double hi) noexcept : lo_(lo), hi_(hi) {
  const bool narrow = hi - lo < kNarrow;
  // The far end of a tail or of a narrow interval is to lie above, that of a lower tail below.
  flipped_ = narrow ? lo + hi < 0.0 : hi < -kTail || (lo > 0.0 && lo <= kTail);
  if (flipped_) {
    lo_ = -hi;
    hi_ = -lo;
  }
  if (narrow) {
    way_ = Way::narrow;
    return;
  }
  if (lo_ > kTail) {
    way_ = Way::tail;
    log_survival_ = -0.5 * (hi_ - lo_) * (hi_ + lo_);
    if (std::isfinite(log_survival_))
      log_survival_ += std::log(mills_ratio(hi_) / mills_ratio(lo_));
    return;
  }
  way_ = Way::body;
  below_ = lower_tail(lo_);
  above_ = lower_tail(-hi_);
}

double TruncatedNormal::tail_quantile(double u) const noexcept {
  // Solve t (t + 2 lo) / 2 - log(R(lo + t) / R(lo)) = -log S, S = 1 - u (1 - Q(hi) / Q(lo)).
  const double wanted = -std::log1p(u * std::expm1(log_survival_));
  const double ratio_at_lo = mills_ratio(lo_);
  double t = 2.0 * wanted / (lo_ + std::sqrt(lo_ * lo_ + 2.0 * wanted));
  for (int i = 0; i < 20; ++i) {
    const double ratio = mills_ratio(lo_ + t);
    const double excess = 0.5 * t * (t + 2.0 * lo_) - std::log(ratio / ratio_at_lo) - wanted;
    const double step = excess * ratio;
    t = std::max(0.0, t - step);
    if (std::abs(step) <= 1e-15 * t) break;
  }
  return lo_ + t;
}

double TruncatedNormal::quantile(double u) const noexcept {
  const double v = flipped_ ? 1.0 - u : u;
  double x = 0.0;
  switch (way_) {
    case Way::narrow: {
      const double width = hi_ - lo_;
      const double slope = 0.5 * (lo_ + hi_) * width;
      x = lo_ + width * (slope < 1e-8 ? v * (1.0 - 0.5 * slope * (1.0 - v))
                                      : -std::log1p(v * std::expm1(-slope)) / slope);
      break;
    }
    case Way::tail:
      x = tail_quantile(v);
      break;
    case Way::body: {
      const double mass = 1.0 - below_ - above_;
      // The interval may lie wholly in the lower tail, where 1 - below - above cancels.
      const double inside = hi_ <= 0.0 ? lower_tail(hi_) - below_ : mass;
      const double p = below_ + v * inside;
      x = p <= 0.5 ? normal_quantile(p) : -normal_quantile(above_ + (1.0 - v) * inside);
      break;
    }
  }
  x = std::clamp(x, lo_, hi_);
  return flipped_ ? -x : x;
}

double TruncatedNormal::log_mass() const noexcept {
  switch (way_) {
    case Way::narrow: {
      const double middle = 0.5 * (lo_ + hi_);
      const double slope = 0.5 * middle * (hi_ - lo_);
      // log(sinh(slope) / slope)
      const double growth =
          slope < 1e-8 ? 0.0 : slope + std::log(-std::expm1(-2.0 * slope) / (2.0 * slope));
      return log_density(middle) + std::log(hi_ - lo_) + growth;
    }
    case Way::tail:
      return log_density(lo_) + std::log(mills_ratio(lo_)) + std::log(-std::expm1(log_survival_));
    case Way::body:
      break;
  }
  return std::log(hi_ <= 0.0 ? lower_tail(hi_) - below_ : 1.0 - below_ - above_);
}

}  // namespace packstone
