#include "spatial/curve_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace packstone {
namespace {

// Spreads the 21 lowest bits three places apart.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffffU;
  x = (x | x << 32U) & 0x1f00000000ffffU;
  x = (x | x << 16U) & 0x1f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

std::uint64_t place_on_curve(const Vec3& center, const Cell& cell) {
  constexpr double kSteps = 0x1p20;
  std::uint64_t key = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    const double part = center[a] / cell.size[a];
    const double inside = part - std::floor(part);
    key |= spread(static_cast<std::uint64_t>(kSteps * inside)) << a;
  }
  return key;
}

}  // namespace

std::vector<std::int32_t> curve_order(const std::vector<Vec3>& points, const Cell& cell) {
  std::vector<std::uint64_t> key;
  key.reserve(points.size());
  for (const Vec3& point : points) key.push_back(place_on_curve(point, cell));
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const std::uint64_t of_a = key[static_cast<std::size_t>(a)];
    const std::uint64_t of_b = key[static_cast<std::size_t>(b)];
    return of_a < of_b || (of_a == of_b && a < b);
  });
  return order;
}

}  // namespace packstone
