#pragma once

/// @file
/// Does a body meet a box with edges along the axes of the cell? The cell itself is one, and each
/// of its faces is one without thickness.
///
/// With h the half edges and S the support function (support.hpp), for a unit vector d from the
/// body to the box
///
///     g(d) = d.r - S(d) - (h_x |d_x| + h_y |d_y| + h_z |d_z|)                              (1)
///
/// and g(d) > 0 proves the two apart, by at least g(d), as in contact.hpp.

#include <optional>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// A unit direction d with g(d) > `min_gap` for certain, equation (1) less its rounding; nothing
/// where none is found. Then body and box share a point, or are `min_gap` apart but for rounding:
/// callers take that for meeting.
///
/// @param half_edges  Of the box [L]. >= 0; 0: a rectangle, a segment, a point. z = 0 in 2D.
/// @param r           Center of the box minus center of the body [L]. z = 0 in 2D.
/// @param min_gap     [L] >= 0, for instance a bound on the rounding error of r.
///
/// Never throws, never allocates, bounded: the three axes, then the search of portal.hpp in the sum
/// of both, some 20 steps of it near touching.
[[nodiscard]] std::optional<Vec3> separating_direction(const Body& body, const Vec3& half_edges,
                                                       const Vec3& r,
                                                       double min_gap = 0.0) noexcept;

}  // namespace packstone
