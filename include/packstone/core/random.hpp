#pragma once

/// @file
/// Counter-based random numbers with named streams.
///
/// A number depends on nothing but (seed, stream, item, trial): not on who asked first, not on how
/// many threads ask. Generator: Philox4x64-10, J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw,
/// "Parallel random numbers: as easy as 1, 2, 3", SC'11 (2011), in the Random123 library.
/// Distributions are our own, since those of the standard library differ between libraries.

#include <array>
#include <cstdint>

#include "packstone/core/quaternion.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// One name per use of randomness, so that no two uses share numbers. Values are part of the
/// promise that a seed gives the same packing: append, never renumber.
enum class StreamId : std::uint64_t {
  test = 0,
  sizes = 1,
  aspects = 2,
  orientations = 3,
  rsa_center = 4,
  rsa_orientation = 5,
  rsa_voxel = 6,
  rsa_order = 7,
  benchmark = 8,
  draw = 9,
  event_driven_centers = 10,
  event_driven_velocities = 11,
  time_driven_centers = 12,
  relaxation_centers = 13,
  relaxation_places = 14,
  drop_and_roll = 15,
  advancing_layer = 16,
  constructive_order = 17,
};

/// The numbers of one (seed, stream, item, trial), drawn in sequence.
///
/// Cheap to construct: nothing is stored but the counter and one block of four words.
class RandomStream {
 public:
  /// @param seed   Key of the run.
  /// @param id     Which use.
  /// @param item   Which thing, for instance the inclusion.
  /// @param trial  Which attempt at it.
  RandomStream(std::uint64_t seed, StreamId id, std::uint64_t item = 0,
               std::uint64_t trial = 0) noexcept
      : counter_{0, item, trial, 0}, key_{seed, static_cast<std::uint64_t>(id)} {}

  /// 64 random bits.
  std::uint64_t bits() noexcept {
    if (next_ == 4) fill_block();
    return block_[next_++];
  }

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

  /// Uniform in [lo, hi).
  double uniform(double lo, double hi) noexcept { return lo + (hi - lo) * uniform(); }

  /// Uniform integer in [0, n), without bias. n >= 1.
  std::uint64_t below(std::uint64_t n) noexcept;

  /// Standard normal, by inversion of the distribution function (one uniform each).
  double normal() noexcept;

 private:
  void fill_block() noexcept;

  std::array<std::uint64_t, 4> counter_;
  std::array<std::uint64_t, 2> key_;
  std::array<std::uint64_t, 4> block_;  // Filled when it is first asked for.
  unsigned next_ = 4;
};

/// A direction uniform on the unit sphere.
Vec3 random_direction(RandomStream& random) noexcept;

/// A rotation uniform on SO(3). K. Shoemake, Graphics Gems III (1992) 124-132.
Quaternion random_rotation(RandomStream& random) noexcept;

/// Quantile of the standard normal distribution: P(X < x) = p for 0 < p < 1. Relative error below
/// 1e-15: P. J. Acklam's rational start (2003), refined by one Halley step on erfc.
double normal_quantile(double p) noexcept;

}  // namespace packstone
