#pragma once

/// @file
/// Newton steps in the plane that bring the shapes and measures of all cells to those ordered.
///
/// Let y be the place relative to the centroid of a cell, along the axes of the ordered ellipse and
/// over its semi-axes, and N the integral of y y^T over the cell. Aspect and axes are as ordered if
/// and only if N is a multiple of the identity,
///
///     r_1 = sqrt(2) (N_xx - N_yy) / trace(N) = 0      r_2 = sqrt(2) 2 N_xy / trace(N) = 0    (1)
///
/// and the measure is if r_3 = V / target - 1 = 0. When a parameter moves the edge between sites i
/// and j at x outward by v(x), the integral of f over the cell changes by that of f v along the
/// edge. The powers of i and j are equal on it, so that
///
///     v = (x - p_i).e / |p_j - p_i| when p_i moves along e,    1 / (2 |p_j - p_i|) when w_i grows
///     (2)
///
/// and for (1), as the move of the centroid is of second order,
///
///     f_k = (sqrt(2) q_k(y) - r_k |y|^2) / trace(N),    q_1 = y_x^2 - y_y^2,    q_2 = 2 y_x y_y
///     (3)
///
/// f v is a cubic, for which two Gauss points are exact. Sites that moved one by one would fray the
/// cells; those of one grain move along a few modes, Legendre polynomials of their y_x times a
/// displacement along either axis or a weight, in units of the shorter ordered semi-axis. With J
/// the derivatives of r by the modes, a step is
///
///     -J^T (J J^T + damping I)^-1 r                                                          (4)
///
/// the least one for what it takes back (Levenberg and Marquardt).

#include <array>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/structure/tessellation.hpp"
#include "tessellate/laguerre/cell_sums.hpp"
#include "tessellate/laguerre/interfaces.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// What the cells are to be.
struct ShapeGoal {
  std::vector<CellShape> shapes;  ///< Aspect and axes; their sizes are those of modes.
  std::vector<double> measures;
};

/// One step (4) of all sites. Of a cell in parts the shape of the largest one counts. No site moves
/// by more than 0.3 of the shorter semi-axis of its grain, all of one grain shortened alike.
///
/// Cost: linear in the edges, and at most 60 iterations of conjugate gradients.
///
/// @param centers  The points that `sums`, those of `sites`, are about.
void shape_step(const Cell& box, const ShapeGoal& goal, const std::vector<Vec3>& centers,
                const CellSums& sums, const std::vector<Interface>& interfaces, double damping,
                std::vector<Site>& sites);

/// r_1 and r_2 of (1) [-], and r_3.
[[nodiscard]] std::array<double, 3> shape_residual(const CellShape& ordered, double target,
                                                   const CellMoments& cell);

}  // namespace packstone::laguerre
