#pragma once

/// @file
/// Weights for which every cell has the measure that it should have.
///
/// One number D_g is added to the weights of all sites of each owner g. The measures V_g(D) are the
/// gradient of a concave function of D up to a linear one, so that D with V(D) = target exists and
/// is unique up to a constant; it is the semi-discrete optimal transport of the uniform measure to
/// the owners (F. Aurenhammer, F. Hoffmann, B. Aronov, Algorithmica 20 (1998) 61-76). With a_ij the
/// measure of the facet between sites i and j and d_ij their distance,
///
///     dV_g / dD_h = - sum a_ij / (2 d_ij)  over facets between g and h,  g /= h            (1)
///
/// with the negative sum of these as dV_g / dD_g: the Laplacian of a graph. Newton's method with
/// steps halved until no cell is small and the error has come down as it should converges from
/// wherever no cell is empty (J. Kitagawa, Q. Merigot, B. Thibert, J. Eur. Math. Soc. 21 (2019)
/// 2603-2651); D. P. Bourne et al., Phil. Mag. 100 (2020) 2677-2707, for grains of one site each.

#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "tessellate/laguerre/cell_sums.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// When transport() may stop.
struct TransportGoal {
  double tolerance = 1e-9;  ///< Largest |V / target - 1| [-].
  int max_steps = 100;      ///< Of Newton's method.
};

/// How transport() ended.
struct TransportOutcome {
  bool reached = false;  ///< Within the tolerance.
  double error = 0.0;    ///< Largest |V / target - 1| [-].
  int steps = 0;         ///< Of Newton's method.
  int evaluations = 0;   ///< Diagrams made.
  CellSums sums;         ///< Of the sites as they are now.
};

/// Adds to the weights of `sites`, the same number for each owner, so that cell g has the measure
/// targets[g]; these have to sum to the measure of the box.
[[nodiscard]] TransportOutcome transport(const Cell& box, std::vector<Site>& sites,
                                         const std::vector<Vec3>& centers,
                                         const std::vector<double>& targets,
                                         const TransportGoal& goal, const RunContext& run);

}  // namespace packstone::laguerre
