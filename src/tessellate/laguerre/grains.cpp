#include "tessellate/laguerre/grains.hpp"

#include <cmath>

#include "packstone/core/symmetric_eigen.hpp"
#include "packstone/geometry/equal_ball.hpp"
#include "packstone/geometry/inscribed_balls.hpp"
#include "packstone/geometry/measures.hpp"
#include "spatial/curve_order.hpp"

namespace packstone::laguerre {

std::vector<Grain> grains_of(const Packing& packing, double factor) {
  std::vector<Grain> grains;
  grains.reserve(packing.inclusions.size());
  for (const Inclusion& inclusion : packing.inclusions) {
    grains.push_back({inclusion.center, scaled(inclusion.body, factor), 0.0});
  }
  return grains;
}

std::vector<Vec3> centers_of(const std::vector<Grain>& grains) {
  std::vector<Vec3> centers;
  centers.reserve(grains.size());
  for (const Grain& grain : grains) centers.push_back(grain.center);
  return centers;
}

std::vector<Site> sites_of(const Cell& box, const std::vector<Grain>& grains, double spacing) {
  std::vector<Site> sites;
  for (const std::int32_t g : curve_order(centers_of(grains), box)) {
    const Grain& grain = grains[static_cast<std::size_t>(g)];
    for (const InscribedBall& ball : inscribed_balls(grain.body, spacing)) {
      sites.push_back(wrapped_site(box, grain.center + ball.center,
                                   ball.radius * ball.radius + grain.weight, g));
    }
  }
  return sites;
}

SymMat3 log_shape(int dimension, const CellShape& shape) noexcept {
  const Vec3 axes[] = {shape.axes.col_x, shape.axes.col_y, shape.axes.col_z};
  Vec3 logs;
  double mean = 0.0;
  const auto count = static_cast<std::size_t>(dimension);
  for (std::size_t k = 0; k < count; ++k) mean += (logs[k] = std::log(shape.semi_axes[k]));
  mean /= dimension;
  SymMat3 sum;
  for (std::size_t k = 0; k < count; ++k) sum = sum + (logs[k] - mean) * dyad(axes[k]);
  return sum;
}

Body body_of_log_shape(int dimension, double measure, const SymMat3& s) {
  const double size = equal_ball_radius(dimension, measure);
  if (dimension == 2) {
    const double stretch = std::exp(std::hypot(0.5 * (s.xx - s.yy), s.xy));
    return Ellipse{{size * stretch, size / stretch}, 0.5 * std::atan2(2.0 * s.xy, s.xx - s.yy)};
  }
  const SymmetricEigen eigen = symmetric_eigen(s);
  Vec3 semi_axes;
  for (std::size_t k = 0; k < 3; ++k) semi_axes[k] = size * std::exp(eigen.values[k]);
  return Ellipsoid{semi_axes, from_matrix(eigen.vectors)};
}

}  // namespace packstone::laguerre
