#pragma once

/// @file
/// The slow judge of check_packing(): all pairs over all images that can matter, no grid.

#include "packstone/structure/check_packing.hpp"

namespace packstone::test {

/// What check_packing() must say, by measuring the gap of every pair and image. pairs_checked is
/// left at 0. For packings of some ten inclusions.
[[nodiscard]] Certificate brute_force_check(const Packing& packing, double min_gap);

}  // namespace packstone::test
