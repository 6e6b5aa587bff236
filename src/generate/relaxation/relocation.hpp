#pragma once

/// @file
/// Bodies that push each other without a way out are moved elsewhere.

#include <cstdint>
#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "generate/relaxation/overlap_energy.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/random.hpp"

namespace packstone::relaxation {

/// Moves one of each of the pairs that overlap the most, at most `share` of all bodies and at least
/// one, to the best of some random places, turned as they are. Returns how many.
///
/// Two needles that cross deep inside a cage of others are pushed into each other by it: a local
/// minimum that no descent leaves.
std::int64_t relocate(Bodies& bodies, const Cell& cell, std::vector<Push> pushes, double share,
                      RandomStream& random);

}  // namespace packstone::relaxation
