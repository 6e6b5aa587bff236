#include "spatial/capsule_kernels.hpp"

namespace packstone {

const CapsuleHits kCapsulesByFour = capsules_that_meet;

}  // namespace packstone
