#pragma once

/// @file
/// The one-parameter search behind the contact of two ellipsoids or two ellipses.
///
/// A pencil knows the shape matrices A and B and the separation r, and gives for k > 0 a vector
/// n(k) along (A + kB)^-1 r with its derivative. With k = l / (1-l) these are the vectors of
/// equation (1) in ellipsoid_contact.hpp; k is kept in place of l because bodies of very different
/// sizes meet at l next to 0 or 1, where 1-l has no digits left. n may carry any positive factor:
/// everything below is homogeneous in it.

#include <algorithm>
#include <cmath>
#include <limits>

namespace packstone {

/// What one n(k) says: its reach along r, the supports of the bodies, and how both change with k.
struct PencilSample {
  double k = 1.0;          ///< Where [-].
  double reach = 0.0;      ///< n.r
  double support_a = 0.0;  ///< sqrt(n.An)
  double support_b = 0.0;  ///< sqrt(n.Bn)
  double bend_a = 0.0;     ///< An.dn/dk, half the slope of n.An
  double bend_b = 0.0;     ///< Bn.dn/dk, half the slope of n.Bn

  /// n.(A + kB)n; the factor that n carries is energy / reach.
  double energy() const { return support_a * support_a + k * support_b * support_b; }
  /// Does n separate the bodies, rounding aside? Equation (2).
  bool separates() const { return reach > support_a + support_b; }
  /// Do both bodies hold the point A (A + kB)^-1 r, rounding aside? Equation (3).
  bool shares_point() const { return std::max(support_a, k * support_b) * reach < energy(); }

  /// Newton's step on support_a / support_b - k, whose root makes both levels of (3) equal.
  double newton_step() const {
    const double quad_b = support_b * support_b;
    const double bend = bend_a * quad_b - bend_b * support_a * support_a;
    return (support_a - k * support_b) * support_a * quad_b /
           (support_a * support_b * quad_b - bend);
  }
};

/// Evaluates `pencil` at one k after another, each nearer to the k where both levels are equal, and
/// hands every sample to `visit` until that returns true. Newton's step, replaced by bisection of
/// log k where it leaves the interval known to hold the root.
///
/// @return  Whether `visit` was satisfied within the budget.
template <class Pencil, class Visit>
bool search_pencil(const Pencil& pencil, double start, const Visit& visit) {
  constexpr int kBudget = 60;
  constexpr double kResolution = 4e-16;
  double low = 0.0, high = std::numeric_limits<double>::infinity(), k = start;
  for (int step = 0; step < kBudget; ++step) {
    const PencilSample sample = pencil.at(k);
    if (visit(sample)) return true;
    (sample.support_a > k * sample.support_b ? low : high) = k;
    double next = k + sample.newton_step();
    if (!(next > low && next < high)) next = std::clamp(std::sqrt(low * high), 0.1 * k, 10.0 * k);
    if (std::abs(next - k) <= kResolution * k) return false;
    k = next;
  }
  return false;
}

}  // namespace packstone
