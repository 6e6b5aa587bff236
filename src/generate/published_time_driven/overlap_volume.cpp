#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

// How many bodies hold each point of a lattice over the cell.
class CoverCount {
 public:
  CoverCount(const Cell& cell, int points)
      : cell_(cell), points_(points), counts_(static_cast<std::size_t>(points) * points * points) {}

  void add(const Inclusion& inclusion) {
    const Vec3 half = half_extents(inclusion.body);
    for (const std::array<int, 3>& image : images_in_cell(cell_, inclusion)) {
      add_image(inclusion.body, inclusion.center + image_shift(cell_, image), half);
    }
  }

  // Points in excess of one body, on each of the eight lattices of twice the spacing.
  [[nodiscard]] std::array<double, 8> excess() const {
    std::array<double, 8> sums{};
    std::size_t index = 0;
    for (int z = 0; z < points_; ++z) {
      for (int y = 0; y < points_; ++y) {
        for (int x = 0; x < points_; ++x, ++index) {
          const auto lattice = static_cast<std::size_t>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
          if (counts_[index] > 1) sums[lattice] += counts_[index] - 1;
        }
      }
    }
    return sums;
  }

 private:
  // Off the middle by irrational parts, so that symmetric packings do not meet the lattice in step.
  [[nodiscard]] double place(std::size_t axis, int index) const {
    constexpr double shift[] = {0.7548776662466927, 0.5698402909980532, 0.4301597090019468};
    return cell_.size[axis] * (index + shift[axis]) / points_;
  }

  [[nodiscard]] int first(std::size_t axis, double x) const {
    const double at = std::ceil(x / cell_.size[axis] * points_ - 1.0);
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(points_)));
  }

  void add_image(const Body& body, const Vec3& center, const Vec3& half) {
    std::array<int, 3> lo{}, hi{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = first(axis, center[axis] - half[axis]);
      hi[axis] = std::min(points_, first(axis, center[axis] + half[axis]) + 1);
    }
    for (int z = lo[2]; z < hi[2]; ++z) {
      for (int y = lo[1]; y < hi[1]; ++y) {
        const std::size_t row = (static_cast<std::size_t>(z) * points_ + y) * points_;
        for (int x = lo[0]; x < hi[0]; ++x) {
          const Vec3 point{place(0, x), place(1, y), place(2, z)};
          if (contains(body, point - center)) ++counts_[row + x];
        }
      }
    }
  }

  const Cell& cell_;
  int points_;
  std::vector<std::uint16_t> counts_;
};

}  // namespace

OverlapVolume overlap_volume(const Packing& packing, int points) {
  if (packing.cell.dimension != 3) throw InvalidArgument("Cell::dimension is 2; it must be 3");
  if (points < 2 || points > 512 || points % 2 != 0) {
    throw InvalidArgument(fmt::format("points is {}; it must be even, in [2, 512]", points));
  }
  CoverCount cover(packing.cell, points);
  for (const Inclusion& inclusion : packing.inclusions) cover.add(inclusion);
  const double share = 8.0 * volume(packing.cell) / std::pow(points, 3);
  const std::array<double, 8> sums = cover.excess();
  double mean = 0.0, scatter = 0.0;
  for (const double sum : sums) mean += share * sum / 8.0;
  for (const double sum : sums) scatter += (share * sum - mean) * (share * sum - mean) / 7.0;
  return {mean, std::sqrt(scatter / 8.0)};
}

}  // namespace packstone
