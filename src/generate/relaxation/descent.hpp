#pragma once

/// @file
/// The limited-memory method of Broyden, Fletcher, Goldfarb and Shanno: directions of descent.

#include <deque>

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

  void clear() { pairs_.clear(); }
  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// A step and how much the gradient changed on it. Kept only where the curvature is positive.
  void add(Motion step, Motion change);

  /// Minus the inverse Hessian, as far as it is known, times the gradient.
  [[nodiscard]] Motion direction(const Motion& gradient) const;

 private:
  struct Pair {
    Motion step;
    Motion change;
    double inverse_curvature;  // 1 / (step . change)
  };
  std::deque<Pair> pairs_;
  int threads_;
};

}  // namespace packstone::relaxation
