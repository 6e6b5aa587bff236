#pragma once

/// @file
/// Which voxels of the cell may still hold the center of one more body?

#include <array>
#include <cstdint>
#include <vector>

#include "generate/rsa/outline.hpp"
#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/standing.hpp"
#include "generate/rsa/trial_numbers.hpp"

namespace packstone::rsa {

/// A lattice of voxels over all centers, those struck out that are proven to hold none.
///
/// A voxel is struck out when all its corners lie in the contact region F(B) = B + (-K) of one
/// image B, which is convex; see VacancyList. Here K is a ball that the body on trial holds however
/// it is turned, so that one mask serves all bodies with the same inscribed ball. A line of corners
/// meets F(B) in one run; only its ends are looked for.
class VoxelMask {
 public:
  /// @param ball    Radius of the inscribed ball [L].
  /// @param domain  Where centers may be; flat in two dimensions.
  VoxelMask(const PlacedBodies& placed, double ball, const CenterBox& domain);

  /// Is it a mask for that ball there?
  [[nodiscard]] bool serves(double ball, const CenterBox& domain) const;

  /// Takes notice of the bodies placed since.
  void notice_placed();
  /// What notice_placed() will cost, nearly, in the units of Cost.
  [[nodiscard]] std::int64_t expected_cost() const;

  /// Voxels left.
  [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(left_.size()); }
  /// Part of all voxels that is left [-].
  [[nodiscard]] double part() const;

  /// Voxels along each axis.
  [[nodiscard]] const std::array<std::int32_t, 3>& counts() const { return counts_; }
  /// Place of voxel k of those left, axis by axis.
  [[nodiscard]] std::array<std::int32_t, 3> index(std::int64_t k) const;

  /// A center drawn uniformly from the voxels left; takes up to four words.
  [[nodiscard]] Vec3 draw(TrialNumbers::Row& numbers) const;

 private:
  // A line of corners fits a word, one bit each.
  static constexpr std::int32_t kMostAlongAxis = 48;
  using Line = std::uint64_t;
  struct Range {
    std::int32_t first, last;
  };
  class BallRegion;

  [[nodiscard]] double corner(std::size_t axis, std::int32_t index) const;
  [[nodiscard]] Range corners_within(std::size_t axis, double low, double high) const;
  void strike_out(const PlacedImage& image);
  void strike_out_in(BallRegion& region, const Range& y, const Range& z);
  [[nodiscard]] Line corners_in(BallRegion& region, std::int32_t y, std::int32_t z) const;
  void list_left();

  const PlacedBodies& placed_;
  double ball_;
  std::size_t dimension_;
  std::array<double, 3> origin_, end_, length_;
  std::array<std::int32_t, 3> counts_{1, 1, 1};
  std::array<double, 3> per_count_{1.0, 1.0, 1.0};
  std::array<double, 3> per_edge_{};
  std::array<std::array<double, kMostAlongAxis + 1>, 3> corners_;
  std::int32_t noticed_ = 0;
  std::vector<Line> open_;          // Rows of voxels along x, a bit set where one is left.
  std::vector<std::int32_t> left_;  // Places: ten bits for each axis.
};

}  // namespace packstone::rsa
