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
    beyond_.resize(n);
    std::size_t most = 0;
    for (std::size_t k = 0; k < n; ++k) {
      beyond_[k] = corners_[k].at.x * to.x + corners_[k].at.y * to.y - half;
      if (beyond_[k] > beyond_[most]) most = k;
    }
    const double touching = kTouching * std::sqrt(radius_sq_ * norm_sq(to));
    if (n == 0 || beyond_[most] <= touching) return false;
    const auto out = [&](std::size_t k) { return beyond_[k] > touching; };
    std::size_t begin = most, count = 1;  // The corners that go: `count` from `begin`.
    while (count < n && out((begin + n - 1) % n)) begin = (begin + n - 1) % n, ++count;
    while (count < n && out((begin + count) % n)) ++count;
    if (count == n) {
      corners_.clear();
      radius_sq_ = 0.0;
      return true;
    }
    replace(begin, count, plane);
    measure_radius();
    return true;
  }

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  /// Square of the distance from the site to the farthest corner [L^2].
  [[nodiscard]] double radius_sq() const { return radius_sq_; }
  [[nodiscard]] CellMoments moments() const;

  /// Calls visit(plane, points) for each edge; the polygon lies to the left of its two points.
  template <class Visit>
  void for_facets(Visit&& visit) const {
    const std::size_t n = corners_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Corner &before = corners_[(k + n - 1) % n], &here = corners_[k],
                   &after = corners_[(k + 1) % n];
      const std::array<FacetPoint, 2> points = {{{here.at, {before.plane, here.plane, kNoPlane}},
                                                 {after.at, {here.plane, after.plane, kNoPlane}}}};
      visit(here.plane, std::span<const FacetPoint>(points));
    }
  }

 private:
  struct Corner {
    Vec3 at;
    std::int32_t plane = 0;  // Of the edge from here to the next corner.
  };

  void replace(std::size_t begin, std::size_t count, std::int32_t plane) {
    const std::size_t n = corners_.size();
    const std::size_t before = (begin + n - 1) % n, last = (begin + count - 1) % n,
                      after = (begin + count) % n;
    const Vec3 first = crossing(before, begin);
    const Corner second{crossing(after, last), corners_[last].plane};
    kept_.clear();
    for (std::size_t k = 0; k < n - count; ++k) kept_.push_back(corners_[(after + k) % n]);
    kept_.push_back({first, plane});
    kept_.push_back(second);
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
