#pragma once

/// @file
/// The edges between sites of different owners, for integrals along the boundaries of cells.

#include <array>
#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// An edge between two sites of the plane.
struct Interface {
  std::int32_t a = 0;        ///< One of the sites.
  std::int32_t b = 0;        ///< The other one, of a later owner.
  Vec3 to;                   ///< From a to b [L].
  std::array<Vec3, 2> ends;  ///< Relative to a [L].
};

/// All edges between different owners, each once. The same bits for any number of threads.
[[nodiscard]] std::vector<Interface> interfaces_of(const Cell& box, const std::vector<Site>& sites,
                                                   int threads);

}  // namespace packstone::laguerre
