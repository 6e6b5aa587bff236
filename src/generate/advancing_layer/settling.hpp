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
/// linear program; step after step the body comes to rest where two (2D) or three (3D) neighbors or
/// walls hold it, without ever overlapping.
///
/// As g is linear in r, a half-space of (1) stays certain wherever the body goes: only those that
/// are in its way are looked at again, the others cost a scalar product a step.

#include <cstdint>
#include <vector>

#include "generate/advancing_layer/linear_program.hpp"
#include "generate/advancing_layer/solid_gap.hpp"
#include "geometry/posed_body.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"

namespace packstone::advancing_layer {

/// A body that is being placed.
struct Mover {
  PosedBody body;        ///< About the origin.
  SolidEllipsoid solid;  ///< The same, where it is one.
  Vec3 half_extents;     ///< Of its box [L].
  double thickness;      ///< Radius of the largest ball inside [L].
  double reach;          ///< Largest of the half extents [L].

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
    Vec3 center;    // Of this image.
    Vec3 d;         // From the mover to it, see (1); 0 when it is new.
    double beyond;  // d . x <= beyond for a center x of the mover is certain to keep the gap.
  };
  /// What one body at a time needs to settle; may be used again.
  struct Workspace {
    std::vector<Neighbor> neighbors, before;
    std::vector<HalfSpace> sides;
    Vec3 gathered;        // The neighbors are all those about this center ...
    double reach = -1.0;  // ... whose boxes come so near [L]; < 0: none are known.
  };

  /// How a body came to lie.
  enum class Outcome {
    rests,     ///< Where it overlaps nothing and cannot sink.
    overlaps,  ///< It does not come out of what it overlaps.
    lags,      ///< It would hardly end below the height that is known to be reached.
  };

  /// @param min_gap  Least gap of two bodies [L].
  /// @param slack    See contact_slack() [L].
  Settling(const Cell& cell, double min_gap, double slack, std::int64_t count);

  /// A body that stands; its center lies in the cell.
  void add(const Mover& mover, const Vec3& center);

  /// See Pockets::open_floor().
  void open_floor() { floor_ = false; }

  /// Moves a body that overlaps a little until it overlaps nothing, then lowers it until it rests.
  ///
  /// @param center  From where to where; only where it rests, it is certain to be anywhere.
  /// @param known   A height that another place is known to have [L].
  Outcome settle(const Mover& mover, Vec3& center, double known, Workspace& work) const;

  /// Whether it overlaps nothing, walls and ceiling included, for certain.
  bool is_clear(const Mover& mover, const Vec3& center, Workspace& work) const;

 private:
  struct Standing {
    PosedBody body;
    SolidEllipsoid solid;
  };

  bool push_out(const Mover& mover, Vec3& center, Workspace& work) const;
  Outcome drop(const Mover& mover, Vec3& center, double known, Workspace& work) const;
  void keep_near(const Mover& mover, const Vec3& center, double limit, Workspace& work) const;
  void gather(const Mover& mover, const Vec3& center, double reach, Workspace& work) const;
  double turn(const Mover& mover, const Vec3& center, Neighbor& neighbor, double limit,
              int most_steps) const;
  double room(const Mover& mover, const Vec3& center, Neighbor& neighbor) const;
  bool keeps_off(const Mover& mover, const Vec3& center, Neighbor& neighbor, double least) const;
  [[nodiscard]] bool has_floor(std::size_t axis) const;
  template <class Visit>
  void for_walls(const Mover& mover, const Vec3& center, Visit&& visit) const;
  double measure(const Mover& mover, const Vec3& center, Workspace& work) const;

  Cell cell_;
  double min_gap_;
  double slack_;
  bool floor_ = true;
  HierarchicalGrid grid_;
  std::vector<Standing> bodies_;
};

}  // namespace packstone::advancing_layer
