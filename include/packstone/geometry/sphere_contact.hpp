#pragma once

/// @file
/// Closed forms for spheres, spherocylinders, and a sphere with a cylinder.
///
/// A sphere is a point and a spherocylinder a segment, grown by a ball. With D the distance of
/// these cores and R the sum of the radii,
///
///     gap = D - R                                                                          (1)
///
/// also where the bodies overlap: two segments never overlap deeply, since a direction across both
/// has g(d) = D - R, and no point of the sum of two segments (a parallelogram) is farther from its
/// rim than that. A sphere of radius R about the point c, with rho and z the coordinates of c
/// across and along the axis of a cylinder of radius r and half length h, has
///
///     gap = | (max(rho - r, 0), max(|z| - h, 0)) | - R        c outside the cylinder       (2)
///     gap = -min(r - rho, h - |z|) - R                        c inside                     (3)
///
/// Verdicts rest on proof all the same (contact.hpp). Cost: 10 to 60 ns.

#include "packstone/geometry/contact.hpp"

namespace packstone {

[[nodiscard]] Decision decide(const Sphere& a, const Sphere& b, const Vec3& r_ab,
                              double min_gap) noexcept;
[[nodiscard]] Decision decide(const Sphere& a, const Spherocylinder& b, const Vec3& r_ab,
                              double min_gap) noexcept;
[[nodiscard]] Decision decide(const Spherocylinder& a, const Spherocylinder& b, const Vec3& r_ab,
                              double min_gap) noexcept;
[[nodiscard]] Decision decide(const Sphere& a, const Cylinder& b, const Vec3& r_ab,
                              double min_gap) noexcept;

[[nodiscard]] Gap gap(const Sphere& a, const Sphere& b, const Vec3& r_ab) noexcept;
[[nodiscard]] Gap gap(const Sphere& a, const Spherocylinder& b, const Vec3& r_ab) noexcept;
[[nodiscard]] Gap gap(const Spherocylinder& a, const Spherocylinder& b, const Vec3& r_ab) noexcept;
[[nodiscard]] Gap gap(const Sphere& a, const Cylinder& b, const Vec3& r_ab) noexcept;

[[nodiscard]] ContactScale contact_scale(const Sphere& a, const Sphere& b,
                                         const Vec3& r_ab) noexcept;

[[nodiscard]] double quick_gap_bound(const Sphere& a, const Sphere& b, const Vec3& r_ab) noexcept;
[[nodiscard]] double quick_gap_bound(const Sphere& a, const Spherocylinder& b,
                                     const Vec3& r_ab) noexcept;
[[nodiscard]] double quick_gap_bound(const Spherocylinder& a, const Spherocylinder& b,
                                     const Vec3& r_ab) noexcept;
[[nodiscard]] double quick_gap_bound(const Sphere& a, const Cylinder& b, const Vec3& r_ab) noexcept;

}  // namespace packstone
