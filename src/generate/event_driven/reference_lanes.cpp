#include "generate/event_driven/reference_lanes.hpp"

#include "generate/event_driven/lane_kernels.hpp"

namespace packstone::event_driven {
namespace {

void bound(const GapQuestion& question) {
  static const LaneKernels& kernels = lane_kernels();
  if (question.count > 0) kernels.bound_gaps(question);
}

}  // namespace

void bound_gaps(const StandingLine& own, const StandingLine* lines,
                std::span<const Neighbor> others, const Vec3& edges, double* gaps) {
  bound({own, 0.0, lines, nullptr, others.data(), others.size(), edges, gaps});
}

void bound_near_gaps(const StandingLine& own, double own_margin, const StandingLine* lines,
                     const double* margins, std::span<const Neighbor> others, const Vec3& edges,
                     double* gaps) {
  bound({own, own_margin, lines, margins, others.data(), others.size(), edges, gaps});
}

}  // namespace packstone::event_driven
