#pragma once

/// @file
/// Linear systems with the Laplacian of a weighted graph.

#include <vector>

#include "tessellate/laguerre/cell_sums.hpp"

namespace packstone::laguerre {

/// Solves sum_b c_ab (x_a - x_b) = r_a over the couplings c, with x = 0 for the first owner. The
/// sum of `right` over a connected graph has to be 0; an owner without couplings gets 0. Empty when
/// the system could not be solved.
///
/// @param dimension  2: by a sparse Cholesky factorization; 3, where that fills up: by conjugate
///                   gradients with an incomplete one.
[[nodiscard]] std::vector<double> solve_laplacian(const std::vector<Coupling>& couplings,
                                                  const std::vector<double>& right, int dimension);

}  // namespace packstone::laguerre
