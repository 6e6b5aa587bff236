#pragma once

/// @file
/// Where the axis of one more rod cannot pass: most trials with rods end here.

#include <array>
#include <cstdint>
#include <vector>

#include "generate/rsa/outline.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::rsa {

/// The cell in voxels, some of them closed: every point of them is so near the axis of a body that
/// stands that a rod whose axis passes there overlaps it for certain. Of flat-ended rods the part
/// of the axis counts that is a radius away from the ends; of an ellipsoid its center.
///
/// A look follows the axis from voxel to voxel. It finds most overlaps, and finds them early where
/// there are many.
class AxisMask {
 public:
  /// @param thinnest  Least radius of a ball on the axis of a body to come [L], > 0.
  AxisMask(const Cell& cell, double min_gap, double thinnest);

  /// Would there be so many voxels that they are left out?
  [[nodiscard]] bool empty() const { return closed_.empty(); }

  void clear();

  /// Closes what is near the axis of a body that stands. Centers lie inside the cell.
  void add(const Outline& body, const Vec3& center);

  /// Is a body seen to overlap one that stands, or a wall?
  [[nodiscard]] bool blocks(const Outline& body, const Vec3& center) const;

 private:
  // Coordinates in units of 2^-32 of the cell, which wrap by themselves.
  using Fraction = std::array<std::uint32_t, 3>;

  // Voxels along an axis, not wrapped.
  struct Range {
    std::int64_t first, last;
  };
  // From the center of a body [L].
  struct Stretch {
    double first, last;
  };
  struct Tube;

  [[nodiscard]] Fraction fraction_of(const Vec3& x) const;
  [[nodiscard]] Range centers_between(std::size_t a, double lo, double hi) const;
  [[nodiscard]] double center_of(std::size_t a, std::int64_t k) const {
    return (static_cast<double>(k) + 0.5) * cell_.size[a] / static_cast<double>(count_[a]);
  }
  void close_row(std::int64_t ky, std::int64_t kz, const Range& xs);
  [[nodiscard]] Range range_of(std::size_t a, const Tube& tube, const Stretch& along) const;
  void close(const Tube& tube);
  // Number of a voxel. Blocks of 8 x 8 x 8 fill a line of the cache, as an axis passes them.
  [[nodiscard]] std::size_t voxel(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const std::size_t block = (std::size_t{z / 8} * blocks_[1] + y / 8) * blocks_[0] + x / 8;
    return block * 512 + (z % 8) * 64 + (y % 8) * 8 + x % 8;
  }

  Cell cell_;
  double reach_ = 0.0;  // From an axis, less the radius of the rod that stands [L].
  double step_ = 0.0;   // Between two looks [L].
  std::array<std::int64_t, 3> count_{};
  std::array<std::uint32_t, 3> blocks_{};
  std::vector<std::uint64_t> closed_;  // A bit for each voxel.
};

}  // namespace packstone::rsa
