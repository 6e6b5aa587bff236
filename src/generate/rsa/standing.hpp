#pragma once

/// @file
/// May a body stand in the cell at all: inside the walls, and clear of its own images?

#include <optional>
#include <string>

#include "generate/rsa/placed_bodies.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::rsa {

/// Centers that a box of half edges `half_extents` may have: [0, size] along periodic axes, what
/// the walls leave along the others. Empty (lo > hi along an axis) where the walls leave nothing.
struct CenterBox {
  Vec3 lo;
  Vec3 hi;
};
[[nodiscard]] CenterBox centers_inside_walls(const Cell& cell, const Vec3& half_extents) noexcept;

[[nodiscard]] bool is_inside(const CenterBox& box, const Vec3& center, int dimension) noexcept;

/// Is the body proven to keep more than `min_gap` to each of its own periodic images?
[[nodiscard]] bool clears_own_images(const Cell& cell, const Candidate& candidate, double min_gap);

/// Is the body proven not to: does it come within `min_gap` of an own image?
[[nodiscard]] bool meets_own_image(const Cell& cell, const Candidate& candidate, double min_gap);

/// Why the body cannot stand in the empty cell; nothing if it can. `any_turn`: it may be turned at
/// will, so only what holds for every orientation counts.
[[nodiscard]] std::optional<std::string> why_it_cannot_stand(const Cell& cell, const Body& body,
                                                             double min_gap, bool any_turn);

}  // namespace packstone::rsa
