#include "tessellate/laguerre/interfaces.hpp"

#include <cstddef>
#include <span>

#include "tessellate/laguerre/power_cells.hpp"

namespace packstone::laguerre {
namespace {

template <class PowerCellOf>
void look(const std::vector<Site>& sites, std::int32_t i, const PowerCellOf& cell,
          std::vector<Interface>& out) {
  const std::int32_t owner = sites[static_cast<std::size_t>(i)].owner;
  cell.shape().for_facets([&](std::int32_t k, std::span<const FacetPoint> points) {
    const Plane& plane = cell.plane(k);
    if (plane.is_wall() || sites[static_cast<std::size_t>(plane.site)].owner <= owner) return;
    out.push_back({i, plane.site, plane.to, {points[0].at, points[1].at}});
  });
}

}  // namespace

std::vector<Interface> interfaces_of(const Cell& box, const std::vector<Site>& sites, int threads) {
  std::vector<std::vector<Interface>> blocks(static_cast<std::size_t>(block_count(sites)));
  for_power_cells(box, sites, threads, [&](std::int64_t block, std::int32_t i, const auto& cell) {
    look(sites, i, cell, blocks[static_cast<std::size_t>(block)]);
  });
  std::vector<Interface> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace packstone::laguerre
