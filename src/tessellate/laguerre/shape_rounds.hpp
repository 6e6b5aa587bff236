#pragma once

/// @file
/// Rounds that bring the shapes of cells to those ordered.

#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/tessellate/laguerre.hpp"
#include "tessellate/laguerre/cell_sums.hpp"
#include "tessellate/laguerre/grains.hpp"

namespace packstone::laguerre {

/// What is ordered of each grain.
struct Order {
  std::vector<SymMat3> log_shapes;
  std::vector<double> measures;  ///< Of the bodies that balls are put into.
};
[[nodiscard]] Order order_of(int dimension, const std::vector<Grain>& grains);

/// One round: each body takes back a share of what its cell is off by,
///
///     S <- S + gain (S_ordered - S_cell)                                                   (1)
///
/// with S as log_shape(), and goes a part of the way to the centroid of its cell. `drawn` holds S
/// of each body. Where a cell is to be connected its largest part counts, and a body whose cell has
/// come apart takes back half of its difference from what is ordered. Cells without measure are
/// left alone.
void correct_shapes(int dimension, const CellSums& sums, const Order& order,
                    const LaguerreOptions& options, std::vector<SymMat3>& drawn,
                    std::vector<Grain>& grains);

}  // namespace packstone::laguerre
