#pragma once

/// @file
/// The bodies that balls are put into, as what can be stretched, turned and moved.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// One body of those that share the box.
struct Grain {
  Vec3 center;  ///< [L]; not brought back into the box when it leaves.
  Body body;
  double weight = 0.0;  ///< Added to those of its balls [L^2].
};

/// The inclusions, each length times `factor`.
[[nodiscard]] std::vector<Grain> grains_of(const Packing& packing, double factor);

[[nodiscard]] std::vector<Vec3> centers_of(const std::vector<Grain>& grains);

/// The balls of all grains, those of one after each other, grains in curve_order().
[[nodiscard]] std::vector<Site> sites_of(const Cell& box, const std::vector<Grain>& grains,
                                         double spacing);

/// Logarithms of the semi-axes of a shape over their geometric mean, as a tensor of trace 0 with
/// the axes of the shape; in 2D (ln aspect / 2) (cos 2a, sin 2a) as xx = -yy and xy.
[[nodiscard]] SymMat3 log_shape(int dimension, const CellShape& shape) noexcept;

/// The ellipse or ellipsoid of this measure and log_shape().
[[nodiscard]] Body body_of_log_shape(int dimension, double measure, const SymMat3& log_shape);

}  // namespace packstone::laguerre
