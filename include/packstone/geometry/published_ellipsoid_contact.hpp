#pragma once

/// @file
/// The ellipsoid test of Ghossein and Levesque as published, for comparison only.
///
/// **Do not pack with it.** Its table calls some overlapping pairs separate, and rounding decides
/// for spheres, nearly spheres and equal bodies with nearly parallel axes.
/// docs/algorithms/published_event_driven.md counts how often. Use decide() of contact.hpp, which
/// proves what it says.
///
/// With the 4x4 matrices A and B of two ellipsoids in homogeneous coordinates (x^T A x < 0 inside),
///
///     p(l) = det(l A + B) = p_1 l^4 + p_2 l^3 + p_3 l^2 + p_4 l + p_5                      (1)
///
/// has two negative roots always; the bodies are separate if the other two are positive, touch from
/// outside if these coincide, and overlap otherwise. Algorithm 3 gives the p_k; Algorithm 4 five
/// numbers eta_k, from which Table 1 reads what the roots are. With p / p_1 = l^4 - 4 q_1 l^3 +
/// 6 q_2 l^2 - 4 q_3 l + q_4 (the paper's p_k with a bar), eta_1 is the product of the squared
/// differences of all roots over 256, and at a double root l_0 apart from the two other roots
///
///     l_0 = -3 eta_3 / eta_2                                                                (2)
///
/// A is diagonal in the frame of a, and C = M^T B M of Algorithm 3 is B in that frame. So p needs
/// only the separation of the centers, and rounds better than from absolute coordinates.
///
/// What our copy of the paper prints otherwise, and cannot be meant: p_5 = det(A), where only
/// det(B) makes (1) true; eta_4 = q_4 - q_1 q_3, where Table 1 needs its negative; and the contact
/// point as a null vector of l_0 A - B, where (1) needs l_0 A + B.
///
/// Kernels neither throw nor allocate.
///
/// References: E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013) 471-490, section 4.2,
/// Algorithms 3 and 4, Table 1; W. Wang, J. Wang, M.-S. Kim, Comput. Aided Geom. Des. 18 (2001)
/// 531-539.

#include <array>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// How faithful to the print.
enum class PublishedForm {
  printed,    ///< As printed.
  corrected,  ///< With what is missing restored.
};

/// p_1 to p_5 of equation (1) [L^-6], highest power first.
using PublishedQuartic = std::array<double, 5>;

/// What Algorithm 4 makes of a quartic [-].
struct PublishedEtas {
  double eta_1 = 0.0;
  double eta_2 = 0.0;
  double eta_3 = 0.0;
  double eta_4 = 0.0;
  double eta_5 = 0.0;
  double eta_2_size = 0.0;  ///< Sum of the sizes of the terms of eta_2: where it is zero for.
};

/// The outcomes of Table 1.
enum class PublishedRelation { separate, tangent, overlapping };

/// Algorithm 3. r_ab: center of b minus center of a [L].
[[nodiscard]] PublishedQuartic published_quartic(const Ellipsoid& a, const Ellipsoid& b,
                                                 const Vec3& r_ab) noexcept;

/// Algorithm 4.
[[nodiscard]] PublishedEtas published_etas(const PublishedQuartic& p) noexcept;

/// Cases 3 and 4 of Table 1 at a root of eta_1, whatever rounding has left of it: is the double
/// root positive? "eta_2 = 0" is taken within 1e-6 of the size of its terms: where the other two
/// roots differ by d, eta_2 is of order d^2, and the rounding of eta_1, of order 1e-16, puts its
/// root off by 1e-16 / d^2; the larger of both is 1e-8 at least. Case 4 needs eta_4 besides.
[[nodiscard]] bool published_touching(const PublishedEtas& eta) noexcept;

/// Table 1. As printed, "separate" asks for four real roots only; deep overlaps with four negative
/// ones pass. Corrected, it asks for a change of sign among the p_k as well, which by Descartes'
/// rule is there if two roots are positive and is not if none is. "eta_1 = 0" is exact here.
[[nodiscard]] PublishedRelation published_relation(const PublishedQuartic& p,
                                                   PublishedForm form) noexcept;
[[nodiscard]] PublishedRelation published_relation(const Ellipsoid& a, const Ellipsoid& b,
                                                   const Vec3& r_ab, PublishedForm form) noexcept;

/// Where two bodies touch.
struct PublishedTouch {
  double root = 0.0;  ///< The double root of equation (1) [-].
  Vec3 point;         ///< Relative to the center of a [L].
  Vec3 normal;        ///< Unit, from a to b.
};

/// Equations (14) and (26) of the paper, for a pair that touches from outside. The double root is
/// the largest root of p', since two roots of p are negative and p' has one between each two; so it
/// is found to full precision, and also next to touching.
[[nodiscard]] PublishedTouch published_touch(const Ellipsoid& a, const Ellipsoid& b,
                                             const Vec3& r_ab) noexcept;

}  // namespace packstone
