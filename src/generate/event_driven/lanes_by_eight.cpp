#include "generate/event_driven/gap_kernels.hpp"
#include "generate/event_driven/pair_kernels.hpp"

namespace packstone::event_driven {

const LaneKernels kLanesByEight{look_at_balls, look_at_revolution, bound_gaps_in};

}  // namespace packstone::event_driven
