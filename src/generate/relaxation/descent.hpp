#pragma once

/// @file
/// The limited-memory method of Broyden, Fletcher, Goldfarb and Shanno: directions of descent.

#include <deque>
#include <vector>

#include "generate/relaxation/bodies.hpp"

namespace packstone::relaxation {

/// Sum of products, the same for any number of threads.
[[nodiscard]] double inner_product(const Motion& x, const Motion& y, int threads);

/// y += factor x.
void add_multiple(double factor, const Motion& x, Motion& y, int threads);

/// What the last steps say of the curvature of a function.
///
/// Reference: D. C. Liu, J. Nocedal, Math. Program. 45 (1989) 503-528, algorithm 2.1; the two loops
/// of J. Nocedal, Math. Comput. 35 (1980) 773-782.
class CurvatureMemory {
 public:
  explicit CurvatureMemory(int threads) : threads_(threads) {}

  void clear();
  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// A step of `length` times `direction`, and the gradients before and after it. Kept only where
  /// the curvature is positive.
  void add(double length, const Motion& direction, const Motion& before, const Motion& after);

  /// Sets `d` to minus the inverse Hessian, as far as it is known, times the gradient.
  void find_direction(const Motion& gradient, Motion& d) const;

 private:
  struct Pair {
    Motion step;
    Motion change;
    double inverse_curvature = 0.0;  // 1 / (step . change)
  };
  [[nodiscard]] Pair unused_pair();

  std::deque<Pair> pairs_;
  std::vector<Pair> unused_;  // Fresh memory for large vectors costs as much as their sums.
  int threads_;
};

}  // namespace packstone::relaxation
