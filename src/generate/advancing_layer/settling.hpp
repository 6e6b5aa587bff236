#pragma once

/// @file
/// Letting a body that keeps its orientation come to rest among others: by linear programs.
///
/// The gap of two convex bodies under translation, gap = max over unit d of d.r - S_a(d) - S_b(-d),
/// is convex in r. So with g = d.r - S_a(d) - S_b(-d) at any unit d whatever, and d from the moving
/// body to the other, a step x with
///
///     d . x <= g                                                                             (1)
///
/// keeps them apart: a half-space of steps per neighbor that is certain, and at the best d also
/// touches the gap. The lowest step in all of them, in the walls and in a box about the body is a
/// linear program; body after step comes to rest where two (2D) or three (3D) neighbors or walls
/// hold it, without ever overlapping.

#include <cstdint>
#include <vector>

#include "generate/advancing_layer/linear_program.hpp"
#include "geometry/posed_body.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"

namespace packstone::advancing_layer {

/// A body that is being placed.
struct Mover {
  PosedBody body;     ///< About the origin.
  Vec3 half_extents;  ///< Of its box [L].
  double thickness;   ///< Radius of the largest ball inside [L].
  double reach;       ///< Largest of the half extents [L].

  explicit Mover(const Body& body);
};

/// @tparam D  Dimension of the cell.
template <int D>
class Settling {
 public:
  static constexpr std::size_t kUp = D - 1;

  /// A neighbor of the mover, and the half-space that it leaves.
  struct Neighbor {
    std::int32_t id;
    HierarchicalGrid::Image image;
    Vec3 center;   // Of this image.
    Vec3 d;        // From the mover to it, see (1); 0 when it is new.
    double room;   // g less the least gap.
    bool is_near;  // Whether `room` is within the limit it was looked for.
  };
  /// What one body at a time needs to settle; may be used again.
  struct Workspace {
    std::vector<Neighbor> neighbors, before;
    std::vector<HalfSpace> sides;
  };

  /// @param min_gap  Least gap of two bodies [L].
  /// @param slack    See contact_slack() [L].
  Settling(const Cell& cell, double min_gap, double slack, std::int64_t count);

  /// A body that stands; its center lies in the cell.
  void add(const Mover& mover, const Vec3& center);

  /// See Pockets::open_floor().
  void open_floor() { floor_ = false; }

  /// Moves a body that overlaps a little until it overlaps nothing. False where that fails.
  bool push_out(const Mover& mover, Vec3& center, Workspace& work, int most_rounds) const;

  /// Lowers a body that overlaps nothing until it rests. False where it overlaps.
  bool drop(const Mover& mover, Vec3& center, Workspace& work) const;

  /// Whether it overlaps nothing, walls and ceiling included, for certain.
  bool is_clear(const Mover& mover, const Vec3& center, Workspace& work) const;

 private:
  enum class Care { quick, thorough };

  void gather(const Mover& mover, const Vec3& center, double reach, Workspace& work) const;
  void look_at(const Mover& mover, const Vec3& center, Neighbor& neighbor, double limit,
               Care care) const;
  [[nodiscard]] bool has_floor(std::size_t axis) const;
  template <class Visit>
  void for_walls(const Mover& mover, const Vec3& center, Visit&& visit) const;
  double measure(const Mover& mover, const Vec3& center, double limit, Care care,
                 Workspace& work) const;

  Cell cell_;
  double min_gap_;
  double slack_;
  bool floor_ = true;
  HierarchicalGrid grid_;
  std::vector<PosedBody> bodies_;
};

}  // namespace packstone::advancing_layer
