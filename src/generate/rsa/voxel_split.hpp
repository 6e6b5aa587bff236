#pragma once

/// @file
/// One step of the voxel method: split voxels, drop the children that no center can stand in, try
/// positions in the others.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "generate/rsa/ball_grid.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/tolerances.hpp"

namespace packstone::rsa {

/// The lattice of voxels of one level: every bin of the grid, halved `level` times along each axis.
/// A voxel is named by its index along each axis.
template <int Dim>
class VoxelLattice {
 public:
  VoxelLattice(const BallGrid<Dim>& grid, int level) : grid_(&grid), level_(level) {
    for (int axis = 0; axis < Dim; ++axis) edge_[axis] = std::ldexp(grid.edge()[axis], -level);
  }

  /// Lower end of voxel `index` along an axis. Halving the edge is exact, so the corners of one
  /// level are, to the bit, corners of the next: children fill their parent without a crack.
  [[nodiscard]] double corner(std::int64_t index, int axis) const noexcept {
    const CenterRange<Dim>& range = grid_->range();
    if (index == grid_->count()[axis] << level_) return range.high[axis];
    return std::min(range.low[axis] + static_cast<double>(index) * edge_[axis], range.high[axis]);
  }

  /// The bin that holds a voxel.
  [[nodiscard]] Index<Dim> bin(const Index<Dim>& voxel) const noexcept {
    Index<Dim> bin;
    for (int axis = 0; axis < Dim; ++axis) bin[axis] = voxel[axis] >> level_;
    return bin;
  }

 private:
  const BallGrid<Dim>* grid_;
  int level_;
  Point<Dim> edge_{};
};

/// A position that keeps its distance to all centers placed before the pass.
template <int Dim>
struct BallTrial {
  std::uint64_t time = 0;  ///< When in the pass it is tried, in units of 2^-64 of the pass.
  Point<Dim> p{};
  Index<Dim> bin{};
};

/// What one run of split() gives.
template <int Dim>
struct SplitOutput {
  std::vector<Index<Dim>> voxels;          ///< Children that may still hold a center.
  std::vector<BallTrial<Dim>> candidates;  ///< In the order of the voxels.
  std::int64_t trials = 0;                 ///< Positions drawn.
};

/// Splits voxels one after the other, with the numbers of one stream.
///
/// Positions are drawn as a Poisson process of `rate` trials per child in a pass, each with a time
/// uniform in the pass. Only those that the centers placed before leave room for are kept.
template <int Dim>
class VoxelSplitter {
 public:
  /// @param parents   The lattice of the voxels to split.
  /// @param children  The lattice of their children, one level on.
  VoxelSplitter(const BallGrid<Dim>& grid, const VoxelLattice<Dim>& parents,
                const VoxelLattice<Dim>& children, double rate, RandomStream random)
      : grid_(grid),
        parents_(parents),
        children_(children),
        rate_(rate),
        // Rounding of a squared distance is below 5 units; see docs/algorithms/rsa_saturation.md.
        cover_sq_(grid.keep_sq() * (1.0 - 16 * kUnitRoundoff)),
        random_(random),
        near_(grid.max_neighbors()),
        close_(grid.max_neighbors()) {
    bin_.fill(-1);
  }

  void split(std::span<const Index<Dim>> voxels, SplitOutput<Dim>& out) {
    out.voxels.clear();
    out.candidates.clear();
    out.trials = 0;
    next_trial_ = waiting_time();
    for (const Index<Dim>& voxel : voxels) {
      enter_bin(parents_.bin(voxel));
      set_cuts(voxel);
      const unsigned covered = covered_children();
      for (unsigned child = 0; child < kChildren; ++child) {
        if ((covered >> child & 1) != 0) continue;
        Index<Dim> index;
        for (int axis = 0; axis < Dim; ++axis) index[axis] = 2 * voxel[axis] + half(child, axis);
        out.voxels.push_back(index);
        try_child(child, out);
      }
    }
  }

 private:
  static constexpr unsigned kChildren = 1u << Dim;
  static constexpr unsigned kAllCovered = (1u << kChildren) - 1;

  static constexpr int half(unsigned child, int axis) { return child >> axis & 1; }

  double waiting_time() { return -std::log1p(-random_.uniform()) / rate_; }

  // Voxels of one bin follow each other: their neighbors are looked up once.
  void enter_bin(const Index<Dim>& bin) {
    if (bin == bin_) return;
    bin_ = bin;
    const VoxelLattice<Dim> bins(grid_, 0);
    Point<Dim> low;
    Point<Dim> high;
    for (int axis = 0; axis < Dim; ++axis) {
      low[axis] = bins.corner(bin[axis], axis);
      high[axis] = bins.corner(bin[axis] + 1, axis);
    }
    near_count_ = grid_.gather(grid_.slot(bin), low, high, near_.data());
  }

  void set_cuts(const Index<Dim>& voxel) {
    for (int axis = 0; axis < Dim; ++axis) {
      for (int k = 0; k < 3; ++k) cuts_[k][axis] = children_.corner(2 * voxel[axis] + k, axis);
    }
  }

  // One bit per child: does a single ball around a center cover it, farthest corner included?
  // Lists on the way which centers can touch the voxel at all.
  unsigned covered_children() {
    const double keep_sq = grid_.keep_sq();
    const double cover_sq = cover_sq_;
    unsigned covered = 0;
    close_count_ = 0;
    for (int k = 0; k < near_count_; ++k) {
      const Point<Dim>& q = near_[k];
      double far_sq[Dim][2];  // Distance to the far end of each half along an axis, squared.
      double near_sum = 0.0;
      double least_far_sum = 0.0;
      for (int axis = 0; axis < Dim; ++axis) {
        const double a = q[axis] - cuts_[0][axis];
        const double m = q[axis] - cuts_[1][axis];
        const double b = q[axis] - cuts_[2][axis];
        const double outside = std::max(std::max(-a, b), 0.0);
        near_sum += outside * outside;
        far_sq[axis][0] = std::max(a * a, m * m);
        far_sq[axis][1] = std::max(b * b, m * m);
        least_far_sum += std::min(far_sq[axis][0], far_sq[axis][1]);
      }
      close_[close_count_] = q;
      close_count_ += near_sum <= keep_sq ? 1 : 0;
      if (!(least_far_sum < cover_sq)) continue;
      for (unsigned child = 0; child < kChildren; ++child) {
        double sum = 0.0;
        for (int axis = 0; axis < Dim; ++axis) sum += far_sq[axis][half(child, axis)];
        covered |= (sum < cover_sq ? 1u : 0u) << child;
      }
      if (covered == kAllCovered) break;
    }
    return covered;
  }

  // The Poisson process runs along the list of live children, each of length 1.
  void try_child(unsigned child, SplitOutput<Dim>& out) {
    const double end = static_cast<double>(out.voxels.size());
    for (; next_trial_ < end; next_trial_ += waiting_time()) {
      ++out.trials;
      BallTrial<Dim> candidate;
      for (int axis = 0; axis < Dim; ++axis) {
        const double low = cuts_[half(child, axis)][axis];
        const double high = cuts_[half(child, axis) + 1][axis];
        candidate.p[axis] = std::min(low + random_.uniform() * (high - low), high);
      }
      if (!keeps_distance(candidate.p)) continue;
      candidate.time = random_.bits();
      candidate.bin = bin_;
      out.candidates.push_back(candidate);
    }
  }

  bool keeps_distance(const Point<Dim>& p) const noexcept {
    for (int k = 0; k < close_count_; ++k) {
      if (!(distance_sq<Dim>(p, close_[k]) > grid_.keep_sq())) return false;
    }
    return true;
  }

  const BallGrid<Dim>& grid_;
  const VoxelLattice<Dim>& parents_;
  const VoxelLattice<Dim>& children_;
  double rate_;
  double cover_sq_;
  RandomStream random_;
  double next_trial_ = 0.0;
  Index<Dim> bin_;
  std::array<Point<Dim>, 3> cuts_{};  // Low end, middle and high end of the voxel.
  std::vector<Point<Dim>> near_;      // Centers that can touch the bin.
  std::vector<Point<Dim>> close_;     // Those that can touch the voxel.
  int near_count_ = 0;
  int close_count_ = 0;
};

}  // namespace packstone::rsa
