#include "spatial/capsule_kernels.hpp"

namespace packstone {

const CapsuleHits kCapsulesByTwo = capsules_that_meet;

}  // namespace packstone
