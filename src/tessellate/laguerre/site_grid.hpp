#pragma once

/// @file
/// The sites about a place, nearest first, periodic images included.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "packstone/core/cell.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// Sites in grids, one for each class of weights: a heavy site acts from afar, and only the few
/// heavy ones have to be sought there.
///
/// Walks ring by ring, a ring being the grid cells at one Chebyshev distance from the one that the
/// place is in, the nearest ring of all grids first.
class SiteGrid {
 public:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// A site as the walk finds it.
  struct Entry {
    Vec3 at;
    double weight;
    std::int32_t site;
  };

  SiteGrid(const Cell& box, const std::vector<Site>& sites);

  /// Visits the sites about `at`, which is inside the box along periodic axes.
  ///
  /// @param reach  reach(weight): how far away a site of at most this weight still matters [L].
  ///               Asked again for each ring; it may only shrink.
  /// @param visit  visit(entry, image, shift): shift is that of the image [L].
  /// @param pause  pause() after each ring but the innermost: the two first come together.
  template <class Reach, class Visit, class Pause>
  void nearest_first(const Vec3& at, Reach&& reach, Visit&& visit, Pause&& pause) const {
    std::array<Walk, kMostLevels> walks;
    for (std::size_t k = 0; k < levels_.size(); ++k) walks[k] = start(levels_[k], at);
    for (;;) {
      std::size_t next = 0;
      for (std::size_t k = 1; k < levels_.size(); ++k) {
        if (walks[k].distance < walks[next].distance) next = k;
      }
      Walk& walk = walks[next];
      if (walk.distance == kFar) return pause();
      const double far = reach(levels_[next].most_weight);
      if (walk.distance >= far) {
        walk.distance = kFar;
        continue;
      }
      visit_ring(levels_[next], walk, far, visit);
      if (walk.ring > 0) pause();
      advance(levels_[next], walk);
    }
  }

 private:
  static constexpr std::size_t kMostLevels = 8;

  struct Level {
    double most_weight = 0.0;
    std::array<int, 3> dims{1, 1, 1};
    Vec3 low;                         // Corner of the grid.
    Vec3 edge{1, 1, 1};               // Of a grid cell.
    std::vector<std::int32_t> first;  // Of each grid cell into entries, x fastest.
    std::vector<Entry> entries;
  };
  struct Walk {
    std::array<int, 3> home{};
    Vec3 below;  // From the low faces of the home cell to the place.
    int ring = 0;
    double distance = 0.0;  // From the place to all that this and later rings hold, at least.
  };

  [[nodiscard]] Walk start(const Level& level, const Vec3& at) const {
    Walk walk;
    for (std::size_t a = 0; a < dimension_; ++a) {
      const double cells = (at[a] - level.low[a]) / level.edge[a];
      walk.home[a] = std::clamp(static_cast<int>(cells), 0, level.dims[a] - 1);
      walk.below[a] = at[a] - level.low[a] - walk.home[a] * level.edge[a];
    }
    return walk;
  }

  // Along an axis with walls, a side on which the grid has ended is no longer a limit.
  void advance(const Level& level, Walk& walk) const {
    const int ring = walk.ring++;
    double distance = kFar;
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (periodic_[a] || walk.home[a] - ring > 0) {
        distance = std::min(distance, walk.below[a] + ring * level.edge[a]);
      }
      if (periodic_[a] || walk.home[a] + ring < level.dims[a] - 1) {
        distance = std::min(distance, (ring + 1) * level.edge[a] - walk.below[a]);
      }
    }
    walk.distance = std::max(walk.distance, distance);
  }

  // From the place to the grid cells `offset` away from home, along one axis.
  static double gap(const Level& level, const Walk& walk, std::size_t a, int offset) {
    if (offset > 0) return offset * level.edge[a] - walk.below[a];
    if (offset < 0) return walk.below[a] - (offset + 1) * level.edge[a];
    return 0.0;
  }

  template <class Visit>
  void visit_ring(const Level& level, const Walk& walk, double far, Visit& visit) const {
    const int depth = dimension_ == 3 ? walk.ring : 0;
    for (int dz = -depth; dz <= depth; ++dz) {
      const double gap_z = dimension_ == 3 ? gap(level, walk, 2, dz) : 0.0;
      for (int dy = -walk.ring; dy <= walk.ring; ++dy) {
        const double gap_y = gap(level, walk, 1, dy);
        const double left = far * far - gap_z * gap_z - gap_y * gap_y;
        if (left <= 0.0) continue;
        const bool whole =
            std::abs(dy) == walk.ring || (dimension_ == 3 && std::abs(dz) == walk.ring);
        const int step = whole || walk.ring == 0 ? 1 : 2 * walk.ring;
        for (int dx = -walk.ring; dx <= walk.ring; dx += step) {
          const double gap_x = gap(level, walk, 0, dx);
          if (gap_x * gap_x < left) visit_cell(level, walk, {dx, dy, dz}, visit);
        }
      }
    }
  }

  template <class Visit>
  void visit_cell(const Level& level, const Walk& walk, const std::array<int, 3>& offset,
                  Visit& visit) const {
    Image image{};
    std::array<int, 3> index{};
    for (std::size_t a = 0; a < dimension_; ++a) {
      const int n = level.dims[a];
      index[a] = walk.home[a] + offset[a];
      if (index[a] >= 0 && index[a] < n) continue;
      if (!periodic_[a]) return;
      image[a] = index[a] >= 0 ? index[a] / n : -((n - 1 - index[a]) / n);
      index[a] -= image[a] * n;
    }
    const Vec3 shift = image_shift(box_, image);
    const std::size_t cell = cell_index(level, index);
    for (std::int32_t k = level.first[cell]; k < level.first[cell + 1]; ++k) {
      visit(level.entries[static_cast<std::size_t>(k)], image, shift);
    }
  }

  static std::size_t cell_index(const Level& level, const std::array<int, 3>& index) {
    return (static_cast<std::size_t>(index[2]) * level.dims[1] + index[1]) * level.dims[0] +
           index[0];
  }
  void lay_out(Level& level, const std::vector<Site>& sites,
               const std::vector<std::int32_t>& members) const;
  static void drop_repeated(Level& level);
  void fill(Level& level, const std::vector<Site>& sites, const std::vector<std::int32_t>& members);

  Cell box_;
  std::size_t dimension_;
  std::array<bool, 3> periodic_;
  std::vector<Level> levels_;
};

}  // namespace packstone::laguerre
