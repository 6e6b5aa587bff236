#pragma once

/// @file
/// Loops over the pairs of the zoo that name the pair at which a check fails.

#include <catch2/catch.hpp>
#include <cstdint>

#include "support/pair_zoo.hpp"

namespace packstone::zoo {

/// Calls check(pair, class, index) for `count` pairs of two kinds in every class.
template <class Check>
void for_each_pair(ShapeKind a, ShapeKind b, std::uint64_t seed, int count, Check&& check) {
  for (int i = 0; i < kPairClasses; ++i) {
    const auto pair_class = static_cast<PairClass>(i);
    Zoo zoo(seed + 1000 * i + 100 * static_cast<int>(a) + 10 * static_cast<int>(b));
    for (int k = 0; k < count; ++k) {
      CAPTURE(packstone::name(a), packstone::name(b), name(pair_class), k);
      check(zoo.pair(a, b, pair_class), pair_class, k);
    }
  }
}

/// The same for all kinds of pairs.
template <class Check>
void for_each_pair(std::uint64_t seed, int count, Check&& check) {
  for (const auto& [a, b] : kinds_of_pairs()) for_each_pair(a, b, seed, count, check);
}

}  // namespace packstone::zoo
