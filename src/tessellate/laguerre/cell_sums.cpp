#include "tessellate/laguerre/cell_sums.hpp"

#include <algorithm>

#include "tessellate/laguerre/parts.hpp"
#include "tessellate/laguerre/power_cells.hpp"

namespace packstone::laguerre {
namespace {

struct BlockSums {
  std::vector<CellMoments> moments;  // Of each site, about it.
  std::vector<Coupling> couplings;
  std::vector<std::int32_t> at_wall;  // Owners.
  std::vector<Joint> joints;
};

// A coupling is seen from both sides and taken from one.
template <class PowerCellOf>
void look(const std::vector<Site>& sites, std::int32_t i, const PowerCellOf& cell, BlockSums& out) {
  out.moments.push_back(cell.shape().moments());
  const std::int32_t owner = sites[static_cast<std::size_t>(i)].owner;
  cell.shape().for_facets([&](std::int32_t k, std::span<const FacetPoint> points) {
    const Plane& plane = cell.plane(k);
    if (plane.is_wall()) {
      out.at_wall.push_back(owner);
      return;
    }
    const Site& here = sites[static_cast<std::size_t>(i)];
    const Site& there = sites[static_cast<std::size_t>(plane.site)];
    const std::int32_t other = there.owner;
    if (other == owner && i < plane.site && plane.image + here.home == there.home) {
      out.joints.emplace_back(i, plane.site);
    }
    if (other <= owner) return;
    out.couplings.push_back({owner, other, 0.5 * facet_measure(points) / norm(plane.to)});
  });
}

// Moments about a point from which the site is at `offset`.
void add_moved(CellMoments& sum, const CellMoments& of, const Vec3& offset) {
  const Vec3 both = of.first + of.measure * offset;
  sum.measure += of.measure;
  sum.first += both;
  // m + o f^T + f o^T + V o o^T, the mixed terms as a difference of dyads.
  sum.second = sum.second + of.second + dyad(of.first + offset) - dyad(of.first) - dyad(offset) +
               of.measure * dyad(offset);
}

// The largest part of each owner, by the first site of its set; -1: none.
std::vector<std::int32_t> largest_parts(const std::vector<Site>& sites,
                                        const std::vector<const CellMoments*>& moments,
                                        std::size_t owners, DisjointSets& sets) {
  std::vector<double> measure(sites.size(), 0.0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    measure[static_cast<std::size_t>(sets.first(static_cast<std::int32_t>(i)))] +=
        moments[i]->measure;
  }
  std::vector<std::int32_t> largest(owners, -1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    std::int32_t& best = largest[static_cast<std::size_t>(sites[i].owner)];
    if (measure[i] <= 0.0) continue;
    if (best < 0 || measure[i] > measure[static_cast<std::size_t>(best)]) {
      best = static_cast<std::int32_t>(i);
    }
  }
  return largest;
}

}  // namespace

CellSums cell_sums(const Cell& box, const std::vector<Site>& sites,
                   const std::vector<Vec3>& centers, int threads) {
  std::vector<BlockSums> blocks(static_cast<std::size_t>(block_count(sites)));
  for_power_cells(box, sites, threads, [&](std::int64_t block, std::int32_t i, const auto& cell) {
    look(sites, i, cell, blocks[static_cast<std::size_t>(block)]);
  });
  CellSums sums;
  sums.at_wall.assign(centers.size(), 0);
  std::vector<const CellMoments*> moments;
  DisjointSets sets(sites.size());
  for (const BlockSums& block : blocks) {
    for (const CellMoments& of : block.moments) moments.push_back(&of);
    for (const auto& [a, b] : block.joints) sets.join(a, b);
    sums.couplings.insert(sums.couplings.end(), block.couplings.begin(), block.couplings.end());
    for (const std::int32_t owner : block.at_wall)
      sums.at_wall[static_cast<std::size_t>(owner)] = 1;
  }
  const auto largest = largest_parts(sites, moments, centers.size(), sets);
  sums.cells.resize(centers.size());
  sums.bodies.resize(centers.size());
  sums.parts.assign(centers.size(), 0);
  sums.loose.assign(sites.size(), 0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto owner = static_cast<std::size_t>(sites[i].owner);
    const Vec3 offset = sites[i].at + image_shift(box, sites[i].home) - centers[owner];
    add_moved(sums.cells[owner], *moments[i], offset);
    const std::int32_t first = sets.first(static_cast<std::int32_t>(i));
    if (moments[i]->measure <= 0.0) {
      ++sums.hidden;
      continue;
    }
    sums.parts[owner] += first == static_cast<std::int32_t>(i) ? 1 : 0;
    if (first == largest[owner]) {
      add_moved(sums.bodies[owner], *moments[i], offset);
    } else {
      sums.loose[i] = 1;
      ++sums.loose_sites;
    }
  }
  return sums;
}

}  // namespace packstone::laguerre
