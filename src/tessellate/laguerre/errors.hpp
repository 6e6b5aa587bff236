#pragma once

/// @file
/// How cells differ from what was ordered.

#include <vector>

#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"
#include "packstone/tessellate/laguerre.hpp"

namespace packstone::laguerre {

/// @param parts   Of each cell: how many connected parts it has.
/// @param counts  Of each cell: whether it counts; see LaguerreErrors.
[[nodiscard]] LaguerreErrors errors_of(const Packing& packing, const std::vector<CellShape>& shapes,
                                       const std::vector<int>& parts,
                                       const std::vector<char>& counts);

}  // namespace packstone::laguerre
