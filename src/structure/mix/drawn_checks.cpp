#include "structure/mix/drawn_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"
#include "structure/mix/group_checks.hpp"
#include "structure/mix/sentences.hpp"

namespace packstone::mix {
namespace {

using std::numbers::pi;

constexpr double kMostPeriods = 500;  // what check_packing() takes

// One of each pair of opposite images that a body of the given reach may meet, the origin left out.
std::vector<std::array<int, 3>> half_of_images(const Cell& cell, double reach) {
  std::array<int, 3> most{0, 0, 0};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (!cell.periodic[axis]) continue;
    // Fibers of more than 64 periods are left to the placement, which meets the rest.
    most[axis] = static_cast<int>(std::min(64.0, std::ceil(reach / cell.size[axis]) - 1.0));
  }
  std::vector<std::array<int, 3>> images;
  for (int i = 0; i <= most[0]; ++i) {
    for (int j = i == 0 ? 0 : -most[1]; j <= most[1]; ++j) {
      for (int k = i == 0 && j == 0 ? 1 : -most[2]; k <= most[2]; ++k) images.push_back({i, j, k});
    }
  }
  return images;
}

// A centrally symmetric body meets its image at s exactly when s / 2 lies inside it.
void check_own_images(const Cell& cell, const Body& body) {
  const double reach = 2.0 * circum_radius(body);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (!cell.periodic[axis] || reach <= kMostPeriods * cell.size[axis]) continue;
    throw InvalidArgument(lengths_text({body}) + " is longer than 500 periods of the cell along " +
                          "xyz"[axis] + ", allowed are 500");
  }
  if (reach <= std::min({cell.size.x, cell.size.y, cell.dimension == 2 ? reach : cell.size.z})) {
    return;
  }
  std::array<int, 3> nearest{};
  double least = std::numeric_limits<double>::infinity();
  for (const std::array<int, 3>& image : half_of_images(cell, reach)) {
    const Vec3 shift = image_shift(cell, image);
    if (norm_sq(shift) >= least || !contains(body, 0.5 * shift)) continue;
    least = norm_sq(shift);
    nearest = image;
  }
  if (!std::isfinite(least)) return;
  throw InvalidArgument(lengths_text({body}) + " overlaps its own periodic image [" +
                        std::to_string(nearest[0]) + ", " + std::to_string(nearest[1]) + ", " +
                        std::to_string(nearest[2]) + "]; make it smaller or the cell larger");
}

void check_walls(const Cell& cell, const Body& body) {
  const Vec3 half = half_extents(body);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (cell.periodic[axis] || 2.0 * half[axis] <= cell.size[axis] * (1.0 + 1e-12)) continue;
    throw InvalidArgument(lengths_text({body}) + ", turned as drawn, is " +
                          number_text(2.0 * half[axis]) + " wide along " + "xyz"[axis] +
                          ", allowed between the walls is " + number_text(cell.size[axis]));
  }
}

// Highest fraction that bodies all congruent can have at all.
double densest(ShapeKind shape) {
  switch (shape) {
    case ShapeKind::sphere:
      return pi / std::sqrt(18.0);
    case ShapeKind::disk:
    case ShapeKind::ellipse:
      return pi / std::sqrt(12.0);
    default:
      return 1.0;
  }
}

bool all_congruent(const std::vector<OrderedBody>& bodies) {
  const Vec3 first = lengths_of(bodies.front().body);
  return std::all_of(bodies.begin(), bodies.end(), [&](const OrderedBody& b) {
    return kind(b.body) == kind(bodies.front().body) && lengths_of(b.body) == first;
  });
}

}  // namespace

void check_bodies(const Cell& cell, const InclusionGroup& group, int index,
                  const std::vector<Body>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    try {
      check_walls(cell, bodies[i]);
      check_own_images(cell, bodies[i]);
    } catch (const InvalidArgument& problem) {
      refuse(label(group, index) + ": inclusion " + std::to_string(i), problem.what());
    }
  }
}

void check_total(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  if (bodies.empty()) return;
  CompensatedSum sum;
  for (const OrderedBody& b : bodies) sum.add(volume(b.body));
  const double reached = sum.value() / volume(cell);
  if (reached >= 1.0) {
    throw InvalidArgument("the inclusions ask for fraction " + number_text(reached) +
                          " in total, allowed are totals < 1");
  }
  const ShapeKind shape = kind(bodies.front().body);
  const double bound = densest(shape);
  // Rounding of the sizes apart.
  if (reached <= bound * (1.0 + 1e-12) || !all_congruent(bodies)) return;
  throw InvalidArgument("equal inclusions of the shape " + std::string(name(shape)) +
                        " ask for fraction " + number_text(reached) +
                        ", allowed are fractions <= " + number_text(bound) +
                        ", the densest packing there is");
}

void check_ordered_fractions(const std::vector<InclusionGroup>& groups) {
  double sum = 0.0;
  for (const InclusionGroup& group : groups) sum += group.fraction.value_or(0.0);
  if (sum < 1.0) return;
  throw InvalidArgument("the fractions of the groups sum to " + number_text(sum) +
                        ", allowed are sums < 1");
}

}  // namespace packstone::mix
