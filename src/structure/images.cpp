#include "packstone/structure/images.hpp"

#include <cmath>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/bounds.hpp"

namespace packstone {

std::vector<std::array<int, 3>> images_in_cell(const Cell& cell, const Inclusion& inclusion) {
  const Vec3 half = half_extents(inclusion.body);
  std::array<int, 3> low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!cell.periodic[axis]) continue;
    const double length = cell.size[axis];
    const double x = inclusion.center[axis];
    const double reach = half[axis] + 1e-12 * (half[axis] + length);
    low[axis] = static_cast<int>(std::ceil((-reach - x) / length));
    high[axis] = static_cast<int>(std::floor((length + reach - x) / length));
  }
  std::vector<std::array<int, 3>> images;
  for (int i = low[0]; i <= high[0]; ++i) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int k = low[2]; k <= high[2]; ++k) images.push_back({i, j, k});
    }
  }
  return images;
}

std::optional<std::string> why_no_least_gap(const Cell& cell, double min_gap) {
  const double shortest = shortest_period(cell);
  if (min_gap >= 0.0 && min_gap < shortest) return std::nullopt;
  if (!std::isfinite(shortest)) return "allowed are finite numbers >= 0";
  return "allowed are numbers >= 0 and below " + number_text(shortest) +
         ", the shortest period of the cell";
}

std::optional<std::string> why_too_many_own_images(const Cell& cell, const Vec3& half_extents) {
  double images = 1.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (!cell.periodic[axis]) continue;
    const double periods = 2.0 * half_extents[axis] / cell.size[axis];
    images *= 2.0 * periods + 1.0;
    if (periods <= kMostPeriods && images <= kMostOwnImages) continue;
    return "it is " + number_text(periods) + " periods long along " + "xyz"[axis] +
           " and may meet " + number_text(std::floor(images), 9) +
           " images of itself; allowed are " + number_text(kMostPeriods) + " periods and " +
           number_text(kMostOwnImages, 7) + " images";
  }
  return std::nullopt;
}

void check_images(const Cell& cell, std::size_t inclusion, const Vec3& half_extents) {
  if (const auto reason = why_too_many_own_images(cell, half_extents)) {
    throw InvalidArgument("inclusion " + std::to_string(inclusion) + ": " + *reason);
  }
}

void check_images(const Packing& packing) {
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    check_images(packing.cell, i, half_extents(packing.inclusions[i].body));
  }
}

}  // namespace packstone
