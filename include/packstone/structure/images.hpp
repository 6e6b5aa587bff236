#pragma once

/// @file
/// Which periodic images of an inclusion reach into the cell.

#include <array>
#include <vector>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// The images, in periods along each axis, whose bounding box meets the cell, in lexicographic
/// order; {0, 0, 0} is always among them. Bodies longer than the cell have many.
[[nodiscard]] std::vector<std::array<int, 3>> images_in_cell(const Cell& cell,
                                                             const Inclusion& inclusion);

}  // namespace packstone
