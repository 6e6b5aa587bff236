#include "io/export/placements.hpp"

#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/geometry/bounds.hpp"

namespace packstone {
namespace {

constexpr double kMostPeriods = 100.0;

struct Range {
  int first = 0;
  int last = 0;
};

/// The shifts along one axis that bring [x - reach, x + reach] into contact with [0, length].
Range shifts(double x, double reach, double length) {
  return {static_cast<int>(std::floor(-(x + reach) / length)) + 1,
          static_cast<int>(std::ceil((length + reach - x) / length)) - 1};
}

std::array<Range, 3> shifts(const Cell& cell, std::size_t index, const Inclusion& inclusion) {
  const Vec3 reach = half_extents(inclusion.body);
  std::array<Range, 3> ranges{};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (!cell.periodic[axis]) continue;
    if (reach[axis] > kMostPeriods * cell.size[axis]) {
      throw InvalidArgument("inclusion " + std::to_string(index) +
                            " reaches over more than 100 periods: too many images");
    }
    ranges[axis] = shifts(inclusion.center[axis], reach[axis], cell.size[axis]);
  }
  return ranges;
}

void add_images(std::vector<Placement>& all, const Cell& cell, std::size_t index,
                const Inclusion& inclusion) {
  const auto [x, y, z] = shifts(cell, index, inclusion);
  for (int i = x.first; i <= x.last; ++i) {
    for (int j = y.first; j <= y.last; ++j) {
      for (int k = z.first; k <= z.last; ++k) {
        if (i == 0 && j == 0 && k == 0) continue;
        const std::array<int, 3> image{i, j, k};
        all.push_back({index, image, inclusion.center + image_shift(cell, image)});
      }
    }
  }
}

}  // namespace

std::vector<Placement> placements(const Packing& packing, bool images) {
  std::vector<Placement> all;
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    const Inclusion& inclusion = packing.inclusions[i];
    all.push_back({i, {0, 0, 0}, inclusion.center});
    if (images) add_images(all, packing.cell, i, inclusion);
  }
  return all;
}

}  // namespace packstone
