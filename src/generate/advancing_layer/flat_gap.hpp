#pragma once

/// @file
/// The gap of two ellipses in the plane, exact where it counts.

#include "geometry/posed_body.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// A direction from a to b that is nearly right wherever they stand: the normal of the ellipses
/// about both centers that touch where they are grown by one factor, if that were the same for
/// both; (A + B)^-1 r with the matrices of the squared support functions. Unit.
[[nodiscard]] Vec3 first_direction(const PosedBody& a, const PosedBody& b, const Vec3& r);

/// A lower bound on the gap of a and b [L], r from center to center: g(d) of contact.hpp at the
/// unit direction `d` from a to b, which is first turned toward the greatest g, by Newton's method
/// on the angle, `most_steps` times at most. Of bodies that are apart g has one maximum, the gap.
/// Ends as soon as the bound exceeds `limit`.
///
/// Takes forms ball and spheroid, the axis in the plane. Cost: some 15 ns a step.
double flat_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, double limit, int most_steps,
                Vec3& d);

}  // namespace packstone::advancing_layer
