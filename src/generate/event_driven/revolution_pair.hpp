#pragma once

/// @file
/// The plane between two bodies of revolution, for numbers as for lanes of them.
///
/// With shape matrices A = a0 + a1 u u^T and B = b0 + b1 v v^T the normal of Perram and Wertheim at
/// l, (A (1-l) + B l)^-1 r, is
///
///     n = (r - x u - y v) / y0,   y0 = a0 (1-l) + b0 l                                      (1)
///
/// where x = a1 (1-l) u.n and y = b1 l v.n come from a linear system of two equations: no matrix is
/// needed. Any l gives a plane; a Newton step on (1-l)^2 n.An = l^2 n.Bn moves it to the one that
/// separates the bodies scaled by most. See ellipsoid_contact.hpp.

#include "generate/event_driven/rotation.hpp"

namespace packstone::event_driven {

/// One body of a pair, now. Number is double or lanes of it, Vector three of them.
template <class Number, class Vector>
struct Revolution {
  Vector axis;
  Vector angular;  ///< Across `axis`.
  Number lateral;  ///< a0
  Number extra;    ///< a1
  Number turn;     ///< Length of `angular`.
};

/// The axis after a turn about an angular velocity across it.
template <class Number, class Vector>
[[gnu::always_inline]] inline Vector turned_across(const Vector& axis, const Vector& angular,
                                                   const Number& turn, const Number& dt) {
  const Number turn_sq = turn * turn;
  const Rotor<Number> by = rotor(turn_sq, dt);
  return (1.0 - turn_sq * by.versine) * axis + by.sine * cross(angular, axis);
}

/// A plane between two bodies, at l.
template <class Number, class Vector>
struct RevolutionPlane {
  Vector normal;
  Number l;
};

/// One Newton step from l; the normal is moved on to where the step ends.
template <class Number, class Vector>
[[gnu::always_inline]] inline RevolutionPlane<Number, Vector> plane_step(
    const Revolution<Number, Vector>& a, const Revolution<Number, Vector>& b, const Vector& r,
    const Number& l) {
  const Number m = 1.0 - l;
  const Number alpha = m * a.extra, beta = l * b.extra;
  const Number c = dot(a.axis, b.axis), ar = dot(a.axis, r), br = dot(b.axis, r);
  const Number y0 = m * a.lateral + l * b.lateral;
  const Number aa = y0 + alpha, bb = y0 + beta;
  const Number det = aa * bb - alpha * beta * c * c;
  // One division for two.
  const Number per_both = 1.0 / (det * y0);
  const Number per_det = per_both * y0, per_y0 = per_both * det;
  const Number along_a = (ar * bb - beta * c * br) * per_det;
  const Number along_b = (br * aa - alpha * c * ar) * per_det;
  const Vector n = per_y0 * (r - (alpha * along_a) * a.axis - (beta * along_b) * b.axis);
  const Number nn = dot(n, n);
  const Number push_a = a.extra * along_a, push_b = b.extra * along_b;
  const Number p = a.lateral * nn + push_a * along_a;
  const Number q = b.lateral * nn + push_b * along_b;
  // The slope of n is Y^-1 (A - B) n: the same system once more.
  const Number difference = a.lateral - b.lateral;
  const Number ag = difference * along_a + push_a - push_b * c;
  const Number bg = difference * along_b + push_a * c - push_b;
  const Number slope_a = (ag * bb - beta * c * bg) * per_det;
  const Number slope_b = (bg * aa - alpha * c * ag) * per_det;
  const Vector slope = per_y0 * (difference * n + (push_a - alpha * slope_a) * a.axis -
                                 (push_b + beta * slope_b) * b.axis);
  const Number n_slope = dot(n, slope);
  const Number p_slope = a.lateral * n_slope + push_a * slope_a;
  const Number q_slope = b.lateral * n_slope + push_b * slope_b;
  const Number value = m * m * p - l * l * q;
  const Number rate = 2.0 * (m * m * p_slope - l * l * q_slope - m * p - l * q);
  // Away from 0 and 1, where one body alone would count.
  const Number wanted = l - value / rate;
  const Number low = 0.25 * l, high = 1.0 - 0.25 * m;
  const Number raised = wanted > low ? wanted : low;
  const Number next = raised < high ? raised : high;
  const Number moved = next - l;
  return {n + moved * slope, next};
}

}  // namespace packstone::event_driven
