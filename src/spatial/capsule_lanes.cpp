#include "spatial/capsule_lanes.hpp"

namespace packstone {

CapsuleHits capsule_hits() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") != 0) return kCapsulesByEight;
  if (__builtin_cpu_supports("avx2") != 0) return kCapsulesByFour;
#endif
  return kCapsulesByTwo;
}

}  // namespace packstone
