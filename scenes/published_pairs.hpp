#pragma once

/// @file
/// The pairs of figures 15 to 29 of V. Salnikov, D. Choi, P. Karamian-Surville, Comput. Mech. 55
/// (2015) 127-144. The paper shows pictures with captions and no numbers; sizes and places are
/// ours, chosen so that the types of intersection are those of the captions.

#include <array>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone::scenes {

/// Two bodies that overlap.
struct PublishedPair {
  int figure;
  Body a;
  Body b;
  Vec3 r_ab;  ///< Center of b minus center of a.
};

/// Figures 15 to 29, in this order.
[[nodiscard]] const std::array<PublishedPair, 15>& published_pairs();

/// The one of this figure, 15 to 29.
[[nodiscard]] const PublishedPair& published_pair(int figure);

}  // namespace packstone::scenes
