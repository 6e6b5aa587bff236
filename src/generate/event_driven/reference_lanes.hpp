#pragma once

/// @file
/// How far apart are bodies that stand still? Bounds for many at once.

#include <cstdint>
#include <span>

#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// One neighbor of a body.
struct Neighbor {
  std::int32_t body = 0;              ///< Negative: a wall.
  std::int16_t image[3] = {0, 0, 0};  ///< Periods, in the coordinates of the run.
  /// What the last search left for the next one, 0 where there was none: of bodies of revolution
  /// Perram and Wertheim's l, of others the normal of a plane between them.
  float hint[3] = {0, 0, 0};
};

/// A body of revolution, at its size then. One cache line.
struct alignas(64) StandingLine {
  Vec3 center;
  Vec3 axis{0, 0, 1};
  double lateral = 0;  ///< Semi-axis across the axis [L].
  double axial = 0;    ///< Along it [L].
};

/// Lower bounds on the gaps between `own` and each of `others`, which name lines: by two steps of
/// Perram and Wertheim's search.
void bound_gaps(const StandingLine& own, const StandingLine* lines,
                std::span<const Neighbor> others, const Vec3& edges, double* gaps);

/// The same, as closely as is needed to see which gaps exceed the sum of both margins.
void bound_near_gaps(const StandingLine& own, double own_margin, const StandingLine* lines,
                     const double* margins, std::span<const Neighbor> others, const Vec3& edges,
                     double* gaps);

}  // namespace packstone::event_driven
