#pragma once

/// @file
/// Random numbers for one trial after another, where a stream for each would cost more than the
/// trial.

#include <cstdint>

#include "packstone/core/random.hpp"

namespace packstone::rsa {

/// The numbers of all trials of one (seed, stream, item): trial k has words of its own, whoever
/// asks and in whatever order.
///
/// A RandomStream gives where to start; from there SplitMix64 is run in counter mode: G. L. Steele,
/// D. Lea, C. H. Flood, OOPSLA 2014, with the constants of D. Stafford's variant 13.
class TrialNumbers {
 public:
  TrialNumbers(std::uint64_t seed, StreamId id, std::uint64_t item) noexcept {
    RandomStream random(seed, id, item);
    start_ = random.bits();
    mask_ = random.bits();
  }

  /// The words of one trial, in sequence; at most eight of them are its own.
  class Row {
   public:
    Row(std::uint64_t state, std::uint64_t mask) noexcept : state_(state), mask_(mask) {}

    /// 64 random bits.
    std::uint64_t bits() noexcept {
      state_ += kStep;
      std::uint64_t z = state_;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      return (z ^ (z >> 31)) ^ mask_;
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

    /// Integer in [0, n), each with the same chance up to n / 2^64. n >= 1.
    std::uint64_t below(std::uint64_t n) noexcept {
      __extension__ using Wide = unsigned __int128;
      return static_cast<std::uint64_t>((static_cast<Wide>(bits()) * n) >> 64);
    }

   private:
    std::uint64_t state_;
    std::uint64_t mask_;
  };

  [[nodiscard]] Row trial(std::int64_t k) const noexcept {
    return {start_ + 8 * kStep * static_cast<std::uint64_t>(k), mask_};
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;

  std::uint64_t start_;
  std::uint64_t mask_;
};

}  // namespace packstone::rsa
