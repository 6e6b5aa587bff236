#pragma once

/// @file
/// Measures and moments of the cells of owners, and how the measures depend on the weights.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "tessellate/laguerre/convex_cell.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// Two owners that share facets: their measure over twice the distance of the two sites, summed.
///
/// When all weights of b grow by d, the facet moves into a by d / (2 distance), so that this is the
/// derivative of the measure of a by the weight of b, with the sign turned about.
struct Coupling {
  std::int32_t a = 0;
  std::int32_t b = 0;  ///< > a.
  double value = 0.0;  ///< [L^(d-2)]
};

/// What the cells of owners come to.
struct CellSums {
  std::vector<CellMoments> cells;   ///< About the reference points that were given.
  std::vector<CellMoments> bodies;  ///< The same of the largest connected part of each cell.
  std::vector<int> parts;           ///< Connected parts of each cell.
  std::vector<char> loose;          ///< Of each site: has a cell, but not in that part.
  std::vector<Coupling> couplings;  ///< Some pairs come more than once.
  std::vector<char> at_wall;        ///< Of each owner: whether its cell touches a wall.
  std::int64_t hidden = 0;          ///< Sites without a cell.
  std::int64_t loose_sites = 0;
};

/// @param centers  A point per owner, about which moments are taken, where the owner stands.
[[nodiscard]] CellSums cell_sums(const Cell& box, const std::vector<Site>& sites,
                                 const std::vector<Vec3>& centers, int threads);

}  // namespace packstone::laguerre
