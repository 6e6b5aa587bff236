#pragma once

/// @file
/// Volume and second moments of a body, from exact formulas.

#include "packstone/core/mat.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// Volume [L^3]; of disk and ellipse the area [L^2].
[[nodiscard]] double volume(const Body& body) noexcept;

/// Surface area [L^2]; of disk and ellipse the perimeter [L]. Ellipsoid by Carlson's R_G, ellipse
/// by the complete elliptic integral of the second kind.
[[nodiscard]] double surface(const Body& body);

/// Second moment of volume about the center, integral of x x^T dV, in the cell frame [L^5]
/// ([L^4] in 2D). The inertia tensor at density 1 is trace(M) I - M.
[[nodiscard]] SymMat3 second_moment(const Body& body) noexcept;

/// The direction in which the body is longest: the axis of a cylinder or spherocylinder, the
/// longest axis of an ellipsoid or ellipse (the first of equals), unit; (0, 0, 0) of spheres and
/// disks.
[[nodiscard]] Vec3 long_axis(const Body& body) noexcept;

/// The same shape, each length multiplied by `factor` > 0.
[[nodiscard]] Body scaled(const Body& body, double factor) noexcept;

/// The same shape turned by `q`. 2D bodies take the turn about z that `q` makes.
[[nodiscard]] Body rotated(const Body& body, const Quaternion& q) noexcept;

}  // namespace packstone
