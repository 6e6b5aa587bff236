#pragma once

/// @file
/// The two proofs that a verdict rests on, for bodies of known type.

#include <cmath>
#include <type_traits>

#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone {

[[nodiscard]] inline double reach(const Sphere& body) { return body.radius; }
[[nodiscard]] inline double reach(const Ellipsoid& body) {
  return std::fmax(body.semi_axes.x, std::fmax(body.semi_axes.y, body.semi_axes.z));
}
[[nodiscard]] inline double reach(const Cylinder& body) { return body.radius + body.half_length; }
[[nodiscard]] inline double reach(const Spherocylinder& body) {
  return body.radius + body.half_length;
}
[[nodiscard]] inline double reach(const Disk& body) { return body.radius; }
[[nodiscard]] inline double reach(const Ellipse& body) {
  return std::fmax(body.semi_axes.x, body.semi_axes.y);
}

/// Radius of a ball about the center inside the body [L].
template <class Shape>
[[nodiscard]] double least_reach(const Shape& body) {
  if constexpr (std::is_same_v<Shape, Ellipsoid>) {
    return std::fmin(body.semi_axes.x, std::fmin(body.semi_axes.y, body.semi_axes.z));
  } else if constexpr (std::is_same_v<Shape, Ellipse>) {
    return std::fmin(body.semi_axes.x, body.semi_axes.y);
  } else if constexpr (std::is_same_v<Shape, Cylinder>) {
    return std::fmin(body.radius, body.half_length);
  } else {
    return body.radius;
  }
}

/// Bound on the rounding error of g(d), equation (1) of contact.hpp, for unit d [L].
template <class A, class B>
[[nodiscard]] double gap_roundoff(const A& a, const B& b, const Vec3& r_ab) {
  return kProofRoundoff * (norm(r_ab) + reach(a) + reach(b));
}

/// g(d) of equation (1) of contact.hpp as evaluated, for unit d [L].
template <class A, class B>
[[nodiscard]] double gap_along(const A& a, const B& b, const Vec3& r_ab, const Vec3& d) {
  return dot(d, r_ab) - support(a, d) - support(b, d);
}

/// g(d) for certain: a proven lower bound on the gap [L].
template <class A, class B>
[[nodiscard]] double proven_gap_along(const A& a, const B& b, const Vec3& r_ab, const Vec3& d) {
  return gap_along(a, b, r_ab, d) - gap_roundoff(a, b, r_ab);
}

/// Is x (relative to the center of a) certainly a point of both bodies?
template <class A, class B>
[[nodiscard]] bool in_both(const A& a, const B& b, const Vec3& r_ab, const Vec3& x) {
  return contains(a, x) && contains(b, x - r_ab);
}

}  // namespace packstone
