#pragma once

/// @file
/// Which bodies come near this one? A hierarchy of grids over the cell, periodic images included.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// The axis-aligned boxes of bodies in a cell, found by place.
///
/// A body stands once, in the grid cell of its center, on the level of its size: level k holds the
/// longest half extents in (2^(k-1), 2^k] times a reference length. A query walks, level by level,
/// over all grid cells from which a body of that level can reach the box asked for. It counts the
/// grid cells without wrapping; the image of a body is that unwrapped index divided (floor) by the
/// number of grid cells. So each image comes exactly once, however long the bodies are: several
/// images of one neighbor, and the images of the body itself.
///
/// Boxes are kept as floats in units of the cell edges, rounded outward: a query never misses a
/// body, and may visit one whose box stays away by up to 2^-22 of a cell edge more than asked.
///
/// Cost:  insert and query take constant time at fixed density, for equal as for very unequal
///        bodies; memory is some 60 to 130 bytes per body. See
///        docs/algorithms/neighbor_search.md.
///
/// Queries are const and touch nothing shared: any number of threads may ask at once, as long as
/// none inserts. The order of visits depends on the order of insertion only.
class HierarchicalGrid {
 public:
  /// An image of the cell: whole periods along each axis.
  using Image = std::array<int, 3>;

  /// @param cell  Must pass check_cell().
  explicit HierarchicalGrid(const Cell& cell);

  /// Makes the grid right for `count` bodies from the start, where the count is known.
  void reserve(std::int64_t count);

  /// Forgets all bodies; keeps what reserve() was told.
  void clear() noexcept;

  /// Number of bodies stored.
  [[nodiscard]] std::int64_t size() const noexcept { return size_; }

  /// Adds a body.
  ///
  /// @param id            Any number that the caller knows the body by.
  /// @param center        Inside the cell [L].
  /// @param half_extents  Half edges of its box [L], see half_extents() of bounds.hpp. At most some
  ///                      500 periods long along a periodic axis.
  void insert(std::int32_t id, const Vec3& center, const Vec3& half_extents);

  /// Visits every stored body, image by image, whose box comes within `margin` of the box asked
  /// for, along each axis. The image of a body stands at its center plus image_shift(cell, image).
  ///
  /// @param center        Center of the box asked for [L]; it may lie outside the cell.
  /// @param half_extents  Its half edges [L].
  /// @param margin        Distance, along each axis [L]. >= 0.
  /// @param visit         visit(id, image) returns true to go on, false to end the query.
  /// @return              false if a visit ended the query.
  template <class Visit>
  bool query(const Vec3& center, const Vec3& half_extents, double margin, Visit&& visit) const {
    const UnitBox box = unit_box(center, half_extents, margin);
    for (const Level& level : levels_) {
      if (!visit_level(level, box, visit)) return false;
    }
    return true;
  }

 private:
  static constexpr int kLanes = 4;
  // Four numbers side by side, in one register of any processor of the last twenty years. Without
  // this the compilers compare lane by lane: measured, queries take twice as long.
  using Floats = float __attribute__((vector_size(16)));
  using Flags = std::int32_t __attribute__((vector_size(16)));
  // Above all that floats in units of the cell edge add to an extent; 2^-22 of the edge.
  static constexpr double kFloatSlack = 0x1p-22;

  // A box in units of the cell edges.
  struct UnitBox {
    std::array<double, 3> lo;
    std::array<double, 3> hi;
  };
  // The same, rounded outward.
  struct FloatBox {
    std::array<float, 3> lo;
    std::array<float, 3> hi;
  };
  struct Entry {
    FloatBox box;
    std::int32_t id;
  };
  // Up to four bodies of one grid cell, lane by lane. Free lanes hold the box [inf, -inf].
  struct alignas(128) Chunk {
    Floats lo[3];
    Floats hi[3];
    std::int32_t id[kLanes];
    std::int32_t next = -1;
    std::int32_t count = 0;

    Chunk() noexcept;
  };
  // A grid over the cell. The first chunks are those of the grid cells, x fastest; the rest are
  // chained behind them where more than four bodies share a grid cell.
  struct Level {
    int exponent = 0;
    std::array<int, 3> dims{1, 1, 1};
    std::array<double, 3> reach{};  // Longest half extents, in units of the cell edges.
    std::vector<Chunk> chunks;
  };
  // Grid cells along one axis, not wrapped, and the images that they belong to.
  struct AxisRange {
    int first, last;
    int first_image, last_image;
  };

  static float rounded_down(double x) {
    return static_cast<float>(x - std::abs(x) * 0x1p-23) - std::numeric_limits<float>::min();
  }
  static float rounded_up(double x) {
    return static_cast<float>(x + std::abs(x) * 0x1p-23) + std::numeric_limits<float>::min();
  }
  static int floor_div(int a, int n) { return a >= 0 ? a / n : -((n - 1 - a) / n); }

  UnitBox unit_box(const Vec3& center, const Vec3& half_extents, double margin) const {
    UnitBox box;
    for (std::size_t a = 0; a < 3; ++a) {
      const double reach = half_extents[a] + margin;
      box.lo[a] = (center[a] - reach) * per_edge_[a];
      box.hi[a] = (center[a] + reach) * per_edge_[a];
    }
    return box;
  }

  AxisRange axis_range(const Level& level, const UnitBox& box, std::size_t a) const {
    const int n = level.dims[a];
    double first = std::floor((box.lo[a] - level.reach[a]) * n);
    double last = std::floor((box.hi[a] + level.reach[a]) * n);
    if (!periodic_[a]) {
      const double end = n - 1;
      first = first < 0.0 ? 0.0 : first < end ? first : end;
      last = last < 0.0 ? 0.0 : last < end ? last : end;
    }
    const AxisRange range{static_cast<int>(first), static_cast<int>(last), 0, 0};
    if (range.first >= 0 && range.last < n) return range;
    return {range.first, range.last, floor_div(range.first, n), floor_div(range.last, n)};
  }

  template <class Visit>
  bool visit_level(const Level& level, const UnitBox& box, Visit& visit) const {
    const AxisRange x = axis_range(level, box, 0);
    const AxisRange y = axis_range(level, box, 1);
    const AxisRange z = axis_range(level, box, 2);
    Image image;
    for (image[2] = z.first_image; image[2] <= z.last_image; ++image[2]) {
      for (image[1] = y.first_image; image[1] <= y.last_image; ++image[1]) {
        for (image[0] = x.first_image; image[0] <= x.last_image; ++image[0]) {
          if (!visit_image(level, {x, y, z}, box, image, visit)) return false;
        }
      }
    }
    return true;
  }

  template <class Visit>
  static bool visit_image(const Level& level, const std::array<AxisRange, 3>& ranges,
                          const UnitBox& box, const Image& image, Visit& visit) {
    FloatBox seen;
    std::array<int, 3> first, last;
    for (std::size_t a = 0; a < 3; ++a) {
      const int n = level.dims[a];
      first[a] = image[a] == ranges[a].first_image ? ranges[a].first - image[a] * n : 0;
      last[a] = image[a] == ranges[a].last_image ? ranges[a].last - image[a] * n : n - 1;
      seen.lo[a] = rounded_down(box.lo[a] - image[a]);
      seen.hi[a] = rounded_up(box.hi[a] - image[a]);
    }
    for (int k = first[2]; k <= last[2]; ++k) {
      for (int j = first[1]; j <= last[1]; ++j) {
        const std::size_t row = (static_cast<std::size_t>(k) * level.dims[1] + j) * level.dims[0];
        for (int i = first[0]; i <= last[0]; ++i) {
          if (!visit_chain(level, row + i, seen, image, visit)) return false;
        }
      }
    }
    return true;
  }

  template <class Visit>
  static bool visit_chain(const Level& level, std::size_t head, const FloatBox& seen,
                          const Image& image, Visit& visit) {
    for (const Chunk* chunk = &level.chunks[head];; chunk = &level.chunks[chunk->next]) {
      const Flags hit = (chunk->lo[0] <= seen.hi[0]) & (chunk->hi[0] >= seen.lo[0]) &
                        (chunk->lo[1] <= seen.hi[1]) & (chunk->hi[1] >= seen.lo[1]) &
                        (chunk->lo[2] <= seen.hi[2]) & (chunk->hi[2] >= seen.lo[2]);
      const auto halves = std::bit_cast<std::array<std::int64_t, 2>>(hit);
      if ((halves[0] | halves[1]) != 0) {
        for (int l = 0; l < kLanes; ++l) {
          if (hit[l] != 0 && !visit(chunk->id[l], image)) return false;
        }
      }
      if (chunk->next < 0) return true;
    }
  }

  FloatBox float_box(const Vec3& center, const Vec3& half_extents) const;
  double longest_half_extent(const FloatBox& box) const;
  int exponent_of(double half_extent) const;
  std::int64_t expected(std::int64_t count) const;
  Level& level_for(const Entry& entry);
  void shape_level(Level& level, const std::vector<Entry>& entries, std::int64_t count) const;
  static void put(Level& level, const Entry& entry);
  std::vector<Entry> entries() const;
  void rebuild(const std::vector<Entry>& entries);

  Cell cell_;
  std::array<double, 3> per_edge_;  // 1 / cell edge; 0 along z in 2D.
  std::array<bool, 3> periodic_;
  std::vector<Level> levels_;  // Largest bodies first.
  double reference_ = 0.0;     // Half extents of level 0 reach up to this [L].
  std::int64_t size_ = 0;
  std::int64_t reserved_ = 0;
  std::int64_t rebuild_at_ = 0;  // Size beyond which the levels are laid out anew.
};

}  // namespace packstone
