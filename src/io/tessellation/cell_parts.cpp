#include "io/tessellation/cell_parts.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "io/tessellation/placed_corners.hpp"
#include "io/tessellation/plane_loops.hpp"

namespace packstone {
namespace {

// A facet as its cell sees it: turned outward, where the cell stands.
CornerLoop facet_of_cell(const Tessellation& t, const CellFacets::Entry& entry) {
  const Facet& facet = t.facets[static_cast<std::size_t>(entry.facet)];
  CornerLoop loop = placed_facet(t, facet, entry.outer);
  if (entry.outer) std::reverse(loop.begin(), loop.end());
  return loop;
}

std::vector<CornerLoop> facets_of_cell(const Tessellation& t,
                                       std::span<const CellFacets::Entry> entries) {
  std::vector<CornerLoop> loops;
  loops.reserve(entries.size());
  for (const CellFacets::Entry& entry : entries) loops.push_back(facet_of_cell(t, entry));
  return loops;
}

// --- In the plane --------------------------------------------------------------------------------

std::vector<CornerLoop> outlines(const Tessellation& t, const std::vector<CornerLoop>& facets) {
  PlacedCorners corners;
  std::vector<DirectedEdge> edges;
  for (const CornerLoop& facet : facets) {
    const std::size_t from = corners.number(facet[0]);
    edges.push_back({from, corners.number(facet[1])});
  }
  std::vector<CornerLoop> loops;
  for (const auto& numbers : plane_loops(edges, corners.positions(t))) {
    CornerLoop loop;
    for (const std::size_t edge : numbers) loop.push_back(corners.corners()[edges[edge].from]);
    loops.push_back(std::move(loop));
  }
  return loops;
}

// The smallest outline around a hole; parts are never empty here.
CellPart& part_around(const Tessellation& t, const CornerLoop& hole, std::vector<CellPart>& parts) {
  const Vec3 p = position(t, hole[0]);
  CellPart* best = nullptr;
  for (CellPart& part : parts) {
    if (!holds(positions(t, part.loops[0]), p)) continue;
    if (best == nullptr || part.measure < best->measure) best = &part;
  }
  return best != nullptr ? *best : parts[0];
}

std::vector<CellPart> flat_parts(const Tessellation& t, const std::vector<CornerLoop>& facets) {
  std::vector<CellPart> parts;
  std::vector<CornerLoop> holes;
  for (CornerLoop& loop : outlines(t, facets)) {
    const double area = signed_area(t, loop);
    if (area > 0.0) {
      parts.push_back({0, 0, area, {std::move(loop)}});
    } else {
      holes.push_back(std::move(loop));
    }
  }
  if (parts.empty()) return parts;
  for (CornerLoop& hole : holes) {
    CellPart& part = part_around(t, hole, parts);
    part.measure += signed_area(t, hole);
    part.loops.push_back(std::move(hole));
  }
  return parts;
}

// --- In space ------------------------------------------------------------------------------------

// Which facets hang together by edges: the number of a group for each.
std::vector<std::size_t> groups_by_edges(const std::vector<CornerLoop>& facets) {
  PlacedCorners corners;
  std::vector<std::tuple<std::size_t, std::size_t, std::size_t>> edges;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t k = 0; k < facets[f].size(); ++k) {
      const std::size_t a = corners.number(facets[f][k]);
      const std::size_t b = corners.number(facets[f][(k + 1) % facets[f].size()]);
      edges.emplace_back(std::min(a, b), std::max(a, b), f);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> up(facets.size());
  std::iota(up.begin(), up.end(), std::size_t{0});
  const auto root = [&up](std::size_t f) {
    while (up[f] != f) f = up[f] = up[up[f]];
    return f;
  };
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const auto& [a, b, f] = edges[k - 1];
    const auto& [c, d, g] = edges[k];
    if (a == c && b == d) up[std::max(root(f), root(g))] = std::min(root(f), root(g));
  }
  for (std::size_t f = 0; f < up.size(); ++f) up[f] = root(f);
  return up;
}

// Volume of the cones from a corner to the polygons.
double signed_volume(const Tessellation& t, const std::vector<CornerLoop>& loops) {
  const Vec3 origin = position(t, loops[0][0]);
  double six = 0.0;
  for (const CornerLoop& loop : loops) {
    const Vec3 a = position(t, loop[0]) - origin;
    for (std::size_t k = 2; k < loop.size(); ++k) {
      six += dot(a, cross(position(t, loop[k - 1]) - origin, position(t, loop[k]) - origin));
    }
  }
  return six / 6.0;
}

std::vector<CellPart> solid_parts(const Tessellation& t, std::vector<CornerLoop> facets) {
  const std::vector<std::size_t> group = groups_by_edges(facets);
  std::vector<CellPart> surfaces(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    surfaces[group[f]].loops.push_back(std::move(facets[f]));
  }
  std::vector<CellPart> parts, cavities;
  for (CellPart& surface : surfaces) {
    if (surface.loops.empty()) continue;
    surface.measure = signed_volume(t, surface.loops);
    (surface.measure > 0.0 ? parts : cavities).push_back(std::move(surface));
  }
  if (parts.empty()) return parts;
  // Whichever part a cavity is in, the largest has room for it.
  CellPart& largest =
      *std::max_element(parts.begin(), parts.end(),
                        [](const CellPart& a, const CellPart& b) { return a.measure < b.measure; });
  for (CellPart& cavity : cavities) {
    largest.measure += cavity.measure;
    std::move(cavity.loops.begin(), cavity.loops.end(), std::back_inserter(largest.loops));
  }
  return parts;
}

// --- Slits ---------------------------------------------------------------------------------------

bool crosses_any(const std::vector<std::vector<Vec3>>& loops, const Vec3& a, const Vec3& b) {
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (cross_each_other(a, b, loop[k], loop[(k + 1) % loop.size()])) return true;
    }
  }
  return false;
}

// The shortest line from a corner of one loop to a corner of another that crosses no loop.
std::pair<std::size_t, std::size_t> shortest_slit(const std::vector<Vec3>& outline,
                                                  const std::vector<Vec3>& hole,
                                                  const std::vector<std::vector<Vec3>>& loops) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t j = 0; j < hole.size(); ++j) {
      const double length = norm_sq(outline[i] - hole[j]);
      if (length >= least || crosses_any(loops, outline[i], hole[j])) continue;
      least = length;
      best = {i, j};
    }
  }
  return best;
}

}  // namespace

double signed_area(const Tessellation& tessellation, const CornerLoop& loop) {
  return signed_area(positions(tessellation, loop));
}

std::vector<CellPart> cell_parts(const Tessellation& tessellation) {
  const CellFacets of = facets_of_cells(tessellation);
  std::vector<CellPart> all;
  for (std::size_t c = 0; c < tessellation.cells.size(); ++c) {
    const auto begin = of.first[c], end = of.first[c + 1];
    std::vector<CornerLoop> facets = facets_of_cell(
        tessellation, {of.entries.data() + begin, static_cast<std::size_t>(end - begin)});
    std::vector<CellPart> parts = tessellation.box.dimension == 2
                                      ? flat_parts(tessellation, facets)
                                      : solid_parts(tessellation, std::move(facets));
    int number = 0;
    for (CellPart& part : parts) {
      part.cell = static_cast<std::int32_t>(c);
      part.number = number++;
      all.push_back(std::move(part));
    }
  }
  return all;
}

CornerLoop with_slits(const Tessellation& tessellation, const CellPart& part) {
  CornerLoop outline = part.loops[0];
  std::vector<std::vector<Vec3>> loops;
  for (const CornerLoop& loop : part.loops) loops.push_back(positions(tessellation, loop));
  for (std::size_t h = 1; h < part.loops.size(); ++h) {
    const auto [i, j] = shortest_slit(positions(tessellation, outline), loops[h], loops);
    CornerLoop hole = part.loops[h];
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(j), hole.end());
    hole.push_back(hole.front());
    hole.push_back(outline[i]);
    outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(i) + 1, hole.begin(), hole.end());
  }
  return outline;
}

std::vector<int> neighbor_counts(const Tessellation& tessellation) {
  std::vector<int> counts(tessellation.cells.size(), 0);
  for (const CellContact& contact : cell_contacts(tessellation)) {
    if (contact.b == Facet::kWall) continue;
    ++counts[static_cast<std::size_t>(contact.a)];
    ++counts[static_cast<std::size_t>(contact.b)];
  }
  return counts;
}

}  // namespace packstone
