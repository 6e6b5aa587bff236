#pragma once

/// @file
/// What one asks of a pair of bodies: do they overlap, how far apart, at which scale do they touch.
///
/// Everything follows from one function. With r = r_ab, the center of b minus the center of a, and
/// S the support function (support.hpp), for a unit vector d from a to b
///
///     g(d) = d.r - S_a(d) - S_b(-d)                                                        (1)
///     gap  = max g(d) over |d| = 1                                                         (2)
///
/// The gap is the surface-to-surface distance when positive and minus the penetration depth when
/// negative. Any d with g(d) > 0 proves that the bodies are apart, by at least g(d); any point held
/// by both proves that they overlap. So a kernel may search as it likes: what it returns is the
/// direction or the point, and a verdict that rests on checking it (`proof`).
///
/// Bodies of one dimension only: both 3D, or both 2D with r.z = 0. Kernels never throw, never
/// allocate, and end after a bounded number of steps.

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// What has been shown about a pair.
enum class Verdict {
  separated,    ///< The gap is greater than the gap asked for.
  overlapping,  ///< It is not: for gap 0, the interiors share a point.
  undecided,    ///< Neither could be proven. Callers treat this as overlapping.
};

/// A verdict with the vector that proves it.
struct Decision {
  Verdict verdict = Verdict::undecided;
  /// separated: unit direction d from a to b with g(d) > gap asked for, equation (1).
  /// overlapping with gap 0 asked for: a point of both bodies, relative to the center of a.
  /// Otherwise the best direction found.
  Vec3 witness;
};

/// Signed gap with its contact.
struct Gap {
  double value = 0.0;  ///< Surface-to-surface distance, or minus the penetration depth [L].
  double error = 0.0;  ///< |value - true gap| <= error, proven [L].
  Vec3 normal;         ///< Unit, from a to b, attains `value` in equation (1).
  Vec3 point_a;        ///< On the surface of a, relative to the center of a, to 1e-6 [L].
  Vec3 point_b;        ///< On the surface of b, relative to the center of a, likewise [L];
                       ///< point_b - point_a = value * normal.
};

/// Bounds on the common scale mu: both bodies, grown or shrunk by mu about their own centers,
/// touch. mu > 1 separated, mu < 1 overlapping.
struct ContactScale {
  double lower = 0.0;  ///< lower <= mu [-].
  double upper = 0.0;  ///< mu <= upper [-].
};

/// Is the gap greater than `min_gap`? See Verdict; `min_gap` >= 0 [L].
[[nodiscard]] Decision decide(const Body& a, const Body& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;

/// decide() without the witness.
[[nodiscard]] Verdict overlap(const Body& a, const Body& b, const Vec3& r_ab,
                              double min_gap = 0.0) noexcept;

/// Signed gap, normal and contact points, equations (1) and (2). The error is proven and at most
/// kGapRoundoff times the larger circumscribed radius, save for the cases that gap.md lists.
[[nodiscard]] Gap gap(const Body& a, const Body& b, const Vec3& r_ab) noexcept;

/// Bounds on the common scale at which the pair touches, proven, to 1e-12 relative (pairs thinner
/// than 1 : 50 to 2e-14 times the ratio of their outer and inner radii; rods that are parallel but
/// for rounding up to 500 times that). r_ab = 0 gives {0, 0}.
[[nodiscard]] ContactScale contact_scale(const Body& a, const Body& b, const Vec3& r_ab) noexcept;

/// g(d) of equation (1) less a bound on its rounding error, for unit d: a proven lower bound on the
/// gap [L]. This is all that a reader of a witness file has to evaluate.
[[nodiscard]] double proven_gap(const Body& a, const Body& b, const Vec3& r_ab,
                                const Vec3& d) noexcept;

/// A cheap proven lower bound on the gap, from a few directions only [L]. Never above gap().value
/// plus its error; equal to it for pairs of spheres, disks and spherocylinders.
[[nodiscard]] double quick_gap_bound(const Body& a, const Body& b, const Vec3& r_ab) noexcept;

}  // namespace packstone
