#pragma once

/// @file
/// Eight numbers side by side, in the compilers' own vectors: where the registers of the processor
/// are narrower, two or four of them do for one. Included by sources alone that compile the same
/// functions once per width; no operation is fused, so the bits are the same.

#include <cstdint>

#include "packstone/core/vec.hpp"

// Vectors pass between inlined functions alone: no binary interface.
#pragma GCC diagnostic ignored "-Wpsabi"

#define PACKSTONE_LANES [[gnu::always_inline]] static inline

namespace packstone {

// The compilers' own vectors.
using Lanes = double __attribute__((vector_size(64)));
using Mask = std::int64_t __attribute__((vector_size(64)));

// As many whole numbers, and numbers of single precision.
using Whole = std::int32_t __attribute__((vector_size(32)));
using Single = float __attribute__((vector_size(32)));

struct Lanes3 {
  Lanes x, y, z;
};

PACKSTONE_LANES Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
PACKSTONE_LANES Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
PACKSTONE_LANES Lanes3 operator*(const Lanes& s, const Lanes3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
PACKSTONE_LANES Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
PACKSTONE_LANES Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
PACKSTONE_LANES Lanes3 all_lanes(const Vec3& v) {
  return {Lanes{} + v.x, Lanes{} + v.y, Lanes{} + v.z};
}
PACKSTONE_LANES Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
// Of lanes of either precision.
template <class Numbers>
PACKSTONE_LANES Numbers magnitude(const Numbers& a) {
  return a < Numbers{} ? -a : a;
}
template <class Numbers>
PACKSTONE_LANES Numbers within(const Numbers& a, const Numbers& most) {
  const Numbers low = a > -most ? a : -most;
  return low < most ? low : most;
}
PACKSTONE_LANES Lanes root(const Lanes& a) {
  Lanes result;
  for (int l = 0; l < 8; ++l) result[l] = __builtin_sqrt(a[l]);
  return result;
}
PACKSTONE_LANES Lanes lanes_of(const double (&numbers)[8]) {
  Lanes result;
  __builtin_memcpy(&result, numbers, sizeof result);
  return result;
}
// Bit l of the result is lane l of the mask.
PACKSTONE_LANES unsigned bits(const Mask& mask) {
  using Bytes = std::int8_t __attribute__((vector_size(8)));
  const Bytes bytes = __builtin_convertvector(mask, Bytes);
  std::uint64_t word;
  __builtin_memcpy(&word, &bytes, sizeof word);
  // Byte l holds its bit at 8 l; the product brings it to 56 + l.
  return static_cast<unsigned>(((word & 0x0101010101010101U) * 0x0102040810204080U) >> 56U);
}
PACKSTONE_LANES unsigned bits(const Whole& mask) {
  const Whole own = mask & Whole{1, 2, 4, 8, 16, 32, 64, 128};
  const Whole two = own | __builtin_shufflevector(own, own, 4, 5, 6, 7, 0, 1, 2, 3);
  const Whole four = two | __builtin_shufflevector(two, two, 2, 3, 0, 1, 6, 7, 4, 5);
  const Whole all = four | __builtin_shufflevector(four, four, 1, 0, 3, 2, 5, 4, 7, 6);
  return static_cast<unsigned>(all[0]);
}

// Eight cache lines of eight numbers, turned into eight lanes of each number.
struct Columns {
  Lanes c[8];
};
PACKSTONE_LANES Columns transposed(const Lanes (&row)[8]) {
  Lanes pairs[8], quads[8];
  for (int k = 0; k < 8; k += 2) {
    pairs[k] = __builtin_shufflevector(row[k], row[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[k + 1] = __builtin_shufflevector(row[k], row[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 8; k += 4) {
    for (int j = 0; j < 2; ++j) {
      quads[k + j] =
          __builtin_shufflevector(pairs[k + j], pairs[k + j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      quads[k + j + 2] =
          __builtin_shufflevector(pairs[k + j], pairs[k + j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  Columns columns;
  for (int k = 0; k < 4; ++k) {
    columns.c[k] = __builtin_shufflevector(quads[k], quads[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    columns.c[k + 4] = __builtin_shufflevector(quads[k], quads[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
  return columns;
}

template <class Line>
PACKSTONE_LANES Columns gathered(const Line* lines, const std::int32_t (&body)[8]) {
  static_assert(sizeof(Line) == sizeof(Lanes));
  Lanes rows[8];
  for (int l = 0; l < 8; ++l) __builtin_memcpy(&rows[l], lines + body[l], sizeof(Lanes));
  return transposed(rows);
}

}  // namespace packstone
