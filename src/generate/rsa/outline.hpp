#pragma once

/// @file
/// Outline: what settles most pairs without the exact kernel.

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::rsa {

/// A body between two balls, inside a capsule (a segment with a ball swept along it).
struct Outline {
  /// How the body and its capsule differ.
  enum class Ends {
    round,  ///< Not at all: sphere, spherocylinder, disk.
    flat,   ///< The body is the flat-ended cylinder about the segment.
    loose,  ///< The capsule holds the body, and the body holds the segment.
  };

  double in_radius = 0.0;      ///< Rounded down [L].
  double circum_radius = 0.0;  ///< Rounded up [L].
  Vec3 axis{0, 0, 1};          ///< Of the capsule, unit.
  double half_length = 0.0;    ///< Of its segment [L].
  double radius = 0.0;         ///< Of its ball [L].
  Ends ends = Ends::round;
};

[[nodiscard]] Outline outline_of(const Body& body) noexcept;

/// That of a ball.
[[nodiscard]] inline Outline ball_outline(double radius) noexcept {
  Outline outline;
  outline.in_radius = outline.circum_radius = outline.radius = radius;
  return outline;
}

/// Is the body a sphere or a disk?
[[nodiscard]] inline bool is_ball(const Outline& outline) noexcept {
  return outline.ends == Outline::Ends::round && outline.half_length == 0.0;
}

/// What a glance at two outlines shows.
struct Glance {
  Verdict verdict = Verdict::undecided;  ///< As of decide(), proven.
  Vec3 normal{1, 0, 0};                  ///< Unit, from a to b.
  double gap_bound = 0.0;                ///< g(normal), a proven lower bound on the gap [L].
};

/// Verdict for outlines that come within reach of each other, from the closest points of the
/// segments: they give the direction in which the bodies may be told apart, and the point that both
/// may hold. The balls of the outlines have been looked at before. For pairs of spheres,
/// spherocylinders, disks, and a sphere with a cylinder, undecided only within rounding.
[[nodiscard]] Verdict verdict_of_segments(const Outline& a, const Outline& b, const Vec3& r_ab,
                                          double min_gap) noexcept;

/// The balls first, then verdict_of_segments().
[[nodiscard]] inline Verdict quick_verdict(const Outline& a, const Outline& b, const Vec3& r_ab,
                                           double min_gap) noexcept {
  const double distance_sq = norm_sq(r_ab);
  const double far = a.circum_radius + b.circum_radius + min_gap;
  if (distance_sq > far * far) return Verdict::separated;
  const double near = a.in_radius + b.in_radius + min_gap;
  if (distance_sq <= near * near) return Verdict::overlapping;
  return verdict_of_segments(a, b, r_ab, min_gap);
}

/// Compares balls, then segments: a verdict with a lower bound on the gap. Arguments as of
/// decide().
[[nodiscard]] Glance glance(const Outline& a, const Outline& b, const Vec3& r_ab,
                            double min_gap) noexcept;

/// Where on the segment of a the segment of b is nearest, from the center of a [L]; nearly so for
/// nearly parallel segments.
[[nodiscard]] double nearest_on_segment(const Outline& a, const Outline& b,
                                        const Vec3& r_ab) noexcept;

/// Does the ball about `x`, given relative to the center of the body, come within `min_gap` of the
/// body for certain? False for Ends::loose.
[[nodiscard]] bool meets_ball(const Outline& body, const Vec3& x, double ball_radius,
                              double min_gap) noexcept;

}  // namespace packstone::rsa
