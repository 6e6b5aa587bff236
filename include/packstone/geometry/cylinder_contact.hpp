#pragma once

/// @file
/// Decisions about two cylinders, and about a cylinder and a spherocylinder.
///
/// In stages, cheapest first; each stage proves its verdict or passes the pair on:
///
/// 1. The line of centers: reject by g(r/|r|) > 0, accept by the point of the line where the gauges
///    of both bodies are equal, when they are below 1.
/// 2. The nearest points of the two axis segments, distance D apart: reject by g along the line
///    that joins them (certain when D exceeds both radii), accept by the middle of what two balls
///    about them share, for nearly parallel axes also a little inward of it.
/// 3. The axes as directions: reject.
/// 4. The search that any convex pair gets.
///
/// The stages follow J. Ketchel, P. Larochelle, "Collision detection of cylindrical rigid bodies
/// for motion planning", IEEE Int. Conf. Robotics Automat. (2006) 1530-1535, in what they test; the
/// disk tests there are replaced by stage 4, which is exact.

#include "packstone/geometry/contact.hpp"

namespace packstone {

[[nodiscard]] Decision decide(const Cylinder& a, const Cylinder& b, const Vec3& r_ab,
                              double min_gap) noexcept;
[[nodiscard]] Decision decide(const Cylinder& a, const Spherocylinder& b, const Vec3& r_ab,
                              double min_gap) noexcept;

/// Along the line of centers and the line that joins the axis segments.
[[nodiscard]] double quick_gap_bound(const Cylinder& a, const Cylinder& b,
                                     const Vec3& r_ab) noexcept;
[[nodiscard]] double quick_gap_bound(const Cylinder& a, const Spherocylinder& b,
                                     const Vec3& r_ab) noexcept;

}  // namespace packstone
