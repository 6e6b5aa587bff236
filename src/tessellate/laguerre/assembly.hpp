#pragma once

/// @file
/// From the power cells of sites to the cells of their owners, with shared vertices.

#include <cstdint>
#include <vector>

#include "packstone/structure/tessellation.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// Facets between sites of one owner vanish, all others are stored once. A vertex is the same for
/// all cells that name the same sites by it, and for those that see one in the same place: within
/// kSamePlace of the mean distance of sites. Facets that shrink to less than they should be are
/// left out on both sides.
///
/// @param cells  What is known of the owners; parts is filled in.
[[nodiscard]] Tessellation assemble(const Cell& box, const std::vector<Site>& sites,
                                    std::vector<TessellationCell> cells, int threads);

/// See assemble() [-].
inline constexpr double kSamePlace = 1e-9;

}  // namespace packstone::laguerre
