#pragma once

/// @file
/// Triangles: flat surfaces as a ray sees them.

#include <array>
#include <vector>

#include "packstone/core/vec.hpp"

namespace packstone::draw {

/// Triangles that share points; both sides look alike.
struct Triangles {
  std::vector<Vec3> points;
  std::vector<std::array<unsigned, 3>> corners;  ///< Indices into points.
  std::vector<Vec3> colors;                      ///< One per triangle, linear RGB.
};

}  // namespace packstone::draw
