#pragma once

/// @file
/// Planes between two bodies at one instant: any one that separates them is a proof, the best one
/// has the gap.

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/plane_bound.hpp"
#include "geometry/posed_body.hpp"

namespace packstone::event_driven {

/// `factor` is the size factor.
[[nodiscard]] PosedBody posed(const Bodies& bodies, std::int32_t i, const Pose& pose,
                              double factor);

/// How well a plane is to be found.
enum class Effort {
  step,   ///< From the plane that is known, as well as the next stretch of time needs it.
  touch,  ///< As well as the contact of touching bodies needs it.
};

/// The normal of a plane between two bodies, from a to b, not unit; a better one than the one that
/// is known (0: none). r from the center of a to that of b.
[[nodiscard]] Vec3 find_plane(const PosedBody& a, const PosedBody& b, const Vec3& r, double min_gap,
                              const Vec3& known, Effort effort);

/// How the normal has to turn so that the plane stays with the edges and flat sides that it rests
/// on: across `normal`; 0 where both bodies are smooth there.
[[nodiscard]] Vec3 normal_rate(const PosedBody& a, const PosedBody& b, const Vec3& angular_a,
                               const Vec3& angular_b, const Vec3& normal);

/// A lower bound on the gap, from a few planes [L].
[[nodiscard]] double gap_bound(const PosedBody& a, const PosedBody& b, const Vec3& r);

}  // namespace packstone::event_driven
