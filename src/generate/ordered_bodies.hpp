#pragma once

/// @file
/// What every generator asks of the bodies that it is to place, and how they stand in a packing.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {

/// One more than the largest group of any body.
[[nodiscard]] int group_count(const std::vector<OrderedBody>& bodies);

/// The bodies in `cell`, body k about centers[k]; the groups have no names.
[[nodiscard]] Packing packing_at(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                 const std::vector<Vec3>& centers);

/// The bodies of a packing, in its order.
[[nodiscard]] std::vector<OrderedBody> ordered_bodies(const Packing& packing);

/// Throws InvalidArgument unless `ordered` is a body of the kind of this cell. `k` is its number in
/// the order.
void check_ordered(const Cell& cell, const OrderedBody& ordered, std::int64_t k);

/// Throws InvalidArgument unless the body may stand in the cell alone.
void check_alone(const Cell& cell, const OrderedBody& ordered, std::int64_t k, double min_gap,
                 Turn turn);

/// Throws InvalidArgument, "RsaOptions::min_gap is ...", when no inclusions can keep it. `options`
/// is the name of the options that hold it.
void check_min_gap(const Cell& cell, double min_gap, const char* options);

}  // namespace packstone
