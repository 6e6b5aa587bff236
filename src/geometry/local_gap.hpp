#pragma once

/// @file
/// The gap of two bodies as a relaxation sees it: fast, smooth along its path, never too large.
///
/// gap() of contact.hpp proves the greatest g(d), equation (1) there, over all directions. Here the
/// search starts from the direction that was found the last time and ends where none next to it is
/// better. For bodies that are apart, whose g has one maximum, that is the gap; for bodies that
/// overlap it is at most the gap, and stays on one branch of it while the bodies move, which keeps
/// an energy made of it differentiable. Either way g(normal) is a proof: the gap is at least that.
/// Of pairs that are apart, a few in a hundred of very unequal, very flat or nearly parallel ones
/// come to their maximum only when they are looked at again.

#include "geometry/posed_body.hpp"

namespace packstone {

/// What local_gap() has found.
struct LocalGap {
  double value = 0.0;  ///< g(normal) [L].
  Vec3 normal;         ///< Unit, from a to b.
  Vec3 point_a;        ///< Where a is met, relative to its center [L].
  Vec3 point_b;        ///< Where b is met, relative to its center [L].
};

/// Whether the gap of a and b, r from center to center, may be below `limit` [L]: then it is in
/// `found`. False where a direction shows that it is not; found.value is then a lower bound on it
/// that is not below `limit`, and the rest of `found` is not set.
///
/// `hint`: the direction that the last search for this pair ended with, 0 for none; set anew.
/// Cost: 5 ns for balls, 20 ns for spherocylinders, 40 ns for rods that cross in their middles;
/// else 0.1 to 0.5 us from a good hint, 1 us without.
bool local_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, double limit, Vec3& hint,
               LocalGap& found);

}  // namespace packstone
