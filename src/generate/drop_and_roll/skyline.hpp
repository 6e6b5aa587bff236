#pragma once

/// @file
/// The height of what stands, column by column.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::rolling {

/// The highest top over every column of a lattice across the horizontal axes: from above it nothing
/// is in the way.
class Skyline {
 public:
  explicit Skyline(const Cell& cell) : cell_(cell), axes_(cell.dimension == 2 ? 1 : 2) {}

  /// A ball about `center` stands. The first one decides how wide columns are.
  void add(const Vec3& center, double radius) {
    if (tops_.empty()) lay_out(0.5 * radius);
    const double top = center[axes_] + radius;
    for_columns(center, radius, [&](std::size_t k) { tops_[k] = std::max(tops_[k], top); });
  }

  /// Above which a ball over `center` meets nothing [L].
  [[nodiscard]] double height(const Vec3& center, double radius) const {
    if (tops_.empty()) return 0.0;
    double highest = 0.0;
    for_columns(center, radius, [&](std::size_t k) { highest = std::max(highest, tops_[k]); });
    return highest;
  }

 private:
  static constexpr int kMostColumns = 4096;
  static constexpr int kMostRows = 256;

  void lay_out(double width) {
    const int most = axes_ == 1 ? kMostColumns : kMostRows;
    for (std::size_t a = 0; a < axes_; ++a) {
      count_[a] =
          static_cast<int>(std::clamp(cell_.size[a] / width, 1.0, static_cast<double>(most)));
      per_width_[a] = count_[a] / cell_.size[a];
    }
    tops_.assign(static_cast<std::size_t>(count_[0]) * count_[1], 0.0);
  }

  struct Range {
    int first = 0;
    int last = 0;
  };

  [[nodiscard]] Range range(const Vec3& center, double radius, std::size_t a) const {
    const int n = count_[a];
    const auto first = static_cast<int>(std::floor((center[a] - radius) * per_width_[a]));
    const auto last = static_cast<int>(std::floor((center[a] + radius) * per_width_[a]));
    if (cell_.periodic[a]) return {first, std::min(last, first + n - 1)};
    return {std::clamp(first, 0, n - 1), std::clamp(last, 0, n - 1)};
  }

  [[nodiscard]] static int wrapped_index(int i, int n) {
    const int r = i % n;
    return r < 0 ? r + n : r;
  }

  template <class Visit>
  void for_columns(const Vec3& center, double radius, Visit&& visit) const {
    const Range x = range(center, radius, 0);
    const Range y = axes_ == 2 ? range(center, radius, 1) : Range{};
    for (int j = y.first; j <= y.last; ++j) {
      const auto row = static_cast<std::size_t>(wrapped_index(j, count_[1])) * count_[0];
      for (int i = x.first; i <= x.last; ++i) visit(row + wrapped_index(i, count_[0]));
    }
  }

  Cell cell_;
  std::size_t axes_;  // Horizontal ones; the next one is the vertical axis.
  std::array<int, 2> count_{1, 1};
  std::array<double, 2> per_width_{};
  std::vector<double> tops_;
};

}  // namespace packstone::rolling
