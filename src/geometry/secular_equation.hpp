#pragma once

/// @file
/// The one root that a quadratic function on a sphere or an ellipsoid comes down to.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace packstone {

/// |w(sigma)| = 1 with w_i = numerator_i / (sigma + excess_i), numerators >= 0, excesses >= 0 and
/// the least of them 0. There is one root sigma > 0, or none (`is_degenerate`). The shift to a
/// least excess of 0 is what keeps all digits of a root next to 0.
template <std::size_t N>
struct SecularEquation {
  std::array<double, N> numerator{};
  std::array<double, N> excess{};

  std::array<double, N> w(double sigma) const {
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; ++i) {
      if (numerator[i] > 0.0) result[i] = numerator[i] / (sigma + excess[i]);
    }
    return result;
  }

  static double norm(const std::array<double, N>& v) {
    double sum = 0.0;
    for (double x : v) sum += x * x;
    return std::sqrt(sum);
  }

  /// Nothing where the excess is 0, and the other terms do not reach 1 at sigma = 0: then sigma = 0
  /// and the missing part of w goes along an axis of excess 0.
  bool is_degenerate() const {
    for (std::size_t i = 0; i < N; ++i) {
      if (excess[i] <= 0.0 && numerator[i] > 0.0) return false;
    }
    return norm(w(0.0)) <= 1.0;
  }

  /// Newton on 1/|w| - 1, which is concave and increasing: from the left the steps never overshoot.
  double root() const {
    double sigma = 0.0;
    for (std::size_t i = 0; i < N; ++i) sigma = std::max(sigma, numerator[i] - excess[i]);
    for (int step = 0; step < 60; ++step) {
      const std::array<double, N> v = w(sigma);
      const double length = norm(v);
      double slope = 0.0;
      for (std::size_t i = 0; i < N; ++i) {
        if (numerator[i] > 0.0) slope += v[i] * v[i] / (sigma + excess[i]);
      }
      const double next = sigma + (length - 1.0) * length * length / slope;
      if (!(next > sigma)) break;
      sigma = next;
    }
    return sigma;
  }
};

}  // namespace packstone
