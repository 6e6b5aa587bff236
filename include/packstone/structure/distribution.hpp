#pragma once

/// @file
/// Laws that sizes, aspects and angles follow. Sampling is by inversion: one uniform per value, and
/// one for each choice of a mixture.

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
///
/// In a mixture with Weighting::volume the weights and all parts count volume; in one with
/// Weighting::number the weights count inclusions and each part follows its own `by`.
struct Distribution {
  std::variant<ConstantLaw, UniformLaw, NormalLaw, LognormalLaw, WeibullLaw, TableLaw, MixtureLaw>
      law = ConstantLaw{};
  Weighting by = Weighting::number;
};

/// A log-normal law by its own mean and standard deviation (before truncation). mean, std > 0.
/// Throws InvalidArgument otherwise.
[[nodiscard]] LognormalLaw lognormal_from_moments(double mean, double std, double min = 0.0,
                                                  double max = 1e300);

/// Throws InvalidArgument naming `what`, the parameter, its value and range, when the law is not
/// one: a parameter that is not finite, negative width, min > max, a truncation that leaves no
/// value, weights that are negative or sum to 0. With Weighting::volume the values must moreover be
/// > 0: constants, table values and `lo`, and `min` of a normal or Weibull law. A log-normal law
/// needs no min.
void check_distribution(const Distribution& law, const std::string& what);

/// True for a ConstantLaw.
[[nodiscard]] bool is_constant(const Distribution& law) noexcept;

/// Least and greatest value that draw() can return.
struct Support {
  double min = 0.0;
  double max = 0.0;
};

/// The support of the numbers as drawn: a uniform takes the 2^52 values (k + 1/2) / 2^52, so the
/// range is finite also for laws without bounds. A normal law with mean > 8.13 std, for instance,
/// never gives a value <= 0. `power` as in draw().
[[nodiscard]] Support support_of(const Distribution& law, int power = 3);

/// `count` values: items first, first + 1, ... Item i depends on (seed, stream, group, i) alone.
///
/// By inversion of the distribution function, truncation included: one uniform a value, and one
/// more for each choice of a mixture. Relative error of the distribution function below 1e-9, far
/// tails included.
///
/// With Weighting::volume the values are drawn with density proportional to f(x) / x^power, so that
/// volume follows f. `power` is the power of the value that volume grows with, 1 to 3: 3 for a
/// length in space, 2 for a length in the plane, 1 for a volume or an area. Closed forms:
/// log-normal (mu falls by power sigma^2: J. Aitchison, J. A. C. Brown, The Lognormal Distribution,
/// Cambridge 1957), uniform, constant, table. Normal and Weibull: a table of
/// Gauss-Legendre panels, inverted to rounding.
///
/// Errors:  those of check_distribution().
/// Cost:    10 to 100 ns a value; 2 us for normal and Weibull laws by volume.
[[nodiscard]] std::vector<double> draw(const Distribution& law, std::int64_t count,
                                       std::uint64_t seed, StreamId stream, std::uint64_t group,
                                       int power = 3, std::int64_t first = 0);

}  // namespace packstone
