#pragma once

/// @file
/// Near neighbors: for every body the others that it may meet before either leaves its
/// neighborhood.
///
/// Two bodies, or images of them, are neighbors when their neighborhoods meet; as long as both stay
/// inside theirs no others can touch. Scaling the shape to make the neighborhood, as A. Donev,
/// S. Torquato and F. H. Stillinger (J. Comput. Phys. 202 (2005) 737-793) do, gives needles no room
/// across and too much along their axis; a margin of one width all around does not.

#include <cstdint>
#include <span>
#include <vector>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/contact_search.hpp"
#include "generate/event_driven/neighborhoods.hpp"
#include "packstone/core/cell.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::event_driven {

/// The lists of all bodies.
class NearNeighbors {
 public:
  NearNeighbors(const Bodies& bodies, const Cell& cell);

  /// Makes all lists anew; all clocks stand at `t`.
  void rebuild_all(double t);

  /// Makes the neighborhood of body i and its list anew; its clock stands at `t`.
  void rebuild(std::int32_t i, double t);

  [[nodiscard]] std::span<Neighbor> of(std::int32_t i) { return lists_.of(i); }

  /// When body i, its clock at t, may leave its neighborhood.
  [[nodiscard]] double exit_time(std::int32_t i, double t) const { return near_.exit_time(i, t); }

  /// Part of the margin that body i has left, its clock at t [-].
  [[nodiscard]] double room_left(std::int32_t i, double t) const {
    return near_.room_left(i, t) / near_.margin(i);
  }

  [[nodiscard]] Partner partner(const Neighbor& neighbor) const {
    return {neighbor.body,
            {neighbor.image[0] * cell_.size.x, neighbor.image[1] * cell_.size.y,
             neighbor.image[2] * cell_.size.z}};
  }

  [[nodiscard]] std::int64_t rebuilds() const { return rebuilds_; }

 private:
  void settle_margins(double t);
  void stand_all(double t, double margin);
  void gather(std::int32_t i);
  void join(std::int32_t i);
  void add_walls(std::int32_t i);
  [[nodiscard]] double adapted_margin(std::int32_t i) const;

  const Bodies& bodies_;
  Cell cell_;
  CapsuleGrid grid_;
  CapsuleGrid::Scratch scratch_;
  std::vector<double> margin_scale_;  // What margins are measured in [L].
  Neighborhoods near_;
  NeighborLists lists_;
  double wanted_ = 0.0;       // Neighbors of a body.
  double mean_margin_ = 0.0;  // Over margin_scale_.
  std::vector<Neighbor> candidates_;
  std::vector<double> gaps_;
  std::int64_t rebuilds_ = 0;
};

}  // namespace packstone::event_driven
