#pragma once

/// @file
/// A law known by its density alone, integrated once over panels and inverted on demand.

#include <functional>
#include <vector>

namespace packstone {

/// The law on [breaks.front(), breaks.back()] with density proportional to exp(log_density(x)).
///
/// Panels start from `breaks` (ascending, > 0, at least two different), are cut until the greater
/// end is at most twice the smaller, and halved until 15-point Gauss-Legendre on a panel and on its
/// halves agree to 1e-13 of the whole.
class TabulatedLaw {
 public:
  TabulatedLaw(std::function<double(double)> log_density, const std::vector<double>& breaks);

  /// x with P(X < x) = u, 0 < u < 1. Cost: some 5 panel integrals.
  [[nodiscard]] double quantile(double u) const;

  /// log of the integral of exp(log_density).
  [[nodiscard]] double log_integral() const;

 private:
  [[nodiscard]] double density(double x) const;
  [[nodiscard]] double integral(double lo, double hi) const;
  void add_panel(double lo, double hi, double value, double tolerance, int depth);

  std::function<double(double)> log_density_;
  double log_scale_ = 0.0;          // densities are stored divided by exp of this
  std::vector<double> edges_;       // panel i is [edges_[i], edges_[i + 1]]
  std::vector<double> cumulative_;  // integral up to edges_[i]
};

}  // namespace packstone
