#pragma once

/// @file
/// The bound of plane_bound.hpp for two bodies of revolution and a plane that does not turn: the
/// same numbers with less around them, since most searches spend their time here.

#include <algorithm>
#include <cmath>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/plane_bound.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// G of equation (3) of plane_bound.hpp.
class RevolutionBound {
 public:
  RevolutionBound(const Vec3& normal, const Vec3& r, const Vec3& v)
      : normal_(normal), c0_(dot(normal, r)), c1_(dot(normal, v)) {}

  /// The first and the second body.
  void set_a(const Spin& spin, const Vec3& axis, double turn, double reach, double size,
             double growth) {
    a_ = root_of(spin, axis, turn, reach, size, growth);
    now_a_ = std::sqrt(a_.a0);
  }
  void set_b(const Spin& spin, const Vec3& axis, double turn, double reach, double size,
             double growth) {
    b_ = root_of(spin, axis, turn, reach, size, growth);
    now_b_ = std::sqrt(b_.a0);
  }

  void raise(double by) { c0_ += by; }

  [[nodiscard]] double now() const { return c0_ - now_a_ - now_b_; }
  [[nodiscard]] double at(double t) const {
    return c0_ + t * (c1_ + t * (c2_ + t * c3_)) - a_.at(t) - b_.at(t);
  }
  [[nodiscard]] double slope(double t) const {
    return c1_ + t * (2.0 * c2_ + t * 3.0 * c3_) - a_.slope(t) - b_.slope(t);
  }
  [[nodiscard]] double slope_now() const { return c1_ - a_.a1 / now_a_ - b_.a1 / now_b_; }

 private:
  struct Root {
    double a0 = 0.0, a1 = 0.0, a2 = 0.0;
    [[nodiscard]] double at(double t) const {
      return std::sqrt(std::max(0.0, a0 + t * (2.0 * a1 + t * a2)));
    }
    [[nodiscard]] double slope(double t) const { return (a1 + t * a2) / at(t); }
  };

  Root root_of(const Spin& spin, const Vec3& axis, double turn, double reach, double size,
               double growth) {
    const Vec3 k = cross(normal_, spin.angular);
    const double bend = reach * norm(k);
    c2_ -= bend * (growth + 0.5 * size * turn);
    c3_ -= bend * (0.5 * growth * turn);
    const double n_axial = dot(normal_, axis), k_axial = dot(k, axis);
    const Vec3 n_flat = normal_ - n_axial * axis, k_flat = k - k_axial * axis;
    const double axial_sq = spin.axial * spin.axial, lateral_sq = spin.lateral * spin.lateral;
    const double nn = axial_sq * n_axial * n_axial + lateral_sq * norm_sq(n_flat);
    const double nk = axial_sq * n_axial * k_axial + lateral_sq * dot(n_flat, k_flat);
    const double kk = axial_sq * k_axial * k_axial + lateral_sq * norm_sq(k_flat);
    return {size * size * nn, size * (size * nk + growth * nn),
            size * (size * kk + 2.0 * growth * nk) + growth * growth * nn};
  }

  Vec3 normal_;
  double c0_, c1_, c2_ = 0.0, c3_ = 0.0;
  Root a_, b_;
  double now_a_ = 0.0, now_b_ = 0.0;
};

}  // namespace packstone::event_driven
