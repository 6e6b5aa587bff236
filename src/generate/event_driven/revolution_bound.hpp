#pragma once

/// @file
/// The bound of plane_bound.hpp for two bodies of revolution and a plane that does not turn: the
/// same numbers with less around them, since most searches spend their time here.

#include <algorithm>
#include <cmath>

#include "generate/event_driven/revolution_pair.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// G of equation (3) of plane_bound.hpp.
class RevolutionBound {
 public:
  /// Bodies that have circumscribed radii at size factor 1, and how they move.
  struct Moving {
    double reach_a, reach_b;
    double size, growth;
    Vec3 velocity;  ///< Of b seen from a.
  };

  RevolutionBound(const Vec3& normal, const Revolution<double, Vec3>& a,
                  const Revolution<double, Vec3>& b, const Vec3& r, const Moving& moving)
      : length_sq_(norm_sq(normal)),
        length_(std::sqrt(length_sq_)),
        c0_(dot(normal, r)),
        c1_(dot(normal, moving.velocity)),
        a_(root_of(a, normal, moving.reach_a, moving)),
        b_(root_of(b, normal, moving.reach_b, moving)),
        now_a_(std::sqrt(a_.a0)),
        now_b_(std::sqrt(b_.a0)) {}

  void raise(double by) { c0_ += by; }

  /// Of the normal.
  [[nodiscard]] double length() const { return length_; }
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

  // From the normal as it has been rounded: what the plane says that it has along the axis belongs
  // to the normal before its last cancellation, which long bodies that are nearly parallel feel.
  Root root_of(const Revolution<double, Vec3>& body, const Vec3& n, double reach,
               const Moving& moving) {
    const double s = moving.size, g = moving.growth;
    const Vec3 k = cross(n, body.angular);
    const double kk = norm_sq(k), k_along = dot(k, body.axis), along = dot(n, body.axis);
    const double bend = reach * std::sqrt(kk);
    c2_ -= bend * (g + 0.5 * s * body.turn);
    c3_ -= bend * (0.5 * g * body.turn);
    const double push = body.extra * along;
    const double n_n = std::max(0.0, body.lateral * length_sq_ + push * along);
    const double n_k = push * k_along;
    const double k_k = body.lateral * kk + body.extra * k_along * k_along;
    return {s * s * n_n, s * (s * n_k + g * n_n), s * (s * k_k + 2.0 * g * n_k) + g * g * n_n};
  }

  double length_sq_, length_;
  double c0_, c1_, c2_ = 0.0, c3_ = 0.0;
  Root a_, b_;
  double now_a_, now_b_;
};

}  // namespace packstone::event_driven
