#pragma once

/// @file
/// CompensatedSum: a sum whose error does not grow with the number of terms.

#include <cmath>

namespace packstone {

/// Adds up numbers, the rounding error carried along. A. Neumaier, Z. Angew. Math. Mech. 54 (1974)
/// 39-51.
class CompensatedSum {
 public:
  void add(double x) noexcept {
    const double sum = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const noexcept { return sum_ + rest_; }

 private:
  double sum_ = 0.0;
  double rest_ = 0.0;
};

}  // namespace packstone
