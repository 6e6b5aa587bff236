#include "generate/event_driven/lane_kernels.hpp"

namespace packstone::event_driven {

const LaneKernels& lane_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") != 0) return kLanesByEight;
  if (__builtin_cpu_supports("avx2") != 0) return kLanesByFour;
#endif
  return kLanesByTwo;
}

}  // namespace packstone::event_driven
