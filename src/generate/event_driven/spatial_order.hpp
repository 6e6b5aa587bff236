#pragma once

/// @file
/// Bodies in an order in which those that stand close to each other are stored close to each other:
/// an event touches a body and a dozen neighbors, which then share pages and cache lines.

#include <cstdint>
#include <vector>

#include "generate/event_driven/bodies.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::event_driven {

/// The numbers of the bodies along a Z-curve (G. M. Morton, 1966) through the cell.
[[nodiscard]] std::vector<std::int32_t> spatial_order(const Bodies& bodies, const Cell& cell);

/// Place k takes the body that stands at order[k].
[[nodiscard]] Bodies in_order(const Bodies& bodies, const std::vector<std::int32_t>& order);

/// Undoes in_order().
[[nodiscard]] Bodies out_of_order(const Bodies& bodies, const std::vector<std::int32_t>& order);

}  // namespace packstone::event_driven
