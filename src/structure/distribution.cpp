#include "packstone/structure/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/overloaded.hpp"
#include "structure/tabulated_law.hpp"
#include "structure/truncated_normal.hpp"

namespace packstone {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastUniform = 0x1p-53;

// In (0, 1), neither end reached: (k + 1/2) / 2^52.
double open_uniform(RandomStream& random) noexcept {
  return (static_cast<double>(random.bits() >> 12) + 0.5) * 0x1p-52;
}

// --- checks ------------------------------------------------------------------------------------

[[noreturn]] void refuse(const std::string& field, double value, const std::string& allowed) {
  throw InvalidArgument(field + " = " + number_text(value) + ", allowed are " + allowed);
}

void check_finite(const std::string& field, double value) {
  if (!std::isfinite(value)) refuse(field, value, "finite numbers");
}

void check_at_least_zero(const std::string& field, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) refuse(field, value, "finite numbers >= 0");
}

void check_positive(const std::string& field, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) refuse(field, value, "finite numbers > 0");
}

void check_order(const std::string& what, const char* low, double min, const char* high,
                 double max) {
  if (std::isnan(min) || min == kInfinity) refuse(what + "." + low, min, "numbers");
  if (std::isnan(max) || max == -kInfinity) refuse(what + "." + high, max, "numbers");
  if (min <= max) return;
  refuse(what + "." + low, min, std::string("numbers <= ") + high + " = " + number_text(max));
}

// A law of width 0 has one value, which the truncation must leave.
void check_left(const std::string& what, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw InvalidArgument(what + " has the one value " + number_text(value) +
                        ", which lies outside its bounds min = " + number_text(min) +
                        " and max = " + number_text(max));
}

void check_weights(const std::string& what, const std::vector<double>& weights, std::size_t count) {
  if (weights.size() != count || count == 0) {
    throw InvalidArgument(what + " has " + std::to_string(count) + " entries and " +
                          std::to_string(weights.size()) +
                          " weights, allowed are as many weights as entries, and at least one");
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    check_at_least_zero(what + ".weight[" + std::to_string(i) + "]", weights[i]);
    sum += weights[i];
  }
  if (!(sum > 0.0) || !std::isfinite(sum)) refuse(what + ": sum of weights", sum, "numbers > 0");
}

void check_by_volume(const std::string& field, double value) {
  if (value > 0.0) return;
  refuse(field, value, "numbers > 0 when the law counts volume (by = \"volume\")");
}

void check_law(const Distribution& law, Weighting by, const std::string& what);

struct LawCheck {
  const std::string& what;
  Weighting by;

  [[nodiscard]] bool by_volume() const { return by == Weighting::volume; }

  void operator()(const ConstantLaw& law) const {
    check_finite(what, law.value);
    if (by_volume()) check_by_volume(what, law.value);
  }
  void operator()(const UniformLaw& law) const {
    check_finite(what + ".uniform[0]", law.lo);
    check_finite(what + ".uniform[1]", law.hi);
    if (law.lo > law.hi) {
      refuse(what + ".uniform[0]", law.lo, "numbers <= uniform[1] = " + number_text(law.hi));
    }
    if (by_volume()) check_by_volume(what + ".uniform[0]", law.lo);
  }
  void operator()(const NormalLaw& law) const {
    check_finite(what + ".mean", law.mean);
    check_at_least_zero(what + ".std", law.std);
    check_order(what, "min", law.min, "max", law.max);
    if (law.std == 0.0) check_left(what, law.mean, law.min, law.max);
    if (by_volume()) check_by_volume(what + ".min", law.std == 0.0 ? law.mean : law.min);
  }
  void operator()(const LognormalLaw& law) const {
    check_finite(what + ".mu", law.mu);
    check_at_least_zero(what + ".sigma", law.sigma);
    check_order(what, "min", law.min, "max", law.max);
    check_positive(what + ".max", std::min(law.max, std::numeric_limits<double>::max()));
    if (law.sigma == 0.0) check_left(what, std::exp(law.mu), law.min, law.max);
  }
  void operator()(const WeibullLaw& law) const {
    check_positive(what + ".shape", law.shape);
    check_positive(what + ".scale", law.scale);
    check_order(what, "min", law.min, "max", law.max);
    check_positive(what + ".max", std::min(law.max, std::numeric_limits<double>::max()));
    if (by_volume()) check_by_volume(what + ".min", law.min);
  }
  void operator()(const TableLaw& law) const {
    check_weights(what + ".table", law.weights, law.values.size());
    for (std::size_t i = 0; i < law.values.size(); ++i) {
      const std::string field = what + ".table.value[" + std::to_string(i) + "]";
      check_finite(field, law.values[i]);
      if (by_volume()) check_by_volume(field, law.values[i]);
    }
  }
  void operator()(const MixtureLaw& law) const {
    check_weights(what + ".mixture", law.weights, law.parts.size());
    for (std::size_t i = 0; i < law.parts.size(); ++i) {
      const Weighting part = by_volume() ? by : law.parts[i].by;
      check_law(law.parts[i], part, what + ".mixture[" + std::to_string(i) + "]");
    }
  }
};

void check_law(const Distribution& law, Weighting by, const std::string& what) {
  std::visit(LawCheck{what, by}, law.law);
}

// --- inversion ---------------------------------------------------------------------------------

using Quantile = std::function<double(double)>;

// One law made ready: how it inverts, and log E[x^-power] of the law itself, which turns its share
// of the volume into its share of the number.
struct Inverse {
  Quantile quantile;
  double log_number_per_volume = 0.0;
};

Inverse constant_inverse(double value, int power) {
  return {[value](double) { return value; }, -power * std::log(value)};
}

Inverse uniform_inverse(const UniformLaw& law) {
  return {[law](double u) { return std::clamp(law.lo + (law.hi - law.lo) * u, law.lo, law.hi); }};
}

// Density proportional to x^-p on [lo, hi].
Inverse uniform_by_volume(const UniformLaw& law, int p) {
  const double lo = law.lo;
  const double log_ratio = std::log(law.hi / lo);
  const double q = p - 1;
  const auto quantile = [=](double u) {
    const double x = p == 1 ? lo * std::exp(u * log_ratio)
                            : lo * std::exp(-std::log1p(u * std::expm1(-q * log_ratio)) / q);
    return std::clamp(x, law.lo, law.hi);
  };
  const double area = p == 1 ? log_ratio : -std::pow(lo, -q) * std::expm1(-q * log_ratio) / q;
  return {quantile, std::log(area / (law.hi - lo))};
}

struct Bounds {
  double lo, hi;
};

Bounds standard_bounds(double mean, double std, double min, double max) {
  return {(min - mean) / std, (max - mean) / std};
}

Inverse normal_inverse(const NormalLaw& law) {
  const auto [lo, hi] = standard_bounds(law.mean, law.std, law.min, law.max);
  return {[law, z = TruncatedNormal(lo, hi)](double u) {
    return std::clamp(law.mean + law.std * z.quantile(u), law.min, law.max);
  }};
}

// f(x) / x^p of a log-normal law is log-normal with mu - p sigma^2, and
// E[x^-p] = exp(-p mu + p^2 sigma^2 / 2) P'(min < x < max) / P(min < x < max).
Inverse lognormal_inverse(const LognormalLaw& law, int p) {
  const double log_min = law.min > 0.0 ? std::log(law.min) : -kInfinity;
  const double log_max = std::log(law.max);
  const double mu = law.mu - p * law.sigma * law.sigma;
  const auto [lo, hi] = standard_bounds(mu, law.sigma, log_min, log_max);
  const TruncatedNormal z(lo, hi);
  const auto quantile = [law, mu, z](double u) {
    return std::clamp(std::exp(mu + law.sigma * z.quantile(u)), law.min, law.max);
  };
  if (p == 0) return {quantile};
  const auto [number_lo, number_hi] = standard_bounds(law.mu, law.sigma, log_min, log_max);
  return {quantile, -p * law.mu + 0.5 * p * p * law.sigma * law.sigma + z.log_mass() -
                        TruncatedNormal(number_lo, number_hi).log_mass()};
}

// The exponent t = (x / scale)^shape is exponential: P(t > s) = exp(-s).
struct WeibullExponent {
  double lo, log_survival;  // t at min; log P(t > t_max | t > t_min)

  explicit WeibullExponent(const WeibullLaw& law)
      : lo(std::pow(std::max(law.min, 0.0) / law.scale, law.shape)),
        log_survival(lo - std::pow(law.max / law.scale, law.shape)) {}

  [[nodiscard]] double quantile(double u) const {
    return lo - std::log1p(u * std::expm1(log_survival));
  }
};

Inverse weibull_inverse(const WeibullLaw& law) {
  return {[law, t = WeibullExponent(law)](double u) {
    return std::clamp(law.scale * std::pow(t.quantile(u), 1.0 / law.shape), law.min, law.max);
  }};
}

// Quantiles of the law by number resolve f wherever it lives; the panels' own grading resolves
// x^-power.
std::vector<double> breaks_of(const Quantile& by_number, double min, double max) {
  std::vector<double> breaks{min};
  for (int k = 52; k >= 1; --k) breaks.push_back(by_number(std::ldexp(1.0, -k)));
  for (int k = 2; k <= 53; ++k) breaks.push_back(by_number(1.0 - std::ldexp(1.0, -k)));
  if (max < 2.0 * breaks.back()) breaks.push_back(max);
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

Inverse tabulated_inverse(const std::function<double(double)>& log_density, int power,
                          const std::vector<double>& breaks) {
  if (!(breaks.front() < breaks.back())) return constant_inverse(breaks.front(), power);
  const auto table = std::make_shared<const TabulatedLaw>(
      [=](double x) { return log_density(x) - power * std::log(x); }, breaks);
  return {[table](double u) { return table->quantile(u); }, table->log_integral()};
}

Inverse normal_by_volume(const NormalLaw& law, int power) {
  const auto [lo, hi] = standard_bounds(law.mean, law.std, law.min, law.max);
  const double log_norm =
      TruncatedNormal(lo, hi).log_mass() + std::log(law.std * std::sqrt(2.0 * std::acos(-1.0)));
  const auto log_density = [law, log_norm](double x) {
    const double z = (x - law.mean) / law.std;
    return -0.5 * z * z - log_norm;
  };
  return tabulated_inverse(log_density, power,
                           breaks_of(normal_inverse(law).quantile, law.min, law.max));
}

Inverse weibull_by_volume(const WeibullLaw& law, int power) {
  const WeibullExponent t(law);
  const double log_norm = std::log(-std::expm1(t.log_survival)) + std::log(law.scale / law.shape);
  const auto log_density = [law, t, log_norm](double x) {
    const double y = x / law.scale;
    return t.lo - std::pow(y, law.shape) + (law.shape - 1.0) * std::log(y) - log_norm;
  };
  return tabulated_inverse(log_density, power,
                           breaks_of(weibull_inverse(law).quantile, law.min, law.max));
}

// Weights as a running sum that ends in exactly 1.
std::vector<double> cumulative(const std::vector<double>& weights) {
  std::vector<double> sums;
  sums.reserve(weights.size());
  double sum = 0.0;
  for (double w : weights) sums.push_back(sum += w);
  for (double& s : sums) s /= sum;
  return sums;
}

std::size_t chosen(const std::vector<double>& sums, double u) {
  const auto place = std::upper_bound(sums.begin(), sums.end(), u) - sums.begin();
  return static_cast<std::size_t>(place);
}

// Shares of the number from shares of the volume; `log_factor` [i] is log E_i[x^-power].
std::vector<double> number_weights(const std::vector<double>& weights,
                                   const std::vector<double>& log_factor) {
  const double scale = *std::max_element(log_factor.begin(), log_factor.end());
  std::vector<double> result;
  result.reserve(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    result.push_back(weights[i] * std::exp(log_factor[i] - scale));
  }
  return result;
}

double log_mean_exp(const std::vector<double>& weights, const std::vector<double>& log_factor) {
  const double scale = *std::max_element(log_factor.begin(), log_factor.end());
  double sum = 0.0, total = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * std::exp(log_factor[i] - scale);
    total += weights[i];
  }
  return scale + std::log(sum / total);
}

Inverse table_inverse(const TableLaw& law, int power) {
  std::vector<double> log_factor(law.values.size(), 0.0);
  for (std::size_t i = 0; power > 0 && i < law.values.size(); ++i) {
    log_factor[i] = -power * std::log(law.values[i]);
  }
  return {[values = law.values, sums = cumulative(number_weights(law.weights, log_factor))](
              double u) { return values[chosen(sums, u)]; },
          log_mean_exp(law.weights, log_factor)};
}

// The inverse of a law without choices; `power` is 0 where the law counts inclusions.
struct LawInverse {
  int power;

  Inverse operator()(const ConstantLaw& law) const { return constant_inverse(law.value, power); }
  Inverse operator()(const UniformLaw& law) const {
    if (law.lo == law.hi) return constant_inverse(law.lo, power);
    return power == 0 ? uniform_inverse(law) : uniform_by_volume(law, power);
  }
  Inverse operator()(const NormalLaw& law) const {
    if (law.std == 0.0) return constant_inverse(law.mean, power);
    if (law.min == law.max) return constant_inverse(law.min, power);
    return power == 0 ? normal_inverse(law) : normal_by_volume(law, power);
  }
  Inverse operator()(const LognormalLaw& law) const {
    if (law.sigma == 0.0) return constant_inverse(std::exp(law.mu), power);
    if (law.min == law.max) return constant_inverse(law.min, power);
    return lognormal_inverse(law, power);
  }
  Inverse operator()(const WeibullLaw& law) const {
    if (law.min == law.max) return constant_inverse(law.min, power);
    return power == 0 ? weibull_inverse(law) : weibull_by_volume(law, power);
  }
  Inverse operator()(const TableLaw& law) const { return table_inverse(law, power); }
  Inverse operator()(const MixtureLaw&) const { return {}; }
};

// A law made ready, with its choices: a leaf has no parts.
class Sampler {
 public:
  Sampler(const Distribution& law, Weighting by, int power) {
    const int weight_power = by == Weighting::volume ? power : 0;
    const auto* mixture = std::get_if<MixtureLaw>(&law.law);
    if (mixture == nullptr) {
      leaf_ = std::visit(LawInverse{weight_power}, law.law);
      return;
    }
    std::vector<double> weights, log_factor;
    for (std::size_t i = 0; i < mixture->parts.size(); ++i) {
      if (mixture->weights[i] == 0.0) continue;
      const Distribution& part = mixture->parts[i];
      parts_.emplace_back(part, by == Weighting::volume ? by : part.by, power);
      weights.push_back(mixture->weights[i]);
      log_factor.push_back(weight_power == 0 ? 0.0 : parts_.back().leaf_.log_number_per_volume);
    }
    sums_ = cumulative(number_weights(weights, log_factor));
    leaf_.log_number_per_volume = log_mean_exp(weights, log_factor);
  }

  [[nodiscard]] double draw(RandomStream& random) const {
    const double u = open_uniform(random);
    return parts_.empty() ? leaf_.quantile(u) : parts_[chosen(sums_, u)].draw(random);
  }

  [[nodiscard]] Support support() const {
    if (parts_.empty()) return {leaf_.quantile(kLeastUniform), leaf_.quantile(1.0 - kLeastUniform)};
    Support all{kInfinity, -kInfinity};
    for (const Sampler& part : parts_) {
      const Support one = part.support();
      all = {std::min(all.min, one.min), std::max(all.max, one.max)};
    }
    return all;
  }

 private:
  Inverse leaf_;
  std::vector<Sampler> parts_;
  std::vector<double> sums_;
};

Support table_support(const TableLaw& law) {
  Support all{kInfinity, -kInfinity};
  for (std::size_t i = 0; i < law.values.size(); ++i) {
    if (law.weights[i] == 0.0) continue;
    all = {std::min(all.min, law.values[i]), std::max(all.max, law.values[i])};
  }
  return all;
}

}  // namespace

LognormalLaw lognormal_from_moments(double mean, double std, double min, double max) {
  check_positive("lognormal.mean", mean);
  check_positive("lognormal.std", std);
  const double sigma_sq = std::log1p((std / mean) * (std / mean));
  return {std::log(mean) - 0.5 * sigma_sq, std::sqrt(sigma_sq), min, max};
}

void check_distribution(const Distribution& law, const std::string& what) {
  check_law(law, law.by, what);
}

bool is_constant(const Distribution& law) noexcept {
  return std::holds_alternative<ConstantLaw>(law.law);
}

Support support_of(const Distribution& law, int power) {
  check_distribution(law, "distribution");
  if (const auto* table = std::get_if<TableLaw>(&law.law)) return table_support(*table);
  return Sampler(law, law.by, power).support();
}

std::vector<double> draw(const Distribution& law, std::int64_t count, std::uint64_t seed,
                         StreamId stream, std::uint64_t group, int power, std::int64_t first) {
  PACKSTONE_ASSERT(count >= 0 && power >= 1 && power <= 3);
  check_distribution(law, "distribution");
  const Sampler sampler(law, law.by, power);
  std::vector<double> values(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    RandomStream random(seed, stream, static_cast<std::uint64_t>(first + i), group);
    values[static_cast<std::size_t>(i)] = sampler.draw(random);
  }
  return values;
}

}  // namespace packstone
