#pragma once

/// @file
/// A convex polyhedron that half-spaces are cut off from, each face knowing what cut it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "packstone/core/vec.hpp"
#include "tessellate/laguerre/convex_cell.hpp"

namespace packstone::laguerre {

/// A power cell in space, relative to its site.
///
/// Kept as its corners, three planes in each, so that the dual is a triangulated sphere; where more
/// planes meet, several corners stand in one place. A cut takes corners off and puts one on every
/// edge that it crosses; the crossed edges, in the order of the planes on their sides, close a
/// cycle (N. Ray, D. Sokolov, S. Lefebvre, B. Levy, ACM Trans. Graph. 37 (2018) 265).
class ConvexPolyhedron {
 public:
  /// Whether a cut costs so much that it pays to sort them by distance.
  static constexpr bool kSortsCuts = true;

  /// The box [low, high], its faces -x, +x, -y, +y, -z, +z numbered 0 to 5.
  void reset(const Vec3& low, const Vec3& high);

  /// Takes off all with x.to > half. Returns whether anything went.
  bool cut(const Vec3& to, double half, std::int32_t plane);

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  /// Square of the distance from the site to the farthest corner [L^2].
  [[nodiscard]] double radius_sq() const { return radius_sq_; }
  [[nodiscard]] CellMoments moments() const;

  /// Calls visit(plane, points) for each face, its points counterclockwise seen from outside.
  template <class Visit>
  void for_facets(Visit&& visit) const {
    std::vector<FacetPoint>& points = loop_;
    find_faces();
    for (std::size_t p = 0; p < corner_on_.size(); ++p) {
      const auto plane = static_cast<std::int32_t>(p);
      if (!walk_face(plane, points)) continue;
      visit(plane, std::span<const FacetPoint>(points));
    }
  }

 private:
  // Edge k lies between planes k and k + 1, counterclockwise about the corner seen from outside.
  struct Corner {
    Vec3 at;
    std::array<std::int32_t, 3> planes;
    std::array<std::int32_t, 3> across;  // The corner at the other end of edge k.
  };

  [[nodiscard]] static std::size_t slot_of(const std::array<std::int32_t, 3>& list,
                                           std::int32_t value) {
    return list[0] == value ? 0 : list[1] == value ? 1 : 2;
  }
  void find_faces() const;
  bool walk_face(std::int32_t plane, std::vector<FacetPoint>& points) const;
  bool add_horizon(std::int32_t plane);
  void link_horizon(std::size_t first);
  void drop_gone();
  void measure_radius();

  std::vector<Corner> corners_;
  std::vector<double> beyond_;
  std::vector<char> gone_;
  std::vector<std::int32_t>
      from_;  // Of each plane: the new corner whose horizon edge begins there.
  std::vector<std::int32_t> moved_to_;
  mutable std::vector<std::int32_t> corner_on_;  // Of each plane: a corner, or -1.
  mutable std::vector<FacetPoint> loop_;
  std::int32_t planes_ = 0;
  double radius_sq_ = 0.0;
};

}  // namespace packstone::laguerre
