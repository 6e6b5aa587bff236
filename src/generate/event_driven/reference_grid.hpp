#pragma once

/// @file
/// Which neighborhoods come near this one? Grids over the cell that bodies may leave and enter.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// All points within `radius` of a segment about `center`: a ball where `half` is 0.
struct Capsule {
  Vec3 center;
  Vec3 axis;            ///< Unit.
  double half = 0.0;    ///< Half length of the segment [L].
  double radius = 0.0;  ///< [L]

  [[nodiscard]] double reach() const { return half + radius; }
};

/// Some of those in one grid cell, side by side.
struct alignas(32) CapsuleChunk {
  static constexpr std::size_t kLanes = 8;
  float x[kLanes], y[kLanes], z[kLanes], axis_x[kLanes], axis_y[kLanes], axis_z[kLanes],
      half[kLanes], radius[kLanes];
  std::int32_t body[kLanes];
  std::int32_t count = 0;
  std::int32_t next = -1;
};

/// One to be held against them, as an image of the cell sees it.
struct SeenCapsule {
  float x, y, z, axis_x, axis_y, axis_z, half, radius;
};

/// A bit for every lane that meets it, or nearly does.
using CapsuleHits = unsigned (*)(const CapsuleChunk&, const SeenCapsule&);

/// Capsules about bodies, found by place, image by image. A level of its own for every doubling of
/// the reach, so that bodies of very unequal sizes cost no more than equal ones.
///
/// Capsules are kept as floats; a query never misses one that it should find and may find one that
/// stays away by up to 2^-18 of the longest edge.
class ReferenceGrid {
 public:
  /// An image of the cell: whole periods along each axis.
  using Image = std::array<int, 3>;

  explicit ReferenceGrid(const Cell& cell);

  /// Empties the grid and lays it out for bodies of these reaches.
  void reset(const std::vector<double>& reaches);

  /// Centers lie inside the cell along periodic axes, anywhere along walled ones. The reach may be
  /// larger than at reset().
  void insert(std::int32_t body, const Capsule& capsule);
  void remove(std::int32_t body);

  /// Calls visit(body, image) for every capsule of which an image meets this one.
  template <class Visit>
  void query(const Capsule& capsule, Visit&& visit) const {
    for (const Level& level : levels_) {
      if (level.bodies > 0) query_level(level, capsule, visit);
    }
  }

 private:
  struct Level {
    std::array<int, 3> dims{1, 1, 1};
    double largest = 0.0;  // Reach [L].
    std::int32_t bodies = 0;
    std::vector<CapsuleChunk> chunks;  // Those of the grid cells, then what they overflow into.
    std::int32_t free = -1;            // Chain of overflow chunks not in use.
  };
  struct Place {
    std::int32_t level = -1;
    std::int32_t cell = 0;
  };
  // Grid cells along one axis, not wrapped.
  struct Range {
    int first, last;
  };

  static int floor_div(int a, int n) { return a >= 0 ? a / n : -((n - 1 - a) / n); }

  [[nodiscard]] Range range(const Level& level, std::size_t axis, double low, double high) const {
    const int n = level.dims[axis];
    const double per_edge = n * per_size_[axis];
    const auto cell_of = [&](double x) { return static_cast<int>(std::floor(x * per_edge)); };
    Range r{cell_of(low), cell_of(high)};
    if (!cell_.periodic[axis]) {
      r.first = std::clamp(r.first, 0, n - 1);
      r.last = std::clamp(r.last, 0, n - 1);
    }
    return r;
  }

  // Does a grid cell hold what lies outside a wall as well?
  [[nodiscard]] bool has_outside(const Level& level, std::size_t axis, int k) const {
    if (cell_.periodic[axis] || axis >= static_cast<std::size_t>(cell_.dimension)) return false;
    return k == 0 || k == level.dims[axis] - 1;
  }

  template <class Visit>
  void query_level(const Level& level, const Capsule& capsule, Visit& visit) const {
    const double reach = capsule.reach() + level.largest + slack_;
    std::array<Range, 3> ranges{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
      ranges[a] = range(level, a, capsule.center[a] - reach, capsule.center[a] + reach);
    }
    const auto as_float = [](double x) { return static_cast<float>(x); };
    SeenCapsule seen{0,
                     0,
                     0,
                     as_float(capsule.axis.x),
                     as_float(capsule.axis.y),
                     as_float(capsule.axis.z),
                     as_float(capsule.half),
                     as_float(capsule.radius + slack_)};
    const auto& [nx, ny, nz] = level.dims;
    // Edges of a grid cell, and how far from the segment its middle can be.
    const Vec3 edge{cell_.size.x / nx, cell_.size.y / ny, cell_.size.z / nz};
    const double far = capsule.radius + level.largest + slack_ + 0.5 * norm(edge);
    const auto out_of_reach = [&](int x, int y, int z) {
      if (has_outside(level, 0, x) || has_outside(level, 1, y) || has_outside(level, 2, z)) {
        return false;
      }
      const Vec3 p{(x + 0.5) * edge.x - capsule.center.x, (y + 0.5) * edge.y - capsule.center.y,
                   (z + 0.5) * edge.z - capsule.center.z};
      const double along = dot(p, capsule.axis);
      const double nearest = std::clamp(along, -capsule.half, capsule.half);
      return norm_sq(p) - nearest * (2.0 * along - nearest) > far * far;
    };
    for (int kz = ranges[2].first; kz <= ranges[2].last; ++kz) {
      const int mz = floor_div(kz, nz);
      seen.z = as_float(capsule.center.z - mz * cell_.size.z);
      for (int ky = ranges[1].first; ky <= ranges[1].last; ++ky) {
        const int my = floor_div(ky, ny);
        seen.y = as_float(capsule.center.y - my * cell_.size.y);
        const int row = ((kz - mz * nz) * ny + (ky - my * ny)) * nx;
        for (int kx = ranges[0].first; kx <= ranges[0].last; ++kx) {
          if (out_of_reach(kx, ky, kz)) continue;
          const int mx = floor_div(kx, nx);
          seen.x = as_float(capsule.center.x - mx * cell_.size.x);
          visit_chain(level, static_cast<std::size_t>(row + kx - mx * nx), seen, {mx, my, mz},
                      visit);
        }
      }
    }
  }

  template <class Visit>
  void visit_chain(const Level& level, std::size_t head, const SeenCapsule& seen,
                   const Image& image, Visit& visit) const {
    for (const CapsuleChunk* chunk = &level.chunks[head]; chunk->count > 0;
         chunk = &level.chunks[static_cast<std::size_t>(chunk->next)]) {
      for (unsigned hits = hits_(*chunk, seen); hits != 0; hits &= hits - 1) {
        visit(chunk->body[static_cast<std::size_t>(__builtin_ctz(hits))], image);
      }
      if (chunk->next < 0) return;
    }
  }

  void shape(Level& level, std::int64_t bodies, double reach) const;
  [[nodiscard]] std::int32_t level_of(double reach) const;

  Cell cell_;
  std::array<double, 3> per_size_{};
  double slack_;
  double smallest_ = 1.0;  // Reach that level 0 begins with.
  std::vector<Level> levels_;
  std::vector<Place> places_;
  CapsuleHits hits_;
};

}  // namespace packstone::event_driven
