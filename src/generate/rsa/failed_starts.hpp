#pragma once

/// @file
/// FailedStarts: is another start worth while?

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace packstone::rsa {

/// Volumes that starts have reached before they failed.
///
/// The volume that RSA reaches scatters little, so a few starts tell how far away an order is.
/// After kEnough of them the order counts as hopeless when it lies more than kDeviations standard
/// deviations above their mean; a deviation is taken as one largest body at least, since few starts
/// of few bodies may agree by chance.
class FailedStarts {
 public:
  /// @param ordered  Volume of all bodies ordered [L^d].
  /// @param largest  Volume of the largest of them [L^d].
  FailedStarts(double ordered, double largest) noexcept : ordered_(ordered), largest_(largest) {}

  /// B. P. Welford, Technometrics 4 (1962) 419-420.
  void add(double reached) noexcept {
    ++count_;
    const double step = reached - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (reached - mean_);
  }

  [[nodiscard]] bool hopeless() const noexcept {
    if (count_ < kEnough) return false;
    const double deviation = std::sqrt(squares_ / static_cast<double>(count_ - 1));
    return ordered_ - mean_ > kDeviations * std::max(deviation, largest_);
  }

 private:
  static constexpr std::int64_t kEnough = 8;
  static constexpr double kDeviations = 12.0;

  double ordered_;
  double largest_;
  std::int64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

}  // namespace packstone::rsa
