#pragma once

/// @file
/// Laws that sizes, aspects and angles follow. Sampling is by inversion: one uniform per value.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "packstone/core/random.hpp"

namespace packstone {

/// Always `value`.
struct ConstantLaw {
  double value = 1.0;
};

/// Uniform in [lo, hi]. lo <= hi.
struct UniformLaw {
  double lo = 0.0;
  double hi = 1.0;
};

/// Normal with `mean` and `std` before truncation to [min, max]. std >= 0.
struct NormalLaw {
  double mean = 1.0;
  double std = 0.1;
  double min = -1e300;
  double max = 1e300;
};

/// exp of a normal with `mu` and `sigma`, truncated to [min, max]. sigma >= 0.
struct LognormalLaw {
  double mu = 0.0;
  double sigma = 0.5;
  double min = 0.0;
  double max = 1e300;
};

/// P(X > x) = exp(-(x / scale)^shape), truncated to [min, max]. shape, scale > 0.
struct WeibullLaw {
  double shape = 2.0;
  double scale = 1.0;
  double min = 0.0;
  double max = 1e300;
};

/// One of `values` [i], with probability proportional to `weights` [i] >= 0.
struct TableLaw {
  std::vector<double> values;
  std::vector<double> weights;
};

struct Distribution;

/// One of several laws, chosen with probability proportional to `weights` [i] >= 0.
struct MixtureLaw {
  std::vector<Distribution> parts;
  std::vector<double> weights;
};

/// What the law counts: inclusions, or the volume they take.
enum class Weighting { number, volume };

/// A law and what it counts.
struct Distribution {
  std::variant<ConstantLaw, UniformLaw, NormalLaw, LognormalLaw, WeibullLaw, TableLaw, MixtureLaw>
      law = ConstantLaw{};
  Weighting by = Weighting::number;
};

/// A log-normal law by its own mean and standard deviation (before truncation). mean, std > 0.
[[nodiscard]] LognormalLaw lognormal_from_moments(double mean, double std, double min = 0.0,
                                                  double max = 1e300);

/// Throws InvalidArgument naming `what`, the parameter, its value and range, when the law is not
/// one (negative width, min > max, empty support, weights that sum to 0).
void check_distribution(const Distribution& law, const std::string& what);

/// True for a ConstantLaw.
[[nodiscard]] bool is_constant(const Distribution& law) noexcept;

/// Least and greatest value the law can give.
struct Support {
  double min = 0.0;
  double max = 0.0;
};
[[nodiscard]] Support support_of(const Distribution& law);

/// `count` values. Value i depends on (seed, stream, i) alone. With Weighting::volume the values
/// are drawn with density proportional to f(x) / x^dimension, so that volume follows f; the support
/// must then be bounded away from 0.
[[nodiscard]] std::vector<double> draw(const Distribution& law, std::int64_t count,
                                       std::uint64_t seed, StreamId stream, std::uint64_t group,
                                       int dimension = 3);

}  // namespace packstone
