#pragma once

/// @file
/// Which capsules come near this one? Grids over the cell that bodies may leave and enter.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/posed_body.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "spatial/capsule_lanes.hpp"

namespace packstone {

/// All points within `radius` of a segment about `center`: a ball where `half` is 0.
struct Capsule {
  Vec3 center;
  Vec3 axis;            ///< Unit.
  double half = 0.0;    ///< Half length of the segment [L].
  double radius = 0.0;  ///< [L]

  [[nodiscard]] double reach() const { return half + radius; }
};

/// A capsule that holds the body with a shell of thickness `around` [L].
[[nodiscard]] Capsule capsule_about(const PosedBody& body, double around);

/// Capsules about bodies, found by place, image by image. A level of its own for every doubling of
/// the reach, so that bodies of very unequal sizes cost no more than equal ones. Long capsules are
/// cut into pieces about as long as a grid cell, and those that are asked about walk along
/// themselves: needles meet few, though their bounding balls meet nearly all.
///
/// Capsules are kept as floats; a query never misses one that it should find and may find one that
/// stays away by up to 2^-18 of the longest edge.
class CapsuleGrid {
 public:
  /// An image of the cell: whole periods along each axis.
  using Image = std::array<int, 3>;

  explicit CapsuleGrid(const Cell& cell);

  /// Empties the grid and lays it out for bodies of these sizes, wherever they are.
  void reset(const std::vector<Capsule>& capsules);

  /// Centers lie inside the cell along periodic axes, anywhere along walled ones. The capsule may
  /// be larger than at reset().
  void insert(std::int32_t body, const Capsule& capsule);
  void remove(std::int32_t body);

  /// What a query needs to remember on its way. One for each thread that asks.
  class Scratch {
    friend class CapsuleGrid;
    struct Seen {
      std::int32_t body;
      Image image;
    };
    bool is_new(std::int32_t body, const Image& image);

    std::vector<Seen> found_;           // By the query that is going on, among those cut.
    std::vector<std::uint32_t> first_;  // In found_, of every body that is there.
  };

  /// Calls visit(body, image) once for every capsule of which an image meets this one. Any number
  /// of threads may ask at once, as long as none inserts or removes.
  ///
  /// @param visit  Returns true to go on, false to end the query.
  /// @param from   Leaves out bodies of a lower number.
  /// @returns      false when visit ended it.
  template <class Visit>
  bool query(const Capsule& capsule, Scratch& scratch, Visit&& visit, std::int32_t from = 0) const {
    scratch.found_.clear();
    scratch.first_.resize(places_.size());
    const auto visit_new = [&](const Level& level, std::int32_t body, const Image& image) {
      return body < from || (level.cut && !scratch.is_new(body, image)) || visit(body, image);
    };
    return query_levels(capsule, from, visit_new);
  }

  /// The same, but a body that is cut may be visited once for each of its pieces that meets the
  /// capsule. For those who look for the first that does.
  template <class Visit>
  bool query_pieces(const Capsule& capsule, Visit&& visit) const {
    return query_levels(capsule, 0, [&](const Level&, std::int32_t body, const Image& image) {
      return visit(body, image);
    });
  }

  /// Asks the memory for what the bodies next to `center` are kept in.
  void prefetch(const Vec3& center) const noexcept;

 private:
  struct Level {
    std::array<int, 3> dims{1, 1, 1};
    double piece = 0.0;    // Pieces are at least that long [L].
    double largest = 0.0;  // Reach of pieces [L].
    bool cut = false;      // Is any body in more pieces than one?
    std::int64_t pieces = 0;
    std::vector<CapsuleChunk> chunks;  // Those of the grid cells, then what they overflow into.
    std::int32_t free = -1;            // Chain of overflow chunks not in use.
  };
  // Where a body is kept: which level, and which of grid_cells_.
  struct Place {
    std::int32_t level = -1;
    std::int32_t pieces = 1;
    std::int64_t first = 0;
  };
  // Grid cells along one axis, not wrapped.
  struct Range {
    int first, last;
  };
  // From the center of a capsule along its axis [L].
  struct Stretch {
    double first, last;
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

  // What of a stretch is within `far` of the grid cells number k along an axis.
  [[nodiscard]] Stretch beside(const Level& level, std::size_t axis, int k, double far,
                               const Capsule& capsule, const Stretch& stretch) const {
    const double along = capsule.axis[axis];
    if (along == 0.0 || has_outside(level, axis, k)) return stretch;
    const double edge = cell_.size[axis] / level.dims[axis];
    const double low = (k * edge - far - capsule.center[axis]) / along;
    const double high = ((k + 1) * edge + far - capsule.center[axis]) / along;
    return {std::max(stretch.first, std::min(low, high)),
            std::min(stretch.last, std::max(low, high))};
  }

  // The grid cells along an axis that come within `far` of a stretch.
  [[nodiscard]] Range range_of(const Level& level, std::size_t axis, double far,
                               const Capsule& capsule, const Stretch& stretch) const {
    if (axis >= static_cast<std::size_t>(cell_.dimension)) return {0, 0};
    const double one = stretch.first * capsule.axis[axis],
                 other = stretch.last * capsule.axis[axis];
    const double center = capsule.center[axis];
    return range(level, axis, center + std::min(one, other) - far,
                 center + std::max(one, other) + far);
  }

  template <class Visit>
  bool query_levels(const Capsule& capsule, std::int32_t from, const Visit& visit) const {
    return std::all_of(levels_.begin(), levels_.end(), [&](const Level& level) {
      return level.pieces == 0 || query_level(level, capsule, from, visit);
    });
  }

  template <class Visit>
  bool query_level(const Level& level, const Capsule& capsule, std::int32_t from,
                   const Visit& visit) const {
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
    const Vec3 edge{cell_.size.x / nx, cell_.size.y / ny, cell_.size.z / nz};
    // How far from the segment a grid cell can be, and its middle.
    const double far = capsule.radius + level.largest + slack_;
    const double far_middle = far + 0.5 * norm(edge);
    const auto out_of_reach = [&](int x, int y, int z) {
      if (has_outside(level, 0, x) || has_outside(level, 1, y) || has_outside(level, 2, z)) {
        return false;
      }
      const Vec3 p{(x + 0.5) * edge.x - capsule.center.x, (y + 0.5) * edge.y - capsule.center.y,
                   (z + 0.5) * edge.z - capsule.center.z};
      const double along = dot(p, capsule.axis);
      const double nearest = std::clamp(along, -capsule.half, capsule.half);
      return norm_sq(p) - nearest * (2.0 * along - nearest) > far_middle * far_middle;
    };
    const Stretch whole{-capsule.half, capsule.half};
    const Range layers = range_of(level, 2, far, capsule, whole);
    for (int kz = layers.first; kz <= layers.last; ++kz) {
      const Stretch in_layer = beside(level, 2, kz, far, capsule, whole);
      const int mz = floor_div(kz, nz);
      seen.z = as_float(capsule.center.z - mz * cell_.size.z);
      const Range rows = range_of(level, 1, far, capsule, in_layer);
      for (int ky = rows.first; ky <= rows.last; ++ky) {
        const Stretch in_row = beside(level, 1, ky, far, capsule, in_layer);
        const int my = floor_div(ky, ny);
        seen.y = as_float(capsule.center.y - my * cell_.size.y);
        const int row = ((kz - mz * nz) * ny + (ky - my * ny)) * nx;
        const Range cells = range_of(level, 0, far, capsule, in_row);
        for (int kx = cells.first; kx <= cells.last; ++kx) {
          if (out_of_reach(kx, ky, kz)) continue;
          const int mx = floor_div(kx, nx);
          seen.x = as_float(capsule.center.x - mx * cell_.size.x);
          const auto head = static_cast<std::size_t>(row + kx - mx * nx);
          if (!visit_chain(level, head, seen, {mx, my, mz}, from, visit)) return false;
        }
      }
    }
    return true;
  }

  template <class Visit>
  bool visit_chain(const Level& level, std::size_t head, const SeenCapsule& seen,
                   const Image& cell_image, std::int32_t from, const Visit& visit) const {
    for (const CapsuleChunk* chunk = &level.chunks[head]; chunk->count > 0;
         chunk = &level.chunks[static_cast<std::size_t>(chunk->next)]) {
      unsigned hits = chunk->greatest < from ? 0 : hits_(*chunk, seen);
      for (; hits != 0; hits &= hits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(hits));
        const std::int32_t body = chunk->body[lane];
        const auto& wrap = chunk->wrap[lane];
        const Image image{cell_image[0] - wrap[0], cell_image[1] - wrap[1],
                          cell_image[2] - wrap[2]};
        if (!visit(level, body, image)) return false;
      }
      if (chunk->next < 0) break;
    }
    return true;
  }

  [[nodiscard]] std::size_t grid_cell_of(const Level& level, const Vec3& center) const noexcept;
  void shape(Level& level, const std::vector<Capsule>& capsules);
  [[nodiscard]] std::int32_t level_of(double reach) const;
  void insert_piece(Level& level, std::int32_t body, Capsule piece, std::int32_t& grid_cell);
  static CapsuleChunk& chunk_with_room(Level& level, std::int32_t grid_cell);
  static void remove_piece(Level& level, std::int32_t body, std::int32_t grid_cell);

  Cell cell_;
  std::array<double, 3> per_size_{};
  double slack_;
  double smallest_ = 1.0;  // Reach that level 0 begins with.
  std::vector<Level> levels_;
  std::vector<Place> places_;
  std::vector<std::int32_t> grid_cells_;  // Of every piece.
  CapsuleHits hits_;
};

}  // namespace packstone
