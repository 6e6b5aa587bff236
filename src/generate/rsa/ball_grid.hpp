#pragma once

/// @file
/// Bins so small that each holds at most one center, with ghosts of the centers across periods.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "packstone/core/error.hpp"

namespace packstone::rsa {

template <int Dim>
using Point = std::array<double, Dim>;
template <int Dim>
using Index = std::array<std::int64_t, Dim>;

/// Where centers may be: [low, high] along each axis.
template <int Dim>
struct CenterRange {
  Point<Dim> low{};
  Point<Dim> high{};   ///< Along a period: the last double below the edge length.
  Point<Dim> width{};  ///< high - low; along a period: the edge length.
  std::array<bool, Dim> periodic{};
};

template <int Dim>
[[nodiscard]] double distance_sq(const Point<Dim>& p, const Point<Dim>& q) noexcept {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const double d = p[axis] - q[axis];
    sum += d * d;
  }
  return sum;
}

/// Distance of q to the box [low, high], squared.
template <int Dim>
[[nodiscard]] double nearest_sq(const Point<Dim>& q, const Point<Dim>& low,
                                const Point<Dim>& high) noexcept {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const double d = std::max(std::max(low[axis] - q[axis], q[axis] - high[axis]), 0.0);
    sum += d * d;
  }
  return sum;
}

/// Equal bins over the range of centers, padded on all sides with bins for ghosts.
///
/// The diagonal of a bin is below the distance that centers keep, so a bin holds one at most. Most
/// bins are empty: one bit each says which, and a search reads the bits of a row of bins at once.
template <int Dim>
class BallGrid {
 public:
  BallGrid(const CenterRange<Dim>& range, double keep) : range_(range), keep_sq_(keep * keep) {
    std::int64_t stride = 1;
    for (int axis = 0; axis < Dim; ++axis) {
      // The margins of 1e-9 are far above rounding and cost nothing.
      const double bins = std::ceil(range.width[axis] / keep * std::sqrt(Dim) * (1.0 + 1e-9));
      count_[axis] = std::max<std::int64_t>(1, static_cast<std::int64_t>(bins));
      edge_[axis] = range.width[axis] / static_cast<double>(count_[axis]);
      reach_[axis] = reach(edge_[axis] * (1.0 - 1e-9), keep, count_[axis], range.periodic[axis]);
      stride_[axis] = stride;
      stride *= count_[axis] + 2 * reach_[axis];
    }
    centers_ = std::make_unique_for_overwrite<Point<Dim>[]>(static_cast<std::size_t>(stride));
    bits_.assign(static_cast<std::size_t>(stride / 8 + 9), 0);
    list_rows(keep);
  }

  [[nodiscard]] const CenterRange<Dim>& range() const noexcept { return range_; }
  /// Bins along each axis, ghosts apart.
  [[nodiscard]] const Index<Dim>& count() const noexcept { return count_; }
  [[nodiscard]] const Point<Dim>& edge() const noexcept { return edge_; }
  [[nodiscard]] double keep_sq() const noexcept { return keep_sq_; }

  /// Place of a bin in memory; `bin` may be a ghost's.
  [[nodiscard]] std::int64_t slot(const Index<Dim>& bin) const noexcept {
    std::int64_t sum = 0;
    for (int axis = 0; axis < Dim; ++axis) sum += (bin[axis] + reach_[axis]) * stride_[axis];
    return sum;
  }

  /// The bin at a place in memory.
  [[nodiscard]] Index<Dim> bin(std::int64_t slot) const noexcept {
    Index<Dim> bin;
    for (int axis = Dim - 1; axis >= 0; --axis) {
      bin[axis] = slot / stride_[axis] - reach_[axis];
      slot %= stride_[axis];
    }
    return bin;
  }

  [[nodiscard]] bool occupied(std::int64_t slot) const noexcept {
    return (bits_[slot >> 3] >> (slot & 7) & 1) != 0;
  }

  /// Does p, in the bin at `slot`, keep the distance to every center and ghost?
  [[nodiscard]] bool is_free(const Point<Dim>& p, std::int64_t slot) const noexcept {
    if (occupied(slot)) return false;
    for (const Row& row : rows_) {
      const Point<Dim>* first = centers_.get() + slot + row.first;
      for (std::uint64_t bits = row_bits(slot, row); bits != 0; bits &= bits - 1) {
        if (!(distance_sq<Dim>(p, first[std::countr_zero(bits)]) > keep_sq_)) return false;
      }
    }
    return true;
  }

  /// Brings the nearest bins to the processor, for a call of is_free() soon after.
  void prefetch(std::int64_t slot) const noexcept {
    // Measured: three rows pay in 2D, while in 3D any prefetch costs more than it saves.
    if constexpr (Dim == 2) {
      for (std::size_t i = 0; i < 3 && i < rows_.size(); ++i) {
        const std::int64_t first = slot + rows_[i].first;
        __builtin_prefetch(bits_.data() + (first >> 3));
        __builtin_prefetch(centers_.get() + first);
        __builtin_prefetch(centers_.get() + first + 4);
      }
    }
  }

  /// Writes the centers and ghosts that come within the kept distance of the box [low, high] inside
  /// the bin at `slot`; `out` holds max_neighbors(). Returns how many.
  int gather(std::int64_t slot, const Point<Dim>& low, const Point<Dim>& high,
             Point<Dim>* out) const noexcept {
    int found = 0;
    for (const Row& row : rows_) {
      const Point<Dim>* first = centers_.get() + slot + row.first;
      for (std::uint64_t bits = row_bits(slot, row); bits != 0; bits &= bits - 1) {
        const Point<Dim>& center = first[std::countr_zero(bits)];
        out[found] = center;
        found += nearest_sq<Dim>(center, low, high) < keep_sq_ ? 1 : 0;
      }
    }
    return found;
  }
  /// Bound on what gather() writes, one spare place included.
  [[nodiscard]] std::size_t max_neighbors() const noexcept { return max_neighbors_ + 1; }

  /// Stores p in `bin`, and its ghosts.
  void place(const Point<Dim>& p, const Index<Dim>& bin) noexcept { place_axis(0, p, bin); }

 private:
  /// Neighboring bins that lie side by side along x.
  struct Row {
    std::ptrdiff_t first = 0;  ///< Offset of the first one from the bin in the middle.
    std::uint64_t mask = 0;    ///< As many ones as there are bins.
  };

  // One bit per bin of the row, set where a center stands. A row spans at most 57 bins: so many
  // bits does a read at any byte give for certain.
  [[nodiscard]] std::uint64_t row_bits(std::int64_t slot, const Row& row) const noexcept {
    const std::int64_t first = slot + row.first;
    std::uint64_t word;
    std::memcpy(&word, bits_.data() + (first >> 3), sizeof word);
    return word >> (first & 7) & row.mask;
  }

  // Bins that a ball may reach across to each side.
  static std::int64_t reach(double edge, double keep, std::int64_t count, bool periodic) {
    const double steps = std::floor(keep / edge) + 1.0;
    if (!periodic && !(steps < static_cast<double>(count))) return count;
    return static_cast<std::int64_t>(steps);
  }

  // Rows of the bins that a ball can touch from inside a bin, nearest first: a trial that fails
  // then fails early.
  void list_rows(double keep) {
    std::vector<std::pair<double, Row>> near;
    Index<Dim> step{};
    for (int axis = 1; axis < Dim; ++axis) step[axis] = -reach_[axis];
    while (step[Dim - 1] <= reach_[Dim - 1]) {
      add_row(step, keep, near);
      for (int axis = 1; axis < Dim; ++axis) {
        if (++step[axis] <= reach_[axis] || axis == Dim - 1) break;
        step[axis] = -reach_[axis];
      }
    }
    std::stable_sort(near.begin(), near.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [middle, row] : near) rows_.push_back(row);
  }

  // The row that lies `step` bins off (the first entry is not used), unless it is out of reach.
  void add_row(const Index<Dim>& step, double keep, std::vector<std::pair<double, Row>>& near) {
    double least = 0.0;   // Distance of the row to the bin in the middle, squared.
    double middle = 0.0;  // Distance between their middles, squared.
    std::ptrdiff_t offset = 0;
    for (int axis = 1; axis < Dim; ++axis) {
      const double steps = static_cast<double>(std::abs(step[axis]));
      const double apart = std::max(0.0, steps - 1.0) * edge_[axis];
      least += apart * apart;
      middle += steps * edge_[axis] * steps * edge_[axis];
      offset += step[axis] * stride_[axis];
    }
    const auto in_reach = [&](std::int64_t half) {
      const double apart = static_cast<double>(std::max<std::int64_t>(0, half - 1)) * edge_[0];
      return (least + apart * apart) * (1.0 - 1e-9) < keep * keep;
    };
    if (!in_reach(0)) return;
    std::int64_t half = reach_[0];
    while (half > 0 && !in_reach(half)) --half;
    PACKSTONE_ASSERT(2 * half + 1 <= 57);
    near.push_back({middle, {offset - half, (std::uint64_t{1} << (2 * half + 1)) - 1}});
    max_neighbors_ += static_cast<std::size_t>(2 * half + 1);
  }

  void place_axis(int axis, Point<Dim> p, Index<Dim> bin) noexcept {
    if (axis == Dim) {
      const std::int64_t place = slot(bin);
      PACKSTONE_ASSERT(!occupied(place));
      bits_[place >> 3] |= static_cast<unsigned char>(1u << (place & 7));
      centers_[place] = p;
      return;
    }
    place_axis(axis + 1, p, bin);
    if (!range_.periodic[axis]) return;
    const double x = p[axis];
    const std::int64_t home = bin[axis];
    for (std::int64_t k = 1; home - k * count_[axis] >= -reach_[axis]; ++k) {
      bin[axis] = home - k * count_[axis];
      p[axis] = x - static_cast<double>(k) * range_.width[axis];
      place_axis(axis + 1, p, bin);
    }
    for (std::int64_t k = 1; home + k * count_[axis] < count_[axis] + reach_[axis]; ++k) {
      bin[axis] = home + k * count_[axis];
      p[axis] = x + static_cast<double>(k) * range_.width[axis];
      place_axis(axis + 1, p, bin);
    }
  }

  CenterRange<Dim> range_;
  double keep_sq_;
  Index<Dim> count_{};
  Index<Dim> reach_{};
  Index<Dim> stride_{};
  Point<Dim> edge_{};
  std::unique_ptr<Point<Dim>[]> centers_;  // By slot; read only where the bit is set.
  std::vector<unsigned char> bits_;
  std::vector<Row> rows_;
  std::size_t max_neighbors_ = 0;
};

}  // namespace packstone::rsa
