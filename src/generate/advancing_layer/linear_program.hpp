#pragma once

/// @file
/// The lowest point of a polygon or polyhedron of few sides: linear programs in two and three
/// variables.

#include <span>

#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// n . x <= reach.
struct HalfSpace {
  Vec3 n;              ///< Unit; z = 0 in the plane.
  double reach = 0.0;  ///< >= 0: the origin is inside [L].
};

/// The x of least height (y in 2D, z in 3D) in all `sides` and in the box |x_k| <= most; one of
/// several where they are level. The origin where rounding leaves nothing.
///
/// Side by side: where the best point so far breaks the next one, the new best one lies on it, a
/// program of one dimension less (R. Seidel, Discrete Comput. Geom. 6 (1991) 423-434; in the order
/// given). Cost: some n to n^2 steps for n sides, of which here few are broken.
///
/// @tparam D  2 or 3.
template <int D>
[[nodiscard]] Vec3 lowest_point(std::span<const HalfSpace> sides, double most);

}  // namespace packstone::advancing_layer
