#pragma once

/// @file
/// Which orientations a body takes in trials, and cells of orientations with what all members of a
/// cell have in common.

#include <array>
#include <cstdint>

#include "generate/rsa/outline.hpp"
#include "generate/rsa/trial_numbers.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone::rsa {

/// What changes when a body is turned at random.
enum class Turning {
  none,      ///< Nothing: the orientation is kept, or the body is round.
  in_plane,  ///< An angle in [0, pi): ellipses.
  of_axis,   ///< The symmetry axis on the half sphere: bodies of revolution.
  full,      ///< All of SO(3): ellipsoids with three different semi-axes.
};

[[nodiscard]] Turning turning_of(const Body& body, bool redraw) noexcept;

/// `body` in an orientation that is the same for all that differ in orientation alone.
[[nodiscard]] Body in_standard_pose(const Body& body, Turning turning) noexcept;

/// A direction uniform on the sphere, by at most four words of `numbers`.
[[nodiscard]] Vec3 axis_at_random(TrialNumbers::Row& numbers) noexcept;

/// `body` with an orientation uniform over all, by at most four words of `numbers`.
[[nodiscard]] Body turned_at_random(const Body& body, Turning turning,
                                    TrialNumbers::Row& numbers) noexcept;

/// A division of all orientations into cells of equal measure.
///
/// in_plane: equal intervals. of_axis: half of the pixels of HEALPix (one of each antipodal pair),
/// 6 base pixels, each split in 4: K. M. Gorski et al., Astrophys. J. 622 (2005) 759-771.
class OrientationCells {
 public:
  explicit OrientationCells(Turning turning) noexcept : turning_(turning) {}

  [[nodiscard]] std::int32_t count() const noexcept;
  /// Children of a cell when split() is called: first_child(cell) and those that follow.
  [[nodiscard]] int branching() const noexcept;
  [[nodiscard]] std::int32_t first_child(std::int32_t cell) const noexcept {
    return cell * branching();
  }
  void split() noexcept { ++level_; }

  /// Cells that can be split further are left: `full` has one cell for ever.
  [[nodiscard]] bool can_split() const noexcept { return branching() > 1 && level_ < kMaxLevel; }
  /// No orientation of any cell is farther than this from the middle of the cell [rad].
  [[nodiscard]] double widest() const noexcept;

  /// The body turned to the point (u, v) in [0, 1)^2 of the cell, the measure being uniform there.
  [[nodiscard]] Body turned(const Body& body, std::int32_t cell, double u, double v) const noexcept;

  /// The largest angle from the middle of the cell to any member [rad].
  [[nodiscard]] double angle(std::int32_t cell) const noexcept;

 private:
  static constexpr int kMaxLevel = 12;
  Turning turning_;
  int level_ = 0;
};

/// What all bodies of one orientation cell have in common, and what their middle looks like.
struct CommonCore {
  Body middle;                   ///< The member in the middle of the cell.
  Outline middle_outline;        ///< Of it.
  double angle = 0.0;            ///< Members are turned away from it by at most this [rad].
  double swing = 0.0;            ///< Capsules of members lie within this of that of the middle [L].
  bool meets_own_image = false;  ///< All members overlap an own image, wherever they stand.
  int part_count = 0;            ///< Bodies about the center that every member contains; the middle
                                 ///< itself where angle = 0.
  std::array<Body, 4> parts;
  std::array<Outline, 4> outlines;
};

/// `middle` and what is left of it when it may turn by `angle` to any side.
[[nodiscard]] CommonCore common_core(const Body& middle, double angle) noexcept;

}  // namespace packstone::rsa
