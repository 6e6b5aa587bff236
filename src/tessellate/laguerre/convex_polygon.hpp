#pragma once

/// @file
/// A convex polygon that half-planes are cut off from, each edge knowing what cut it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "packstone/core/vec.hpp"
#include "tessellate/laguerre/convex_cell.hpp"

namespace packstone::laguerre {

/// A power cell in the plane, relative to its site.
class ConvexPolygon {
 public:
  /// Whether a cut costs so much that it pays to sort them by distance.
  static constexpr bool kSortsCuts = false;

  /// The rectangle [low, high], its edges -x, +x, -y, +y numbered 0 to 3.
  void reset(const Vec3& low, const Vec3& high) {
    corners_ = {{{low.x, low.y, 0}, 2},
                {{high.x, low.y, 0}, 1},
                {{high.x, high.y, 0}, 3},
                {{low.x, high.y, 0}, 0}};
    measure_radius();
  }

  /// Takes off all with x.to > half. Returns whether anything went.
  bool cut(const Vec3& to, double half, std::int32_t plane) {
    const std::size_t n = corners_.size();
    if (beyond_.size() < n) beyond_.resize(n);
    std::size_t most = 0;
    double farthest = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double beyond = corners_[k].at.x * to.x + corners_[k].at.y * to.y - half;
      beyond_[k] = beyond;
      if (beyond > farthest) farthest = beyond, most = k;
    }
    if (farthest <= 0.0) return false;
    const double touching = kTouching * std::sqrt(radius_sq_ * norm_sq(to));
    if (beyond_[most] <= touching) return false;
    std::size_t first = most, last = most, count = 1;  // The corners that go, `count` of them.
    while (count < n && beyond_[before(first)] > touching) first = before(first), ++count;
    while (count < n && beyond_[after(last)] > touching) last = after(last), ++count;
    if (count == n) {
      corners_.clear();
      radius_sq_ = 0.0;
      return true;
    }
    replace(first, last, n - count, plane);
    return true;
  }

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  /// Square of the distance from the site to the farthest corner [L^2].
  [[nodiscard]] double radius_sq() const { return radius_sq_; }
  [[nodiscard]] CellMoments moments() const;

  /// Calls visit(plane, points) for each edge; the polygon lies to the left of its two points.
  template <class Visit>
  void for_facets(Visit&& visit) const {
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Corner &prior = corners_[before(k)], &here = corners_[k], &next = corners_[after(k)];
      const std::array<FacetPoint, 2> points = {{{here.at, {prior.plane, here.plane, kNoPlane}},
                                                 {next.at, {here.plane, next.plane, kNoPlane}}}};
      visit(here.plane, std::span<const FacetPoint>(points));
    }
  }

 private:
  struct Corner {
    Vec3 at;
    std::int32_t plane = 0;  // Of the edge from here to the next corner.
  };

  [[nodiscard]] std::size_t before(std::size_t k) const {
    return k > 0 ? k - 1 : corners_.size() - 1;
  }
  [[nodiscard]] std::size_t after(std::size_t k) const {
    return k + 1 < corners_.size() ? k + 1 : 0;
  }

  void replace(std::size_t first, std::size_t last, std::size_t stay, std::int32_t plane) {
    const Corner entry{crossing(before(first), first), plane};
    const Corner exit{crossing(after(last), last), corners_[last].plane};
    kept_.resize(stay + 2);
    radius_sq_ = std::max(norm_sq(entry.at), norm_sq(exit.at));
    for (std::size_t m = 0, k = after(last); m < stay; ++m, k = after(k)) {
      kept_[m] = corners_[k];
      radius_sq_ = std::max(radius_sq_, norm_sq(kept_[m].at));
    }
    kept_[stay] = entry;
    kept_[stay + 1] = exit;
    std::swap(corners_, kept_);
  }

  // On the way from a corner that stays to one that goes.
  [[nodiscard]] Vec3 crossing(std::size_t stays, std::size_t goes) const {
    const double inside = std::max(0.0, -beyond_[stays]);
    const Vec3& a = corners_[stays].at;
    return a + inside / (inside + beyond_[goes]) * (corners_[goes].at - a);
  }

  void measure_radius() {
    radius_sq_ = 0.0;
    for (const Corner& corner : corners_) radius_sq_ = std::max(radius_sq_, norm_sq(corner.at));
  }

  std::vector<Corner> corners_;
  std::vector<Corner> kept_;
  std::vector<double> beyond_;
  double radius_sq_ = 0.0;
};

inline CellMoments ConvexPolygon::moments() const {
  CellMoments sum;
  for (std::size_t k = 0, n = corners_.size(); k < n; ++k) {
    const Vec3& a = corners_[k].at;
    const Vec3& b = corners_[k + 1 < n ? k + 1 : 0].at;
    const double area = 0.5 * (a.x * b.y - a.y * b.x);
    sum.measure += area;
    sum.first += area / 3.0 * (a + b);
    sum.second = sum.second + area / 12.0 * (dyad(a) + dyad(b) + dyad(a + b));
  }
  return sum;
}

}  // namespace packstone::laguerre
