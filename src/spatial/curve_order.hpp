#pragma once

/// @file
/// Points in an order in which those that are close in the cell are close in memory: who looks at a
/// body then looks at its neighbors, which share pages and cache lines with it.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// The numbers of the points, inside the cell or not, along a Z-curve (G. M. Morton, 1966) through
/// the cell.
[[nodiscard]] std::vector<std::int32_t> curve_order(const std::vector<Vec3>& points,
                                                    const Cell& cell);

}  // namespace packstone
