#pragma once

/// @file
/// Sums over inclusions that do not depend on the number of threads.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "packstone/core/parallel.hpp"

namespace packstone::density {

/// Adds up inclusions [0, count) in blocks, each into a Sums of its own that starts as a copy of
/// `zero`, and these in their order by `add(total, block)`. body(i, sums) adds inclusion i.
template <class Sums, class Body, class Add>
Sums sum_in_blocks(std::int64_t count, int threads, const Sums& zero, const Body& body,
                   const Add& add) {
  constexpr std::int64_t kMostBlocks = 64;
  constexpr std::int64_t kLeastBlock = 256;
  const std::int64_t blocks =
      std::clamp<std::int64_t>((count + kLeastBlock - 1) / kLeastBlock, 1, kMostBlocks);
  std::vector<Sums> parts(static_cast<std::size_t>(blocks), zero);
  parallel_for(blocks, threads, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      for (std::int64_t i = b * count / blocks; i < (b + 1) * count / blocks; ++i) {
        body(i, parts[static_cast<std::size_t>(b)]);
      }
    }
  });
  Sums total = zero;
  for (const Sums& part : parts) add(total, part);
  return total;
}

}  // namespace packstone::density
