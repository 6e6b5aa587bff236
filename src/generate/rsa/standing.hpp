#pragma once

/// @file
/// What trials ask of a center and of a turned body: inside the walls, and clear of own images?

#include "generate/rsa/placed_bodies.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone::rsa {

using packstone::CenterBox;
using packstone::centers_inside_walls;

[[nodiscard]] bool is_inside(const CenterBox& box, const Vec3& center, int dimension) noexcept;

/// Is the body proven to keep more than `min_gap` to each of its own periodic images?
[[nodiscard]] bool clears_own_images(const Cell& cell, const Candidate& candidate, double min_gap);

/// Is the body proven not to: does it come within `min_gap` of an own image?
[[nodiscard]] bool meets_own_image(const Cell& cell, const Candidate& candidate, double min_gap);

}  // namespace packstone::rsa
