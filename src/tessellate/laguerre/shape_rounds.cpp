#include "tessellate/laguerre/shape_rounds.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/geometry/measures.hpp"

namespace packstone::laguerre {
namespace {

// How far the drawn shape may be from the one ordered, as the norm of the difference: 0.5 is twice
// the aspect in the plane. Longer bodies reach into cells that are not next to their own.
constexpr double kMostStretch = 0.5;

// What is left of that where a cell has come apart.
constexpr double kTakenBack = 0.5;

constexpr double kRounding = 1e-9;

double norm_of(const SymMat3& s) {
  return std::sqrt(s.xx * s.xx + s.yy * s.yy + s.zz * s.zz +
                   2.0 * (s.yz * s.yz + s.xz * s.xz + s.xy * s.xy));
}

}  // namespace

Order order_of(int dimension, const std::vector<Grain>& grains) {
  Order order;
  for (const Grain& grain : grains) {
    order.log_shapes.push_back(log_shape(dimension, shape_of_body(grain.body)));
    order.measures.push_back(volume(grain.body));
  }
  return order;
}

void correct_shapes(int dimension, const CellSums& sums, const Order& order,
                    const LaguerreOptions& options, std::vector<SymMat3>& drawn,
                    std::vector<Grain>& grains) {
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const CellMoments& cell = options.connected ? sums.bodies[g] : sums.cells[g];
    if (cell.measure <= 0.0) continue;
    const Vec3 off = cell.first / cell.measure;
    const CellShape shape =
        shape_of_moments(dimension, cell.measure, off, cell.second - cell.measure * dyad(off));
    if (!(shape.semi_axes[static_cast<std::size_t>(dimension) - 1] > 0.0)) continue;
    const SymMat3& ordered = order.log_shapes[g];
    SymMat3 beyond =
        drawn[g] - ordered + options.shape_gain * (ordered - log_shape(dimension, shape));
    const bool in_parts = sums.cells[g].measure > (1.0 + kRounding) * sums.bodies[g].measure;
    if (options.connected && in_parts) beyond = kTakenBack * beyond;
    drawn[g] = ordered + std::min(1.0, kMostStretch / norm_of(beyond)) * beyond;
    grains[g].center += options.center_gain * off;
    grains[g].body = body_of_log_shape(dimension, order.measures[g], drawn[g]);
  }
}

}  // namespace packstone::laguerre
