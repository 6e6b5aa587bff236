#pragma once

/// @file
/// The direction of the largest gap between two bodies that are apart.
///
/// With g(d) = d.r - S_a(d) - S_b(-d), and u the axis of a rod, S is smooth but where d is across
/// u, so that the plane rests on the whole side of the rod, and where d is along u, so that it
/// rests on a flat end. The search keeps a set of rods whose side the plane rests on. On what that
/// leaves of the sphere of directions (all of it, a great circle, two points) it takes Newton's
/// steps; a step that would cross the middle of a rod stops there and adds it to the set. Where the
/// steps end, the part of the contact point along the axis says whether a rod is rightly in the
/// set: r less the other body's contact point has to lie over its side.
///
/// g is concave as a function of vectors, so that what is found is the one maximum. Where the
/// search does not end soon, gap() of contact.hpp has the last word.

#include "geometry/posed_body.hpp"

namespace packstone {

/// A unit vector along which the gap is the largest, to `accuracy` [rad], starting from the unit
/// vector `start`.
[[nodiscard]] Vec3 ascend_gap(const PosedBody& a, const PosedBody& b, const Vec3& r,
                              const Vec3& start, double accuracy);

/// The same, but content with a direction that none next to it beats: where bodies overlap there
/// may be others, and what is found hangs on the start. Improves the unit vector `direction`; false
/// where it has not come to an end.
bool climb_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, Vec3& direction,
               double accuracy);

}  // namespace packstone
