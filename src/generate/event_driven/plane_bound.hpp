#pragma once

/// @file
/// How long a moving plane keeps two moving bodies apart, for certain.
///
/// Bodies a and b with separation r(t) = r + v t, angular velocities w, size factor s(t) = s + g t,
/// and a plane with normal n(t) = n + m t, not unit. Seen from a turning body the normal is
///
///     d(t) = n + k t + e(t),   k = m + n x w,   |e| <= E2 t^2 + E3 t^3                      (1)
///     E2 = |w| |n x w| / 2 + |w| |m|,   E3 = |m| |w|^2 / 2
///
/// by Taylor's formula. A support function that is |M d|, or a sum of such terms, is then at most
///
///     s(t) |M d(t)| <= |s M n + t (s M k + g M n)| + C2 t^2 + C3 t^3 + C4 t^4               (2)
///     C2 = R (g |k| + s E2),   C3 = R (g E2 + s E3),   C4 = R g E3
///
/// with R the circumscribed radius; a ball has |n(t)| <= |n| + |m|^2 t^2 / (2 |n|), for m across n,
/// in place of it. Each square root is the length of a vector that is affine in t, hence convex, so
///
///     G(t) = n(t).r(t) - sum of (2) over both bodies,   n(t).r(t) >= n.r + (n.v + m.r) t
///                                                                 + min(0, m.v) t^2         (3)
///
/// is concave and never above |n(t)| times the gap: G > 0 at both ends of an interval proves that
/// the bodies are apart all through it. Touching smooth bodies have the exact rate of their gap as
/// G'(0), for any m; where a plane rests on an edge or a flat side, m has to follow that side.

#include <algorithm>
#include <array>
#include <cmath>

#include "generate/event_driven/bodies.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// A time in (0, horizon), as late as a few steps find it, up to which a concave bound stays above
/// `aim` for certain; given that it does at 0 and does not at the horizon.
template <class Bound>
double safe_time(const Bound& bound, double horizon, double aim) {
  constexpr int kMostRounds = 30;
  constexpr double kClose = 0.95, kSmall = 1e-3, kShorter = 100.0;
  double short_of = 1e-6;
  const double start = bound.at(0.0) - aim;
  // A tangent lies above: its zero is on the far side. The chord lies below: its zero is on the
  // safe side.
  const double rate = bound.slope(0.0);
  double right = rate < 0.0 ? std::min(horizon, -start / rate) : horizon;
  double at_right = bound.at(right) - aim;
  if (at_right >= 0.0) return right;
  double left = 0.0, at_left = start;
  for (int round = 0; round < kMostRounds; ++round) {
    // A little short of it where rounding would take it to the end itself, as for straight bounds;
    // more so if that was not enough.
    const double part = std::min(at_left / (at_left - at_right), 1.0 - short_of);
    short_of = std::min(0.5, kShorter * short_of);
    const double chord = left + (right - left) * part;
    if (chord >= kClose * right) return chord;
    const double value = bound.at(chord) - aim;
    if (value < 0.0) {
      right = chord;
      at_right = value;
      continue;
    }
    left = chord;
    at_left = value;
    if (left >= kClose * right || at_left < kSmall * start) break;
    const double slope = bound.slope(right);
    const double tangent = slope < 0.0 ? right - at_right / slope : right;
    if (!(tangent > left && tangent < right)) continue;
    right = tangent;
    at_right = bound.at(right) - aim;
    if (at_right >= 0.0) return right;
  }
  return left;
}

/// n(t) = normal + rate t; rate across normal.
struct MovingPlane {
  Vec3 normal;
  Vec3 rate;
};

/// G of equation (3), as a polynomial less square roots of quadratics.
class PlaneBound {
 public:
  /// Of the separation alone: n(t).r(t) less min_gap |n(t)|.
  PlaneBound(const MovingPlane& plane, const Vec3& r, const Vec3& v, double min_gap);

  /// A body that is apart from the plane on either side. `size` and `growth` are s and g.
  void add_body(Form form, const Spin& spin, const Pose& pose, double semi_second, double reach,
                double size, double growth);

  /// Adds to G what is known otherwise.
  void raise(double by) { polynomial_[0] += by; }

  [[nodiscard]] double at(double t) const {
    double value =
        polynomial_[0] +
        t * (polynomial_[1] + t * (polynomial_[2] + t * (polynomial_[3] + t * polynomial_[4])));
    for (int k = 0; k < roots_; ++k) value -= root_[static_cast<std::size_t>(k)].at(t);
    return value;
  }
  [[nodiscard]] double slope(double t) const {
    double value = polynomial_[1] + t * (2.0 * polynomial_[2] +
                                         t * (3.0 * polynomial_[3] + t * (4.0 * polynomial_[4])));
    for (int k = 0; k < roots_; ++k) value -= root_[static_cast<std::size_t>(k)].slope(t);
    return value;
  }

  [[nodiscard]] double now() const { return at(0.0); }
  /// Of the normal.
  [[nodiscard]] double length() const { return normal_length_; }

 private:
  // sqrt(a0 + 2 a1 t + a2 t^2), the length of an affine vector.
  struct Root {
    double a0, a1, a2;
    [[nodiscard]] double at(double t) const {
      return std::sqrt(std::max(0.0, a0 + t * (2.0 * a1 + t * a2)));
    }
    // To the right, where the length is 0.
    [[nodiscard]] double slope(double t) const {
      const double length = at(t);
      return length > 0.0 ? (a1 + t * a2) / length : std::sqrt(a2);
    }
  };

  void add_root(double nn, double nk, double kk, double size, double growth);

  Vec3 normal_, rate_;
  double normal_length_, rate_length_;
  std::array<double, 5> polynomial_{};
  std::array<Root, 4> root_{};
  int roots_ = 0;
};

inline PlaneBound::PlaneBound(const MovingPlane& plane, const Vec3& r, const Vec3& v,
                              double min_gap)
    : normal_(plane.normal),
      rate_(plane.rate),
      normal_length_(norm(plane.normal)),
      rate_length_(norm(plane.rate)) {
  polynomial_[0] = dot(normal_, r) - min_gap * normal_length_;
  polynomial_[1] = dot(normal_, v) + dot(rate_, r);
  polynomial_[2] =
      std::min(0.0, dot(rate_, v)) - min_gap * rate_length_ * rate_length_ / (2.0 * normal_length_);
}

inline void PlaneBound::add_root(double nn, double nk, double kk, double size, double growth) {
  root_[static_cast<std::size_t>(roots_++)] = {
      size * size * nn, size * (size * nk + growth * nn),
      size * size * kk + 2.0 * size * growth * nk + growth * growth * nn};
}

inline void PlaneBound::add_body(Form form, const Spin& spin, const Pose& pose, double semi_second,
                                 double reach, double size, double growth) {
  const auto add_ball = [&](double radius) {
    const double bend = rate_length_ * rate_length_ / (2.0 * normal_length_);
    polynomial_[0] -= radius * size * normal_length_;
    polynomial_[1] -= radius * growth * normal_length_;
    polynomial_[2] -= radius * size * bend;
    polynomial_[3] -= radius * growth * bend;
  };
  if (form == Form::ball) return add_ball(spin.lateral);

  const Vec3 across = cross(normal_, spin.angular);
  const Vec3 k = rate_ + across;
  const double turn = norm(spin.angular);
  const double second = turn * (0.5 * norm(across) + rate_length_);
  const double third = 0.5 * rate_length_ * turn * turn;
  polynomial_[2] -= reach * (growth * norm(k) + size * second);
  polynomial_[3] -= reach * (growth * second + size * third);
  polynomial_[4] -= reach * growth * third;

  const double n_axial = dot(normal_, pose.axis), k_axial = dot(k, pose.axis);
  const Vec3 n_flat = normal_ - n_axial * pose.axis, k_flat = k - k_axial * pose.axis;
  const double axial_sq = spin.axial * spin.axial, lateral_sq = spin.lateral * spin.lateral;
  const auto along = [&](double n_part, double k_part, double semi_sq) {
    return std::array<double, 3>{semi_sq * n_part * n_part, semi_sq * n_part * k_part,
                                 semi_sq * k_part * k_part};
  };
  const std::array<double, 3> flat{norm_sq(n_flat), dot(n_flat, k_flat), norm_sq(k_flat)};
  std::array<double, 3> q = along(n_axial, k_axial, axial_sq);
  switch (form) {
    case Form::ball:
      break;
    case Form::spheroid:
      add_root(q[0] + lateral_sq * flat[0], q[1] + lateral_sq * flat[1],
               q[2] + lateral_sq * flat[2], size, growth);
      break;
    case Form::scalene: {
      const Vec3 last = cross(pose.axis, pose.second);
      const auto b =
          along(dot(normal_, pose.second), dot(k, pose.second), semi_second * semi_second);
      const auto c = along(dot(normal_, last), dot(k, last), lateral_sq);
      add_root(q[0] + b[0] + c[0], q[1] + b[1] + c[1], q[2] + b[2] + c[2], size, growth);
      break;
    }
    case Form::cylinder:
      add_root(q[0], q[1], q[2], size, growth);
      add_root(lateral_sq * flat[0], lateral_sq * flat[1], lateral_sq * flat[2], size, growth);
      break;
    case Form::spherocylinder:
      add_root(q[0], q[1], q[2], size, growth);
      add_ball(spin.lateral);
      break;
  }
}

}  // namespace packstone::event_driven
