#pragma once

/// @file
/// Contact of two ellipsoids, and of a sphere and an ellipsoid.
///
/// **Two ellipsoids.** Grow both about their own centers by one factor mu until they touch. With
/// the shape matrices A and B (squared semi-axes, turned to the cell frame), r = r_ab, and
///
///     Y(l) = (1-l) A + l B,      n(l) = Y^-1 r,      p = n.An,      q = n.Bn                 (1)
///
/// every l in [0, 1] gives a direction and a point, and with them both sides of a bracket:
///
///     n(l) separates the bodies scaled by any mu below  n.r / (sqrt p + sqrt q)             (2)
///     x(l) = (1-l) A n lies in a and b scaled by        max((1-l) sqrt p, l sqrt q)         (3)
///
/// because x = r - l B n. Both meet where (1-l) sqrt p = l sqrt q: there mu^2 = max l(1-l) r.n(l),
/// the contact function of Perram and Wertheim, and (3) is what its tangent at l bounds it by. So
/// the search for l is free to err. What decides is the direction, put into equation (1) of
/// contact.hpp, or the point, put into both bodies; neither test involves Y, and their rounding
/// does not grow with the square of the aspect ratio as that of Y does.
///
/// The signed gap is the greatest value of g over all directions. On a great circle through d0,
///
///     g'' + g = -(sum of the radii of curvature of both bodies) <= -rho                     (4)
///     g(phi) <= (g0 + rho) cos phi + t0 sin phi - rho                                       (5)
///
/// with t0 the length of the tangential gradient and rho any lower bound on that sum; so a local
/// maximum is the global one as soon as g0 + rho >= 0, and otherwise (5) closes a cap about it
/// while quadratic bounds on both supports rule out the rest (docs/algorithms/gap.md). W. Blaschke,
/// Kreis und Kugel (1916), section 24, has the geometric side: a ball of the least radius of
/// curvature rolls inside the body.
///
/// **Sphere and ellipsoid.** With y the center of the ball in the frame of the ellipsoid, the
/// nearest point of the surface is x_i = e_i^2 y_i / (t + e_i^2) with t the one root above
/// -min e_i^2 of
///
///     sum (e_i y_i / (t + e_i^2))^2 = 1                                                     (6)
///
/// and for any t in that range, root or not, weak duality bounds the distance from below:
///
///     distance^2 >= t (sum y_i^2 / (t + e_i^2) - 1)                                         (7)
///
/// Properties (tests/unit/geometry/test_ellipsoid_contact.cpp): exchange of a and b, rigid motion,
/// homogeneity, spheres as a limit, monotony in every semi-axis.
///
/// Range: semi-axes between 1e-20 and 1e20 [L]. Kernels neither throw nor allocate.
///
/// References: J. W. Perram, M. S. Wertheim, J. Comput. Phys. 58 (1985) 409-416; D. Eberly,
/// "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid", Geometric Tools
/// (2013).

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {

/// Is the gap greater than `min_gap` >= 0 [L]? Undecided only within rounding of touching: a few
/// 1e-16 times the larger aspect ratio.
[[nodiscard]] Decision decide(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;
[[nodiscard]] Decision decide(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;

/// Signed gap with contact. Sphere and ellipsoid: closed up to one root, error a few units of
/// rounding. Two ellipsoids: error below kGapRoundoff times the larger body for aspect ratios up to
/// 200. Cost: about 1 us separated, up to 2 ms for deep overlaps.
[[nodiscard]] Gap gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) noexcept;
[[nodiscard]] Gap gap(const Sphere& a, const Ellipsoid& b, const Vec3& r_ab) noexcept;

/// Bracket (2), (3) of the common scale, closed to 1e-12 relative for aspect ratios up to 1000.
[[nodiscard]] ContactScale contact_scale(const Ellipsoid& a, const Ellipsoid& b,
                                         const Vec3& r_ab) noexcept;
[[nodiscard]] ContactScale contact_scale(const Sphere& a, const Ellipsoid& b,
                                         const Vec3& r_ab) noexcept;

}  // namespace packstone
