#include "spatial/capsule_kernels.hpp"

namespace packstone {

const CapsuleHits kCapsulesByEight = capsules_that_meet;

}  // namespace packstone
