#pragma once

/// @file
/// How far a body reaches from its center.

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// Radius of the largest ball about the center inside the body [L].
[[nodiscard]] double in_radius(const Body& body) noexcept;

/// Radius of the smallest ball about the center that holds the body [L].
[[nodiscard]] double circum_radius(const Body& body) noexcept;

/// Half edges of the tight axis-aligned box about the center [L]: the support function along x, y
/// and z, rounded up so that the box holds the body for certain. z is 0 in 2D.
[[nodiscard]] Vec3 half_extents(const Body& body) noexcept;

}  // namespace packstone
