#pragma once

/// @file
/// The point of an ellipsoid's surface (of an ellipse, N = 2) nearest to a given point, inside or
/// outside, in the frame of its axes. Equations (6), (7) of ellipsoid_contact.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace packstone {

template <std::size_t N>
struct FootPoint {
  std::array<double, N> point{};   ///< On the surface [L].
  std::array<double, N> normal{};  ///< Unit outward normal there.
  bool inside = false;             ///< Whether the given point lies inside.
  double distance_bound = 0.0;     ///< Outside: at least the distance. Inside: at most [L].
};

namespace detail {

template <std::size_t N>
double norm(const std::array<double, N>& v) {
  double sum = 0.0;
  for (double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// Equation (6) in units of the least semi-axis e: with sigma = t / e^2 + 1, k = e_i^2 / e^2 - 1
/// and u = |y_i| / e, the left side is |w|^2 with w_i = (e_i / e) u_i / (sigma + k_i). Written with
/// sigma because the root may lie as close to 0 as it likes.
template <std::size_t N>
struct FootEquation {
  std::array<double, N> ratio, excess, u;

  FootEquation(const std::array<double, N>& axes, const std::array<double, N>& y) {
    const double least = *std::min_element(axes.begin(), axes.end());
    for (std::size_t i = 0; i < N; ++i) {
      ratio[i] = axes[i] / least;
      excess[i] = (ratio[i] - 1.0) * (ratio[i] + 1.0);
      u[i] = std::abs(y[i]) / least;
    }
  }

  std::array<double, N> w(double sigma) const {
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; ++i) {
      if (u[i] > 0.0) result[i] = ratio[i] * u[i] / (sigma + excess[i]);
    }
    return result;
  }

  /// No component of y along the least axes, and the other terms do not reach 1 at sigma = 0: then
  /// the root is 0 and the missing part of w goes along a least axis.
  bool is_degenerate() const {
    for (std::size_t i = 0; i < N; ++i) {
      if (excess[i] <= 0.0 && u[i] > 0.0) return false;
    }
    return norm(w(0.0)) <= 1.0;
  }

  /// Newton on 1/|w| - 1, which is concave and increasing: from the left the steps never overshoot.
  double root() const {
    double sigma = 0.0;
    for (std::size_t i = 0; i < N; ++i) sigma = std::max(sigma, ratio[i] * u[i] - excess[i]);
    for (int step = 0; step < 60; ++step) {
      const std::array<double, N> v = w(sigma);
      const double length = norm(v);
      double slope = 0.0;
      for (std::size_t i = 0; i < N; ++i) {
        if (u[i] > 0.0) slope += v[i] * v[i] / (sigma + excess[i]);
      }
      const double next = sigma + (length - 1.0) * length * length / slope;
      if (!(next > sigma)) break;
      sigma = next;
    }
    return sigma;
  }
};

}  // namespace detail

template <std::size_t N>
FootPoint<N> foot_point(const std::array<double, N>& axes, const std::array<double, N>& y) {
  const detail::FootEquation<N> equation(axes, y);
  const bool degenerate = equation.is_degenerate();
  const double sigma = degenerate ? 0.0 : equation.root();
  std::array<double, N> w = equation.w(sigma);
  const std::size_t least =
      static_cast<std::size_t>(std::min_element(axes.begin(), axes.end()) - axes.begin());
  if (degenerate) {
    const double rest = detail::norm(w);
    w[least] = std::sqrt((1.0 - rest) * (1.0 + rest));
  }
  const double length = detail::norm(w);
  FootPoint<N> foot;
  foot.inside = sigma < 1.0;
  double apart_sq = 0.0, dual = -1.0;
  for (std::size_t i = 0; i < N; ++i) {
    const double unit = std::copysign(w[i] / length, y[i]);
    foot.point[i] = axes[i] * unit;
    foot.normal[i] = unit * (axes[least] / axes[i]);
    apart_sq += (y[i] - foot.point[i]) * (y[i] - foot.point[i]);
    if (equation.u[i] > 0.0) {
      dual += equation.u[i] * equation.u[i] / (sigma + equation.excess[i]);
    }
  }
  const double normal_length = detail::norm(foot.normal);
  for (double& n : foot.normal) n /= normal_length;
  // Equation (7); its rounding is a few units of the largest semi-axis, see ellipsoid_contact.md.
  foot.distance_bound = foot.inside ? axes[least] * std::sqrt(std::max(0.0, (sigma - 1.0) * dual))
                                    : std::sqrt(apart_sq);
  return foot;
}

}  // namespace packstone
