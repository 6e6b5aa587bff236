#include "tessellate/laguerre/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "packstone/geometry/equal_ball.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::laguerre {
namespace {

// Below this aspect an axis means little.
constexpr double kElongated = 1.05;

struct MeanAndSpread {
  double mean = 0.0;
  double spread = 0.0;
};

MeanAndSpread mean_and_spread(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  MeanAndSpread m;
  for (const double x : values) m.mean += x / count;
  for (const double x : values) m.spread += (x - m.mean) * (x - m.mean) / count;
  m.spread = std::sqrt(m.spread);
  return m;
}

double percentile_95(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 95 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// What is compared, cell by cell.
struct Ratios {
  std::vector<double> measures;  // Over what was ordered, times a common factor.
  std::vector<double> aspects;
  std::vector<double> angles;
  std::vector<double> offsets;
};

// Of the centroid from the center of the inclusion, whatever images they stand in, over the radius
// of the ball of the measure of the cell.
double offset_of(const Cell& box, const Vec3& center, const CellShape& shape) {
  const double radius = equal_ball_radius(box.dimension, shape.measure);
  Vec3 off = shape.centroid - center;
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.periodic[a]) off[a] -= box.size[a] * std::round(off[a] / box.size[a]);
  }
  return norm(off) / radius;
}

Ratios ratios_of(const Packing& packing, const std::vector<CellShape>& shapes,
                 const std::vector<char>& counts) {
  Ratios ratios;
  double made = 0.0, ordered = 0.0;
  for (std::size_t g = 0; g < shapes.size(); ++g) {
    if (counts[g] == 0) continue;
    const CellShape order = shape_of_body(packing.inclusions[g].body);
    made += shapes[g].measure;
    ordered += order.measure;
    ratios.measures.push_back(shapes[g].measure / order.measure);
    if (shapes[g].measure > 0.0) {
      ratios.offsets.push_back(offset_of(packing.cell, packing.inclusions[g].center, shapes[g]));
    }
    if (order.aspect < kElongated || shapes[g].measure <= 0.0) continue;
    ratios.aspects.push_back(shapes[g].aspect / order.aspect);
    ratios.angles.push_back(angle_between_shapes(packing.cell.dimension, order, shapes[g]));
  }
  for (double& ratio : ratios.measures) ratio *= ordered / made;
  return ratios;
}

}  // namespace

LaguerreErrors errors_of(const Packing& packing, const std::vector<CellShape>& shapes,
                         const std::vector<int>& parts, const std::vector<char>& counts) {
  const Ratios ratios = ratios_of(packing, shapes, counts);
  LaguerreErrors errors;
  errors.cells = static_cast<std::int64_t>(ratios.measures.size());
  errors.measure_spread = mean_and_spread(ratios.measures).spread;
  for (const double ratio : ratios.measures) {
    errors.largest_measure_error = std::max(errors.largest_measure_error, std::abs(ratio - 1.0));
  }
  errors.elongated = static_cast<std::int64_t>(ratios.aspects.size());
  if (errors.elongated > 0) {
    errors.aspect_mean = mean_and_spread(ratios.aspects).mean;
    errors.aspect_spread = mean_and_spread(ratios.aspects).spread;
  }
  errors.offset_mean = mean_and_spread(ratios.offsets).mean;
  for (const double offset : ratios.offsets) {
    errors.largest_offset = std::max(errors.largest_offset, offset);
  }
  errors.angle_mean = mean_and_spread(ratios.angles).mean;
  errors.angle_p95 = percentile_95(ratios.angles);
  errors.empty = std::count(parts.begin(), parts.end(), 0);
  errors.in_parts = static_cast<std::int64_t>(parts.size()) - errors.empty -
                    std::count(parts.begin(), parts.end(), 1);
  return errors;
}

}  // namespace packstone::laguerre
