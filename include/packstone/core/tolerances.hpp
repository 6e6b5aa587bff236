#pragma once

/// @file
/// Every named tolerance, with its unit and where it comes from.

#include <limits>

namespace packstone {

/// Unit of rounding of double, 2^-53.
inline constexpr double kUnitRoundoff = 0.5 * std::numeric_limits<double>::epsilon();

/// Bound on the error of support() over circum_radius * |d| [-]. The longest chain is the
/// ellipsoid's: rotation matrix from the quaternion (3 roundings an entry), transposed product (3),
/// scaling (1), norm (3, half of them under the root): below 12 units; 16 leaves room.
inline constexpr double kSupportRoundoff = 16 * kUnitRoundoff;

/// Bound on the error of g(d) over |r| + circum_radius(a) + circum_radius(b) [-]: kSupportRoundoff,
/// the product d.r (3), two subtractions (2) and a direction that is unit within 4 units.
inline constexpr double kProofRoundoff = kSupportRoundoff + 12 * kUnitRoundoff;

/// Promised error of gap() over the larger circumscribed radius [-].
inline constexpr double kGapRoundoff = 1e-12;

/// How far the length of a stored unit vector or quaternion may be from 1 [-]: rounding of numbers
/// written in full, with room; readers refuse more, since the body would be another one.
inline constexpr double kUnitTolerance = 1e-12;

}  // namespace packstone
