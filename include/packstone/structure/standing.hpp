#pragma once

/// @file
/// What stands nowhere: bodies that the cell cannot hold even alone, and orders that need more
/// room than there is. Asked before any work, by whoever places bodies.

#include <optional>
#include <string>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone {

/// Centers that a box of half edges `half_extents` may have: [0, size] along periodic axes, what
/// the walls leave along the others. Empty (lo > hi along an axis) where the walls leave nothing.
struct CenterBox {
  Vec3 lo;
  Vec3 hi;
};
[[nodiscard]] CenterBox centers_inside_walls(const Cell& cell, const Vec3& half_extents) noexcept;

/// How a body may be turned.
enum class Turn {
  as_given,  ///< Not at all.
  any,       ///< At will: only what holds for every orientation counts.
};

/// Why `body` cannot stand in the empty `cell`, wherever its center is; nothing if it can.
///
/// It must fit between the walls with room to spare, be proven to keep more than `min_gap` [L] to
/// each of its own periodic images, and not have more of those than kMostOwnImages. The reason is
/// a sentence about "it": "with diameter 1.2 it overlaps its own periodic image [0, 0, 1]; ...".
[[nodiscard]] std::optional<std::string> why_it_cannot_stand(const Cell& cell, const Body& body,
                                                             double min_gap, Turn turn);

/// Throws InvalidGroup for the first body that cannot stand. `redrawn`: per group, whether its
/// bodies may be turned; empty: none.
void check_standing(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap,
                    const std::vector<bool>& redrawn = {});

/// Throws InvalidGroup, naming the group of the largest total volume, when the bodies need more
/// room than the cell has: each with the shell of half of `min_gap` [L] around it, which no other
/// one enters (by Steiner's formula at least V + S t + 4/3 pi t^3, in the plane A + P t + pi t^2);
/// or when they are congruent and would be denser than any packing of their like: spheres
/// pi / sqrt(18) (T. C. Hales, Ann. Math. 162 (2005) 1065-1185), disks and ellipses pi / sqrt(12)
/// (L. Fejes Toth, Acta Sci. Math. Szeged 12 A (1950) 62-67).
void check_room(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap);

}  // namespace packstone
