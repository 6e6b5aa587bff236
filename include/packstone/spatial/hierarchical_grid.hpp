#pragma once

/// @file
/// Which bodies come near this one? A hierarchy of grids over the cell, periodic images included.

#include <algorithm>
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
  /// @param core          Radius of a ball about the center that the body fills, for
  ///                      meets_core() [L]. Finite, >= 0.
  void insert(std::int32_t id, const Vec3& center, const Vec3& half_extents, double core = 0.0);

  /// Does a ball come within the core of a stored body, images included: is the distance of the
  /// centers certainly less than the sum of the radii? Far cheaper than a query, and it often
  /// settles what a query would be asked for. May miss a core by 2^-20 of the longest cell edge or
  /// 1 % of its radius.
  ///
  /// @param center  Of the ball, inside the cell [L].
  /// @param radius  Of the ball [L].
  [[nodiscard]] bool meets_core(const Vec3& center, double radius) const noexcept;

  /// The first part of meets_core(), which finds most of it: looks only at the grid cells that
  /// hold the center.
  [[nodiscard]] bool meets_core_at_home(const Vec3& center, double radius) const noexcept;

  /// Ask the memory for what meets_core_at_home(), meets_core(), query() will look at, so that many
  /// of them wait for it together. Arguments as there.
  void prefetch_home(const Vec3& center) const noexcept;
  void prefetch_core(const Vec3& center, double radius) const noexcept;
  void prefetch_query(const Vec3& center, const Vec3& half_extents, double margin) const noexcept;

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
  // The upper half of a positive float, which is never more than the float: 8 bits of precision.
  using Halves = std::uint16_t __attribute__((vector_size(8)));
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
    std::uint16_t core;
  };
  // Up to four bodies of one grid cell, lane by lane. Free lanes hold the box [inf, -inf].
  struct alignas(128) Chunk {
    Floats lo[3];
    Floats hi[3];
    std::int32_t id[kLanes];
    Halves core;
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
    double largest_core = 0.0;      // [L].
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
  static Floats all_lanes(double x) { return Floats{} + static_cast<float>(x); }
  // Beyond a billion, where no grid ends, the billion.
  static int floor_to_int(double x) {
    const double near = std::min(std::max(-1e9, x), 1e9);
    const int i = static_cast<int>(near);
    return i - static_cast<int>(near < i);
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

  // The grid cells that [lo, hi] touches, in units of the cell edges.
  AxisRange axis_range(const Level& level, double lo, double hi, std::size_t a) const {
    const int n = level.dims[a];
    AxisRange range{floor_to_int(lo * n), floor_to_int(hi * n), 0, 0};
    if (range.first >= 0 && range.last < n) return range;
    if (!periodic_[a])
      return {std::clamp(range.first, 0, n - 1), std::clamp(range.last, 0, n - 1), 0, 0};
    return {range.first, range.last, floor_div(range.first, n), floor_div(range.last, n)};
  }

  // Calls look(head, image) for every grid cell of the ranges, image by image, and begin(image)
  // before those of each image.
  template <class Begin, class Look>
  static bool walk(const Level& level, const std::array<AxisRange, 3>& ranges, Begin&& begin,
                   Look&& look) {
    const auto& [x, y, z] = ranges;
    Image image;
    for (image[2] = z.first_image; image[2] <= z.last_image; ++image[2]) {
      for (image[1] = y.first_image; image[1] <= y.last_image; ++image[1]) {
        for (image[0] = x.first_image; image[0] <= x.last_image; ++image[0]) {
          begin(image);
          if (!walk_image(level, ranges, image, look)) return false;
        }
      }
    }
    return true;
  }

  template <class Look>
  static bool walk_image(const Level& level, const std::array<AxisRange, 3>& ranges,
                         const Image& image, Look&& look) {
    std::array<int, 3> first, last;
    for (std::size_t a = 0; a < 3; ++a) {
      const int n = level.dims[a];
      first[a] = image[a] == ranges[a].first_image ? ranges[a].first - image[a] * n : 0;
      last[a] = image[a] == ranges[a].last_image ? ranges[a].last - image[a] * n : n - 1;
    }
    for (int k = first[2]; k <= last[2]; ++k) {
      for (int j = first[1]; j <= last[1]; ++j) {
        const std::size_t row = (static_cast<std::size_t>(k) * level.dims[1] + j) * level.dims[0];
        for (int i = first[0]; i <= last[0]; ++i) {
          if (!look(row + i, image)) return false;
        }
      }
    }
    return true;
  }

  // The grid cells whose bodies may reach the box.
  std::array<AxisRange, 3> ranges_of(const Level& level, const UnitBox& box) const {
    std::array<AxisRange, 3> ranges;
    for (std::size_t a = 0; a < 3; ++a) {
      ranges[a] = axis_range(level, box.lo[a] - level.reach[a], box.hi[a] + level.reach[a], a);
    }
    return ranges;
  }

  template <class Visit>
  bool visit_level(const Level& level, const UnitBox& box, Visit& visit) const {
    FloatBox seen;
    return walk(
        level, ranges_of(level, box),
        [&](const Image& image) {
          for (std::size_t a = 0; a < 3; ++a) {
            seen.lo[a] = rounded_down(box.lo[a] - image[a]);
            seen.hi[a] = rounded_up(box.hi[a] - image[a]);
          }
        },
        [&](std::size_t head, const Image& image) {
          return visit_chain(level, head, seen, image, visit);
        });
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

  struct Ball;
  [[nodiscard]] Ball ball_at(const Vec3& center, double radius) const noexcept;
  [[nodiscard]] std::size_t home_of(const Level& level, const Vec3& center) const noexcept;
  [[nodiscard]] std::array<AxisRange, 3> core_ranges(const Level& level, const Vec3& center,
                                                     double radius) const noexcept;
  static bool chain_meets(const Level& level, std::size_t head, const Ball& ball) noexcept;
  [[nodiscard]] bool level_meets(const Level& level, const Vec3& center, double radius,
                                 Ball& ball) const noexcept;
  static void prefetch_cells(const Level& level, const std::array<AxisRange, 3>& ranges) noexcept;
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
  double core_slack_;               // For the rounding of the coordinates kept [L].
  std::array<double, 3> per_edge_;  // 1 / cell edge; 0 along z in 2D.
  std::array<bool, 3> periodic_;
  std::vector<Level> levels_;  // Largest bodies first.
  double reference_ = 0.0;     // Half extents of level 0 reach up to this [L].
  std::int64_t size_ = 0;
  std::int64_t reserved_ = 0;
  std::int64_t rebuild_at_ = 0;  // Size beyond which the levels are laid out anew.
};

}  // namespace packstone
