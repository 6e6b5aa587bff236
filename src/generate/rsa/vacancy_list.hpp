#pragma once

/// @file
/// Where may one more body stand? A list of cells of poses that may still hold one.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/pose.hpp"
#include "generate/rsa/standing.hpp"
#include "generate/rsa/trial_numbers.hpp"
#include "generate/rsa/voxel_mask.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/run_context.hpp"

namespace packstone::rsa {

/// Cells of poses (center, and orientation where it is redrawn) of one body that are not proven to
/// be empty. All cells of the list have the same measure, and together they hold every pose in
/// which the body fits.
///
/// A cell is dropped when one placed image overlaps every member of the cell. For a body K of fixed
/// orientation the centers that overlap an image B form the Minkowski sum B + (-K), which is convex
/// as B and K are; with a least gap it is dilated by a ball and stays convex. So a box of centers
/// whose corners are proven to overlap B lies in that sum with all its points. For a cell of
/// orientations, K is replaced by bodies that every member contains: the set of centers from which
/// all members overlap B is an intersection of such convex sets, hence convex. Where K is a ball,
/// images that cover a box only together are seen as well: BoxCuts.
class VacancyList {
 public:
  /// @param mask  Voxels left for the core of the candidate, to start from; else null.
  VacancyList(const PlacedBodies& placed, const Candidate& candidate, Turning turning,
              const VoxelMask* mask = nullptr);

  [[nodiscard]] const Body& body() const { return candidate_.body; }
  [[nodiscard]] Turning turning() const { return turning_; }
  [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(cells_.size()); }

  /// Part of all poses that the list holds [-].
  [[nodiscard]] double part() const;

  /// False when cells have become too many or too small to go on.
  [[nodiscard]] bool can_split() const;

  /// Cost of the next split, as foreseen from the last one.
  [[nodiscard]] std::int64_t expected_split_cost() const;

  /// Part of the children that the last split has kept [-]; small where splitting pays.
  [[nodiscard]] double kept_by_last_split() const { return kept_by_last_split_; }

  /// Splits every cell, in its box or in its orientation, whichever blurs the pose more, and drops
  /// the children that are proven to be empty. Returns the cost. When `run` asks to stop, the list
  /// is left as it was.
  std::int64_t split(const RunContext& run);

  /// Takes notice of the body that was placed last. Returns the cost.
  std::int64_t add_last_placed();

  /// A pose drawn uniformly from all cells, the turn as numbers only: most poses are seen not to
  /// fit before a body is turned.
  struct Pose {
    Vec3 center;
    std::int32_t cell;
    double u, v;          ///< Where in the cell of orientations.
    Quaternion rotation;  ///< For Turning::full instead.
  };
  [[nodiscard]] Pose draw(TrialNumbers::Row numbers) const;

  /// The body in that pose.
  [[nodiscard]] Candidate turned(const Pose& pose) const;

  /// Does the body fit there? Adds to `cost`.
  [[nodiscard]] bool fits(const Pose& pose, std::int64_t& cost) const;

 private:
  struct PoseCell {
    std::array<std::int32_t, 3> index;
    std::int32_t orientation;
  };
  struct Box {
    Vec3 middle;
    Vec3 half;
  };
  // Cells with the images that can touch a member: those of cell k end at neighbor_ends[k].
  struct Cells {
    std::vector<PoseCell> cells;
    std::vector<std::int32_t> neighbors;
    std::vector<std::int64_t> neighbor_ends;
    std::int64_t cost = 0;
  };
  struct Division {
    std::array<std::int32_t, 3> counts{1, 1, 1};     // Powers of two.
    std::array<double, 3> per_count{1.0, 1.0, 1.0};  // 1 / counts, exact.
    OrientationCells orientations;
  };

  void start_with_all();
  void start_with(const VoxelMask& mask);
  void pick_near(const std::vector<std::int32_t>& images, std::size_t axis, const Box& box,
                 std::vector<std::int32_t>& near, std::int64_t& cost) const;
  [[nodiscard]] double edge_at(const Division& division, std::size_t axis,
                               std::int32_t index) const;
  [[nodiscard]] Box box_of(const Division& division, const PoseCell& cell) const;
  [[nodiscard]] std::span<const std::int32_t> neighbors_of(std::int64_t cell) const;
  [[nodiscard]] bool ball_fits(const Pose& pose, std::int64_t& cost) const;
  [[nodiscard]] bool stands_apart(const Candidate& candidate, const Pose& pose,
                                  std::int64_t& cost) const;
  [[nodiscard]] std::vector<CommonCore> cores_of(const OrientationCells& orientations) const;
  [[nodiscard]] CommonCore make_core(const OrientationCells& orientations, std::int32_t cell) const;
  const CommonCore& core_of(const Division& division, const std::vector<CommonCore>& cores,
                            std::int32_t orientation, CommonCore& storage) const;
  [[nodiscard]] bool splits_orientation() const;
  void split_cell(std::int64_t parent, const Division& finer, const std::vector<CommonCore>& cores,
                  Cells& out) const;
  void keep_unless_empty(const PoseCell& cell, const CommonCore& core, const Box& box,
                         std::span<const std::int32_t> images, std::span<const std::int32_t> known,
                         Cells& out) const;
  void take(Cells&& cells);
  bool is_empty(const CommonCore& core, const Box& box, std::span<const std::int32_t> images,
                std::vector<std::int32_t>& kept, std::int64_t& cost) const;
  [[nodiscard]] bool walls_forbid(const CommonCore& core, const Box& box) const;
  [[nodiscard]] bool covers(std::int32_t image, const CommonCore& core, const Box& box,
                            std::int64_t& cost) const;
  [[nodiscard]] bool always_overlaps(std::int32_t body, const CommonCore& core, const Vec3& r,
                                     std::int64_t& cost) const;
  [[nodiscard]] bool thin_core_meets(const CommonCore& core, const Outline& other,
                                     const Vec3& r) const;

  const PlacedBodies& placed_;
  Candidate candidate_;
  Turning turning_;
  bool may_meet_own_image_;
  CenterBox domain_;
  std::array<double, 3> origin_, end_, length_;  // Of domain_, axis by axis.
  std::size_t dimension_;
  std::vector<PlacedImage> images_;
  std::int32_t noticed_ = 0;  // Placed bodies whose images are in images_.
  Division division_;
  std::vector<CommonCore> cores_;  // By orientation cell; empty when they are too many.
  std::vector<PoseCell> cells_;
  std::vector<std::int32_t> neighbors_;
  std::vector<std::int64_t> neighbor_ends_;
  std::int64_t last_split_cost_ = 0;
  std::int64_t last_split_children_ = 1;
  double kept_by_last_split_ = 1.0;
};

}  // namespace packstone::rsa
