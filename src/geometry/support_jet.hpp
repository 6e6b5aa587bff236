#pragma once

/// @file
/// The support function of a body about a direction, to second order.

#include <algorithm>
#include <cmath>

#include "geometry/posed_body.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A direction with two directions across it.
struct Tangents {
  Vec3 d, t_1, t_2;

  explicit Tangents(const Vec3& unit)
      : d(unit), t_1(any_perpendicular(unit)), t_2(cross(unit, t_1)) {}
};

/// S(d + sum x_i t_i) = value + sum slope_i x_i + 1/2 sum bend_ij x_i x_j + ...
struct SupportJet {
  double value, slope_1, slope_2, bend_11, bend_12, bend_22;
};

/// Of a body of revolution, which on the unit sphere has S = f(x), x = u.d.
inline SupportJet jet_of_profile(double f, double f_1, double f_2, double x, double x_1,
                                 double x_2) {
  const double round = f - x * f_1;
  return {
      f, f_1 * x_1, f_1 * x_2, f_2 * x_1 * x_1 + round, f_2 * x_1 * x_2, f_2 * x_2 * x_2 + round};
}

/// Of a body whose nearer end, of rods, is the one with the sign `end`: of the rod's half beyond it
/// where `end` is 0, which leaves the part across the axis.
inline SupportJet support_jet(const PosedBody& body, const Tangents& at, double end) {
  const Vec3& u = body.pose.axis;
  if (body.form == Form::scalene) {
    const Vec3 image = shape_times(body, at.d);
    const Vec3 image_1 = shape_times(body, at.t_1), image_2 = shape_times(body, at.t_2);
    const double f = std::sqrt(dot(at.d, image));
    const double f_1 = dot(at.t_1, image) / f, f_2 = dot(at.t_2, image) / f;
    return {f,
            f_1,
            f_2,
            (dot(at.t_1, image_1) - f_1 * f_1) / f,
            (dot(at.t_1, image_2) - f_1 * f_2) / f,
            (dot(at.t_2, image_2) - f_2 * f_2) / f};
  }
  const double x = dot(u, at.d), x_1 = dot(u, at.t_1), x_2 = dot(u, at.t_2);
  if (is_ellipsoid(body.form)) {
    const double lateral_sq = body.lateral * body.lateral;
    const double extra = body.axial * body.axial - lateral_sq;
    const double f = std::sqrt(lateral_sq + extra * x * x);
    return jet_of_profile(f, extra * x / f, extra * lateral_sq / (f * f * f), x, x_1, x_2);
  }
  const double h = end * body.axial, r = body.lateral;
  if (body.form == Form::spherocylinder) return jet_of_profile(h * x + r, h, 0.0, x, x_1, x_2);
  // Away from the corner of the profile at x = 1; not by way of 1 - x^2, of which nothing is left
  // there.
  constexpr double kLeastFlat = 1e-12;
  const double flat = std::max(kLeastFlat, norm(at.d - x * u));
  return jet_of_profile(h * x + r * flat, h - r * x / flat, -r / (flat * flat * flat), x, x_1, x_2);
}

}  // namespace packstone
