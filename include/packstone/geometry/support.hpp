#pragma once

/// @file
/// Support function and membership: the two primitives that every proof about bodies rests on.
///
/// With K the body about its own center and d a direction,
///
///     S(d) = max { d.x : x in K }                                                          (1)
///
/// All six shapes are Minkowski sums of (degenerate) ellipsoids, so S has a closed form:
///
///     sphere, disk      r |d|
///     ellipsoid         | diag(a, b, c) R^T d |
///     cylinder          h |u.d| + r |d - (u.d) u|
///     spherocylinder    h |u.d| + r |d|
///     ellipse           | diag(a, b) R^T d |
///
/// Each overload below is exact up to rounding: relative error of S at most kSupportRoundoff.

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// S(d), equation (1) [L]; d need not be unit, S is homogeneous of degree 1. In 2D d.z is ignored.
[[nodiscard]] double support(const Sphere& body, const Vec3& d) noexcept;
[[nodiscard]] double support(const Ellipsoid& body, const Vec3& d) noexcept;
[[nodiscard]] double support(const Cylinder& body, const Vec3& d) noexcept;
[[nodiscard]] double support(const Spherocylinder& body, const Vec3& d) noexcept;
[[nodiscard]] double support(const Disk& body, const Vec3& d) noexcept;
[[nodiscard]] double support(const Ellipse& body, const Vec3& d) noexcept;
[[nodiscard]] double support(const Body& body, const Vec3& d) noexcept;

/// A point of the body, relative to its center, where S(d) is attained [L]; d != 0.
[[nodiscard]] Vec3 support_point(const Sphere& body, const Vec3& d) noexcept;
[[nodiscard]] Vec3 support_point(const Ellipsoid& body, const Vec3& d) noexcept;
[[nodiscard]] Vec3 support_point(const Cylinder& body, const Vec3& d) noexcept;
[[nodiscard]] Vec3 support_point(const Spherocylinder& body, const Vec3& d) noexcept;
[[nodiscard]] Vec3 support_point(const Disk& body, const Vec3& d) noexcept;
[[nodiscard]] Vec3 support_point(const Ellipse& body, const Vec3& d) noexcept;
[[nodiscard]] Vec3 support_point(const Body& body, const Vec3& d) noexcept;

/// Does the body hold the point x (relative to its center) for certain? Rounding counts as no:
/// a point within a few units of rounding of the surface is not contained.
[[nodiscard]] bool contains(const Sphere& body, const Vec3& x) noexcept;
[[nodiscard]] bool contains(const Ellipsoid& body, const Vec3& x) noexcept;
[[nodiscard]] bool contains(const Cylinder& body, const Vec3& x) noexcept;
[[nodiscard]] bool contains(const Spherocylinder& body, const Vec3& x) noexcept;
[[nodiscard]] bool contains(const Disk& body, const Vec3& x) noexcept;
[[nodiscard]] bool contains(const Ellipse& body, const Vec3& x) noexcept;
[[nodiscard]] bool contains(const Body& body, const Vec3& x) noexcept;

}  // namespace packstone
