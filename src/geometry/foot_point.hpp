#pragma once

/// @file
/// The point of an ellipsoid's surface (of an ellipse, N = 2) nearest to a given point, inside or
/// outside, in the frame of its axes. Equations (6), (7) of ellipsoid_contact.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/secular_equation.hpp"

namespace packstone {

template <std::size_t N>
struct FootPoint {
  std::array<double, N> point{};   ///< On the surface [L].
  std::array<double, N> normal{};  ///< Unit outward normal there.
  bool inside = false;             ///< Whether the given point lies inside.
  double distance_bound = 0.0;     ///< Outside: at least the distance. Inside: at most [L].
};

/// Equation (6) in units of the least semi-axis e: with sigma = t / e^2 + 1 and u = |y_i| / e, the
/// left side is |w|^2 with w_i = (e_i / e) u_i / (sigma + e_i^2 / e^2 - 1).
template <std::size_t N>
SecularEquation<N> foot_equation(const std::array<double, N>& axes, const std::array<double, N>& y,
                                 double least) {
  SecularEquation<N> equation;
  for (std::size_t i = 0; i < N; ++i) {
    const double ratio = axes[i] / least;
    equation.excess[i] = (ratio - 1.0) * (ratio + 1.0);
    equation.numerator[i] = ratio * (std::abs(y[i]) / least);
  }
  return equation;
}

template <std::size_t N>
FootPoint<N> foot_point(const std::array<double, N>& axes, const std::array<double, N>& y) {
  const std::size_t least =
      static_cast<std::size_t>(std::min_element(axes.begin(), axes.end()) - axes.begin());
  const SecularEquation<N> equation = foot_equation(axes, y, axes[least]);
  const bool degenerate = equation.is_degenerate();
  const double sigma = degenerate ? 0.0 : equation.root();
  std::array<double, N> w = equation.w(sigma);
  if (degenerate) {
    const double rest = equation.norm(w);
    w[least] = std::sqrt((1.0 - rest) * (1.0 + rest));
  }
  const double length = equation.norm(w);
  FootPoint<N> foot;
  foot.inside = sigma < 1.0;
  double apart_sq = 0.0, dual = -1.0;
  for (std::size_t i = 0; i < N; ++i) {
    const double unit = std::copysign(w[i] / length, y[i]);
    foot.point[i] = axes[i] * unit;
    foot.normal[i] = unit * (axes[least] / axes[i]);
    apart_sq += (y[i] - foot.point[i]) * (y[i] - foot.point[i]);
    const double u = std::abs(y[i]) / axes[least];
    if (u > 0.0) dual += u * u / (sigma + equation.excess[i]);
  }
  const double normal_length = equation.norm(foot.normal);
  for (double& n : foot.normal) n /= normal_length;
  // Equation (7); its rounding is a few units of the largest semi-axis, see ellipsoid_contact.md.
  foot.distance_bound = foot.inside ? axes[least] * std::sqrt(std::max(0.0, (sigma - 1.0) * dual))
                                    : std::sqrt(apart_sq);
  return foot;
}

}  // namespace packstone
