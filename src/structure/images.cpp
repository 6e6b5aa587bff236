#include "packstone/structure/images.hpp"

#include <cmath>

#include "packstone/geometry/bounds.hpp"

namespace packstone {

std::vector<std::array<int, 3>> images_in_cell(const Cell& cell, const Inclusion& inclusion) {
  const Vec3 half = half_extents(inclusion.body);
  std::array<int, 3> low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!cell.periodic[axis]) continue;
    const double length = cell.size[axis];
    const double x = inclusion.center[axis];
    low[axis] = static_cast<int>(std::ceil((-half[axis] - x) / length));
    high[axis] = static_cast<int>(std::floor((length + half[axis] - x) / length));
  }
  std::vector<std::array<int, 3>> images;
  for (int i = low[0]; i <= high[0]; ++i) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int k = low[2]; k <= high[2]; ++k) images.push_back({i, j, k});
    }
  }
  return images;
}

}  // namespace packstone
