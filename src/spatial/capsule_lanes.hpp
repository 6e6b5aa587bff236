#pragma once

/// @file
/// Which capsules of a grid cell meet another one: eight at a time, compiled once for every width
/// of registers, the same bits from all of them.

#include <cstddef>
#include <cstdint>

namespace packstone {

/// Some of the capsules in one grid cell, side by side.
struct alignas(32) CapsuleChunk {
  static constexpr std::size_t kLanes = 8;
  float x[kLanes], y[kLanes], z[kLanes], axis_x[kLanes], axis_y[kLanes], axis_z[kLanes],
      half[kLanes], radius[kLanes];
  std::int32_t body[kLanes];
  std::int16_t wrap[kLanes][3];  ///< Periods from where it is kept to where it belongs.
  std::int32_t greatest = -1;    ///< No body has a higher number.
  std::int32_t count = 0;
  std::int32_t next = -1;
};

/// One to be held against them, as an image of the cell sees it.
struct SeenCapsule {
  float x, y, z, axis_x, axis_y, axis_z, half, radius;
};

/// A bit for every lane that meets it, or nearly does.
using CapsuleHits = unsigned (*)(const CapsuleChunk&, const SeenCapsule&);

/// Named for the numbers of double precision in a register.
extern const CapsuleHits kCapsulesByTwo;
#ifdef __x86_64__
extern const CapsuleHits kCapsulesByFour;   ///< AVX2.
extern const CapsuleHits kCapsulesByEight;  ///< AVX-512F.
#endif

/// For the widest registers of this processor.
[[nodiscard]] CapsuleHits capsule_hits();

}  // namespace packstone
