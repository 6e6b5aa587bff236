#pragma once

/// @file
/// The neighbors of one body side by side in vector registers: most of them are seen there to stay
/// away.
///
/// For balls the lanes find the time of contact itself. For bodies of revolution they take one
/// plane between each pair and evaluate the bound of plane_bound.hpp (with a plane that does not
/// turn) now and at the horizon; what it clears needs no search. The plane is that of Perram and
/// Wertheim's l as it was left in the neighbor, moved on by one Newton step (revolution_pair.hpp).
///
/// The lanes are computed alike on every processor, eight at a time: where its registers are
/// narrower, two or four do for one. No fused operations, so the bits are the same.

#include <array>
#include <cstdint>
#include <span>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/reference_lanes.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::event_driven {

/// A neighbor that was not cleared.
struct Suspect {
  std::int32_t neighbor = 0;  ///< Its place in the list.
  /// Balls: when they touch. Otherwise how long from now they stay apart for certain, as a concave
  /// bound says that lies above its chord [T].
  double time = 0.0;
  double l = 0.0;  ///< Perram and Wertheim's, of the plane that was tried; not of balls.
};

struct LaneKernels;

/// Looks at all neighbors of a body at once.
class PairLanes {
 public:
  static constexpr std::size_t kLanes = 8;

  /// Can the lanes do these bodies?
  enum class Kind { none, balls, revolution };
  static Kind kind_of(const Bodies& bodies);

  PairLanes(const Bodies& bodies, const Cell& cell, const LaneKernels& kernels);

  [[nodiscard]] Kind kind() const { return kind_; }

  /// Fills `suspects` (room for one per neighbor, rounded up to whole lanes) with those neighbors
  /// that may touch body i, itself standing at clock t, before `horizon` and before the neighbor's
  /// own next event in `times`. Returns their number. Balls: `least_gap` becomes the least one seen
  /// where that is below.
  std::size_t look(std::int32_t i, double t, double horizon, const double* times,
                   std::span<Neighbor> neighbors, Suspect* suspects, double& least_gap) const;

 private:
  const Bodies& bodies_;
  Vec3 edges_;
  double coordinate_gap_;
  Kind kind_;
  const LaneKernels& kernels_;
};

}  // namespace packstone::event_driven
