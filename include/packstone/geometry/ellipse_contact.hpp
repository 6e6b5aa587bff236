#pragma once

/// @file
/// Contact in the plane: two disks, a disk and an ellipse, two ellipses.
///
/// Disks are closed. A disk and an ellipse follow from the nearest point of the ellipse to the
/// center of the disk, one root, as in equations (6) and (7) of ellipsoid_contact.hpp. Whether two
/// ellipses overlap is decided by the pencil of Perram and Wertheim, equations (1) to (3) there;
/// in the plane adj(A + kB) is linear in k.
///
/// The signed gap of two ellipses is the greatest value of g over the angle t of the direction, and
///
///     g'' + g = -(rho_a + rho_b),      rho = (a b)^2 / S^3                                  (1)
///
/// with S the support function and rho the radius of curvature (Minkowski's relation rho = S +
/// S''). So Newton's step is closed, g' / (g + rho_a + rho_b), and from any t0, with rho a lower
/// bound on rho_a + rho_b over the arc,
///
///     g(t0 + s) <= (g0 + rho) cos s + |g0'| sin |s| - rho                                   (2)
///
/// rules out arcs. One evaluation closes the question when the depth is below the sum of the least
/// radii of curvature; otherwise the circle is bisected until nothing is left.
///
/// Every verdict rests on a direction or on a common point that was checked. Properties
/// (tests/unit/geometry/test_ellipse_contact.cpp): exchange, rigid motion, homogeneity, monotony,
/// disks as a limit, agreement with ellipsoids whose third semi-axis lies across the plane.
///
/// z of every vector is 0 and ignored on input.
///
/// References: J. W. Perram, M. S. Wertheim, J. Comput. Phys. 58 (1985) 409-416; D. Eberly,
/// "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid", Geometric Tools
/// (2013); R. Schneider, Convex Bodies: The Brunn-Minkowski Theory (2014), section 2.5.

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {

/// Is the gap greater than `min_gap` >= 0 [L]?
[[nodiscard]] Decision decide(const Disk& a, const Disk& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;
[[nodiscard]] Decision decide(const Disk& a, const Ellipse& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;
[[nodiscard]] Decision decide(const Ellipse& a, const Ellipse& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;

/// Signed gap with contact; error below kGapRoundoff times the larger body. Concentric disks have
/// the normal along x.
[[nodiscard]] Gap gap(const Disk& a, const Disk& b, const Vec3& r_ab) noexcept;
[[nodiscard]] Gap gap(const Disk& a, const Ellipse& b, const Vec3& r_ab) noexcept;
[[nodiscard]] Gap gap(const Ellipse& a, const Ellipse& b, const Vec3& r_ab) noexcept;

/// Bounds on the common scale, to 1e-12 relative for aspect ratios up to 1000.
[[nodiscard]] ContactScale contact_scale(const Disk& a, const Disk& b, const Vec3& r_ab) noexcept;
[[nodiscard]] ContactScale contact_scale(const Disk& a, const Ellipse& b,
                                         const Vec3& r_ab) noexcept;
[[nodiscard]] ContactScale contact_scale(const Ellipse& a, const Ellipse& b,
                                         const Vec3& r_ab) noexcept;

}  // namespace packstone
