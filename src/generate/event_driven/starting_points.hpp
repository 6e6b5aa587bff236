#pragma once

/// @file
/// Where bodies start that grow from nothing.

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/structure/moving_packing.hpp"

namespace packstone::event_driven {

/// The bodies at random places, so small that none of them touch; without velocities. Where a least
/// gap is ordered, the places keep it: they are those of balls of that diameter, grown in their
/// turn. Interrupted, that may leave fewer gaps than ordered; the size factor is then 0.
[[nodiscard]] MovingPacking starting_points(const Cell& cell,
                                            const std::vector<OrderedBody>& bodies,
                                            const EventDrivenOptions& options, RunContext& run);

}  // namespace packstone::event_driven
