#pragma once

/// @file
/// Areas of plane sections, and the volumes that they add up to.
///
/// A section across axis k of an ellipsoid, or of a cylinder without ends, is at height z the
/// ellipse
///
///     { drift z + sigma(z) L y : |y| <= 1 },   sigma(z) = sqrt(1 - z^2 / reach^2)          (1)
///
/// with L a lower triangle; the reach of the cylinder is infinite. Half-spaces that end the body
/// and the sides of a box leave of it the part in a polygon, whose area has a closed form.

#include <array>
#include <cstddef>

#include "packstone/core/vec.hpp"

namespace packstone {

/// The points with normal.x <= offset.
struct HalfSpace {
  Vec3 normal;
  double offset = 0.0;
};

/// Part of an ellipsoid or of an endless cylinder about its own center.
struct SlicedBody {
  /// Columns are the semi-axes of the ellipsoid [L], as rows: x_k = rows[k].y for |y| <= 1.
  std::array<Vec3, 3> rows;
  Vec3 axis;            ///< Of the cylinder, unit.
  double radius = 0.0;  ///< Of the cylinder [L]; 0: it is an ellipsoid.
  Vec3 half_extents;    ///< Of the part, or more [L].
  std::array<HalfSpace, 2> ends;
  std::size_t end_count = 0;
};

/// Volume of the part in a box [L^3]; finite or infinite sides.
[[nodiscard]] double sliced_volume(const SlicedBody& body, const Vec3& lo, const Vec3& hi) noexcept;

}  // namespace packstone
