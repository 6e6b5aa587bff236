#pragma once

/// @file
/// The power cell of each site: what is at least as near to it, in power, as to any other site or
/// image, inside the walls.
///
/// A cell starts as the box around its site, one period long along periodic axes, and is cut by one
/// site after the other, nearest first. Let R be the distance from the site i to the farthest
/// corner of what is left. A site j takes a piece away only if it is nearer in power to some point
/// x of it,
///
///     |x - p_j|^2 - w_j < |x - p_i|^2 - w_i <= R^2 - w_i                                   (1)
///
/// so that |p_j - p_i| <= |x - p_i| + |x - p_j| < R + sqrt(R^2 - w_i + w_j): all that is farther
/// away is left out.
///
/// Sites of one owner follow each other, most of them next to each other: what bounds the cell of
/// the one before is tried first, so that little is left of the box when the search begins.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/parallel.hpp"
#include "tessellate/laguerre/convex_polygon.hpp"
#include "tessellate/laguerre/convex_polyhedron.hpp"
#include "tessellate/laguerre/site.hpp"
#include "tessellate/laguerre/site_grid.hpp"

namespace packstone::laguerre {

/// Builds one power cell after the other in the same memory. Corners depend, within rounding, on
/// which cell came before.
template <class Shape>
class PowerCell {
 public:
  PowerCell(const Cell& box, const std::vector<Site>& sites, const SiteGrid& grid)
      : box_(box), sites_(sites), grid_(grid) {}

  /// Makes this the cell of site `i`.
  void build(std::int32_t i) {
    guess_neighbors(i);
    self_ = i;
    at_ = site(i).at;
    weight_ = site(i).weight;
    start();
    meet_guessed();
    grid_.nearest_first(
        at_, [&](double weight) { return reach(weight); },
        [&](const SiteGrid::Entry& entry, const Image& image, const Vec3& shift) {
          meet(entry, image, entry.at - at_ + shift);
        },
        [&] { cut_met(); });
  }

  /// Relative to the site; planes are numbered as in planes().
  [[nodiscard]] const Shape& shape() const { return shape_; }
  [[nodiscard]] const std::vector<Plane>& planes() const { return planes_; }
  [[nodiscard]] const Plane& plane(std::int32_t k) const {
    return planes_[static_cast<std::size_t>(k)];
  }

 private:
  [[nodiscard]] const Site& site(std::int32_t i) const {
    return sites_[static_cast<std::size_t>(i)];
  }

  // What is left of the cell of the site before, if it has the same owner.
  void guess_neighbors(std::int32_t next) {
    guesses_.clear();
    if (self_ < 0 || site(self_).owner != site(next).owner) return;
    guesses_.push_back({self_, {}, {}});
    shape_.for_facets([&](std::int32_t k, std::span<const FacetPoint>) {
      if (!plane(k).is_wall() && plane(k).site != next) guesses_.push_back(plane(k));
    });
  }

  void meet_guessed() {
    for (const Plane& guess : guesses_) {
      const Site& other = site(guess.site);
      const Vec3 shift = image_shift(box_, guess.image);
      meet({other.at, other.weight, guess.site}, guess.image, other.at - at_ + shift);
    }
    cut_met();
  }

  void start() {
    Vec3 low, high;
    planes_.clear();
    for (std::size_t a = 0; a < static_cast<std::size_t>(box_.dimension); ++a) {
      const bool periodic = box_.periodic[a];
      low[a] = periodic ? -0.5 * box_.size[a] : -at_[a];
      high[a] = periodic ? 0.5 * box_.size[a] : box_.size[a] - at_[a];
      for (const int side : {-1, 1}) {
        Plane plane;
        plane.to[a] = side * (periodic ? box_.size[a] : 1.0);
        plane.site = periodic ? self_ : -1 - (2 * static_cast<int>(a) + (side > 0 ? 1 : 0));
        if (periodic) plane.image[a] = side;
        planes_.push_back(plane);
      }
    }
    shape_.reset(low, high);
  }

  [[nodiscard]] double reach(double weight) const {
    const double power = shape_.radius_sq() - weight_ + weight;
    if (shape_.empty() || power <= 0.0) return 0.0;
    return std::sqrt(shape_.radius_sq()) + std::sqrt(power);
  }

  // A site whose plane may cut, and how far away that stands.
  struct Candidate {
    double distance;
    double half;
    Plane plane;
  };

  void meet(const SiteGrid::Entry& other, const Image& image, const Vec3& to) {
    const double distance_sq = norm_sq(to);
    const double twice = distance_sq + weight_ - other.weight;
    // The plane stands at twice / (2 |to|) from the site.
    if (twice > 0.0 && twice * twice >= 4.0 * distance_sq * shape_.radius_sq()) return;
    if (distance_sq == 0.0) return meet_same_place(other, image, twice);
    const Plane plane{other.site, image, to};
    if constexpr (Shape::kSortsCuts) {
      candidates_.push_back({twice / std::sqrt(distance_sq), 0.5 * twice, plane});
    } else {
      cut(plane, 0.5 * twice);
    }
  }

  // Of sites in one place the heaviest has the cell, of equal ones the first.
  void meet_same_place(const SiteGrid::Entry& other, const Image& image, double twice) {
    if (other.site == self_ || twice > 0.0 || (twice == 0.0 && other.site > self_)) return;
    cut({other.site, image, {}}, -1.0);
  }

  void cut(const Plane& plane, double half) {
    if (shape_.cut(plane.to, half, static_cast<std::int32_t>(planes_.size()))) {
      planes_.push_back(plane);
    }
  }

  // Near planes first, as they leave little for the others to cut.
  void cut_met() {
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    for (const Candidate& candidate : candidates_) {
      const double beyond = candidate.distance;
      if (beyond > 0.0 && beyond * beyond >= 4.0 * shape_.radius_sq()) break;
      cut(candidate.plane, candidate.half);
    }
    candidates_.clear();
  }

  const Cell& box_;
  const std::vector<Site>& sites_;
  const SiteGrid& grid_;
  Shape shape_;
  std::vector<Plane> planes_;
  std::vector<Candidate> candidates_;
  std::vector<Plane> guesses_;
  std::int32_t self_ = -1;
  Vec3 at_;
  double weight_ = 0.0;
};

/// Sites that one thread looks at in a row.
inline constexpr std::int64_t kBlock = 256;
inline std::int64_t block_count(const std::vector<Site>& sites) {
  return (static_cast<std::int64_t>(sites.size()) + kBlock - 1) / kBlock;
}

template <class Shape, class Visit>
void for_power_cells_of(const Cell& box, const std::vector<Site>& sites, int threads,
                        Visit& visit) {
  const SiteGrid grid(box, sites);
  const auto count = static_cast<std::int64_t>(sites.size());
  parallel_for(block_count(sites), threads, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t block = begin; block < end; ++block) {
      PowerCell<Shape> cell(box, sites, grid);
      for (std::int64_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
        cell.build(static_cast<std::int32_t>(i));
        visit(block, static_cast<std::int32_t>(i), cell);
      }
    }
  });
}

/// Calls visit(block, i, cell) for every site i, with a PowerCell of polygons or polyhedra; those
/// of one block in order and by one thread, different blocks at once.
template <class Visit>
void for_power_cells(const Cell& box, const std::vector<Site>& sites, int threads, Visit&& visit) {
  if (box.dimension == 2) {
    for_power_cells_of<ConvexPolygon>(box, sites, threads, visit);
  } else {
    for_power_cells_of<ConvexPolyhedron>(box, sites, threads, visit);
  }
}

}  // namespace packstone::laguerre
