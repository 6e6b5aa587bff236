#pragma once

/// @file
/// Can the bodies that were drawn stand in the cell at all?

#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::mix {

/// Throws InvalidArgument when a body is wider than the walls allow or meets its own image.
void check_bodies(const Cell& cell, const InclusionGroup& group, int index,
                  const std::vector<Body>& bodies);

/// Throws InvalidArgument when all bodies together are more than the cell, or than the densest
/// packing of equal bodies, can hold.
void check_total(const Cell& cell, const std::vector<OrderedBody>& bodies);

/// Throws InvalidArgument when the fractions ordered sum to 1 or more.
void check_ordered_fractions(const std::vector<InclusionGroup>& groups);

}  // namespace packstone::mix
