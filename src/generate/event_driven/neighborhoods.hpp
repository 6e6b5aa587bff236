#pragma once

/// @file
/// Neighborhoods of bodies, and who is near whom by them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/plane_search.hpp"
#include "generate/event_driven/reference_lanes.hpp"
#include "packstone/core/cell.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::event_driven {

/// The neighborhood of a body is its shape as it stood at some instant, at the size it had then,
/// with a margin all around (its Minkowski sum with a ball). How much of the margin the body has
/// used since, with c its center, s its size factor, R its circumscribed radius and l the greatest
/// slope of its support function on the unit sphere:
///
///     |c - c_0| + s_0 l angle + (s - s_0) R                                                 (1)
///
/// Where a least gap is to be kept, neighborhoods meet that come within it.
class Neighborhoods {
 public:
  Neighborhoods(const Bodies& bodies, const Cell& cell);

  /// Takes the pose of body i at t, its clock then or before.
  void set(std::int32_t i, double t, double margin);

  [[nodiscard]] double margin(std::int32_t i) const { return margin_[static_cast<std::size_t>(i)]; }
  /// Radius of a ball about the center that holds the neighborhood, and half of the least gap [L].
  [[nodiscard]] double reach(std::int32_t i) const;
  /// A capsule that holds the same, its center wrapped into the cell.
  [[nodiscard]] Capsule capsule(std::int32_t i) const;
  /// The neighbor that the image of body j, `image` periods off its place, is of body i at its own.
  [[nodiscard]] Neighbor neighbor(std::int32_t i, std::int32_t j,
                                  const std::array<int, 3>& image) const;
  /// What of its margin body i has left, its clock at t [L].
  [[nodiscard]] double room_left(std::int32_t i, double t) const;
  /// When it may have left its neighborhood. Not after it has turned by kMostTurn.
  [[nodiscard]] double exit_time(std::int32_t i, double t) const;

  /// Lower bounds on the gaps between body i and `others` as they stand in their neighborhoods [L].
  void bound_gaps(std::int32_t i, std::span<const Neighbor> others, double* gaps) const;
  /// Strikes those out of `others` whose neighborhoods do not meet that of body i.
  void keep_near(std::int32_t i, std::vector<Neighbor>& others) const;
  /// The same to a wall.
  [[nodiscard]] double wall_gap(std::int32_t i, int axis, bool high) const;

 private:
  [[nodiscard]] PosedBody body(std::int32_t i) const;
  [[nodiscard]] float ball_like(std::int32_t i, std::int32_t j) const;

  const Bodies& bodies_;
  Cell cell_;
  std::vector<double> slope_;  // l of equation (1) [L].
  bool revolution_;            // Balls and spheroids alone.
  mutable std::vector<double> gaps_;
  std::vector<StandingLine> line_;
  std::vector<Vec3> second_;  // Empty where no body is scalene.
  std::vector<double> size_;  // Size factor.
  std::vector<double> margin_;
  std::vector<std::array<std::int16_t, 3>> wraps_;  // Periods from place to center.
};

/// Lists of neighbors, mutual: whoever is in the list of another has it in its own. Own images and
/// walls stand in one list.
class NeighborLists {
 public:
  void reset(std::int32_t bodies);

  [[nodiscard]] std::span<Neighbor> of(std::int32_t i) {
    const Extent& e = extents_[static_cast<std::size_t>(i)];
    return {pool_.data() + e.first, static_cast<std::size_t>(e.size)};
  }
  [[nodiscard]] std::int32_t size(std::int32_t i) const {
    return extents_[static_cast<std::size_t>(i)].size;
  }
  /// Into the lists of both.
  void add(std::int32_t i, const Neighbor& neighbor);
  /// Takes body i out of all lists, and all out of its own.
  void remove(std::int32_t i);

 private:
  struct Extent {
    std::int64_t first = 0;
    std::int32_t size = 0;
    std::int32_t capacity = 0;
  };
  void append(std::int32_t i, const Neighbor& neighbor);

  std::vector<Extent> extents_;
  std::vector<Neighbor> pool_;
};

/// The same pair, seen from the neighbor.
[[nodiscard]] Neighbor reversed(const Neighbor& neighbor, std::int32_t i);

}  // namespace packstone::event_driven
