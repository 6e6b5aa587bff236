#pragma once

/// @file
/// Seeds of the slow cases: fixed ones by default, others with `--rng-seed N`.

#include <catch2/catch.hpp>
#include <cstdint>

namespace packstone {

/// `fixed` itself without `--rng-seed`.
inline std::uint64_t validation_seed(std::uint64_t fixed) {
  constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15;
  return fixed + kGoldenRatio * Catch::rngSeed();
}

}  // namespace packstone
