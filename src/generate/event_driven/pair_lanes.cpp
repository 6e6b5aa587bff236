#include "generate/event_driven/pair_lanes.hpp"

#include <algorithm>

#include "generate/event_driven/contact_gap.hpp"
#include "generate/event_driven/lane_kernels.hpp"

namespace packstone::event_driven {

PairLanes::Kind PairLanes::kind_of(const Bodies& bodies) {
  const auto is_ball = [](Form form) { return form == Form::ball; };
  if (std::all_of(bodies.form.begin(), bodies.form.end(), is_ball)) return Kind::balls;
  return are_revolution(bodies) && bodies.min_gap == 0.0 ? Kind::revolution : Kind::none;
}

PairLanes::PairLanes(const Bodies& bodies, const Cell& cell, const LaneKernels& kernels)
    : bodies_(bodies),
      edges_(cell.size),
      coordinate_gap_(kCoordinateGap * std::max({cell.size.x, cell.size.y, cell.size.z})),
      kind_(kind_of(bodies)),
      kernels_(kernels) {}

std::size_t PairLanes::look(std::int32_t i, double t, double horizon, const double* times,
                            std::span<Neighbor> neighbors, Suspect* suspects,
                            double& least_gap) const {
  if (neighbors.empty()) return 0;
  const PairQuestion question{bodies_.flight.data(),
                              bodies_.spin.data(),
                              bodies_.reach.data(),
                              bodies_.size_at(t),
                              bodies_.growth,
                              bodies_.min_gap,
                              edges_,
                              coordinate_gap_,
                              i,
                              t,
                              horizon,
                              times,
                              neighbors.data(),
                              neighbors.size()};
  return kind_ == Kind::balls ? kernels_.balls(question, suspects, least_gap)
                              : kernels_.revolution(question, suspects);
}

}  // namespace packstone::event_driven
