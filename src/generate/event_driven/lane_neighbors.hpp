#pragma once

/// @file
/// The neighbors of a body, eight at a time, in lanes.

#include <cstddef>
#include <cstdint>

#include "core/lanes.hpp"
#include "generate/event_driven/reference_lanes.hpp"
#include "generate/event_driven/revolution_pair.hpp"

namespace packstone::event_driven {

using Side = Revolution<Lanes, Lanes3>;

/// What stands at the head of eight neighbors.
struct Heads {
  Whole body;
  Lanes3 image;
  Lanes l;  ///< hint[0]
};

/// From number `first` on of `count` neighbors; beyond the last one it is the last one again.
PACKSTONE_LANES Heads heads_of(const Neighbor* neighbors, std::size_t count, std::size_t first) {
  using Head = std::int32_t __attribute__((vector_size(16)));
  static_assert(offsetof(Neighbor, image) == 4 && offsetof(Neighbor, hint) == 12);
  const auto head = [&](std::size_t k) {
    Head h;
    __builtin_memcpy(&h, neighbors + (first + k < count ? first + k : count - 1), sizeof h);
    return h;
  };
  // Four rows of two neighbors each, turned into columns of eight.
  Whole low[2], high[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const Head h[4] = {head(4 * k), head(4 * k + 1), head(4 * k + 2), head(4 * k + 3)};
    const Whole one = __builtin_shufflevector(h[0], h[1], 0, 4, 1, 5, 2, 6, 3, 7);
    const Whole two = __builtin_shufflevector(h[2], h[3], 0, 4, 1, 5, 2, 6, 3, 7);
    low[k] = __builtin_shufflevector(one, two, 0, 1, 8, 9, 2, 3, 10, 11);
    high[k] = __builtin_shufflevector(one, two, 4, 5, 12, 13, 6, 7, 14, 15);
  }
  const Whole xy = __builtin_shufflevector(low[0], low[1], 4, 5, 6, 7, 12, 13, 14, 15);
  const Whole z = __builtin_shufflevector(high[0], high[1], 0, 1, 2, 3, 8, 9, 10, 11);
  const Whole l = __builtin_shufflevector(high[0], high[1], 4, 5, 6, 7, 12, 13, 14, 15);
  Heads heads;
  heads.body = __builtin_shufflevector(low[0], low[1], 0, 1, 2, 3, 8, 9, 10, 11);
  heads.image = {__builtin_convertvector((xy << 16) >> 16, Lanes),
                 __builtin_convertvector(xy >> 16, Lanes),
                 __builtin_convertvector((z << 16) >> 16, Lanes)};
  Single single;
  __builtin_memcpy(&single, &l, sizeof single);
  heads.l = __builtin_convertvector(single, Lanes);
  return heads;
}

/// The numbers of one cache line, each in all lanes.
template <class Line>
PACKSTONE_LANES Columns all_lanes_of(const Line& line) {
  static_assert(sizeof(Line) == sizeof(Lanes));
  Lanes numbers;
  __builtin_memcpy(&numbers, &line, sizeof numbers);
  Columns columns;
  for (int k = 0; k < 8; ++k) columns.c[k] = Lanes{} + numbers[k];
  return columns;
}

}  // namespace packstone::event_driven
