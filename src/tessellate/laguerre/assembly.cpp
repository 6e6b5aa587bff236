#include "tessellate/laguerre/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessellate/laguerre/parts.hpp"
#include "tessellate/laguerre/power_cells.hpp"
#include "tessellate/laguerre/vertex_pool.hpp"

namespace packstone::laguerre {
namespace {

// A corner of a facet, by the sites that meet there.
struct RawCorner {
  VertexKey key;
  Vec3 at;        // In the image that the key is relative to.
  Image image{};  // That image, for the owner that the facet is stored for.
};

// What the cells of one block of sites contribute.
struct BlockFacets {
  std::vector<Facet> facets;
  std::vector<RawCorner> corners;
  std::vector<Joint> joints;
  std::vector<std::int32_t> alive;  // Sites with a cell.
};

// Looks at the cells of one block.
class FacetWriter {
 public:
  FacetWriter(const Cell& box, const std::vector<Site>& sites, BlockFacets& out)
      : box_(box), sites_(sites), out_(out) {}

  template <class PowerCellOf>
  void write(std::int32_t i, const PowerCellOf& cell) {
    if (cell.shape().empty()) return;
    out_.alive.push_back(i);
    cell.shape().for_facets([&](std::int32_t k, std::span<const FacetPoint> points) {
      const Plane& plane = cell.plane(k);
      Facet facet;
      if (wanted(i, plane, facet)) write_facet(i, cell, points, facet);
    });
  }

 private:
  [[nodiscard]] const Site& site(std::int32_t i) const {
    return sites_[static_cast<std::size_t>(i)];
  }

  // Each facet is seen from two sites and stored for one of them.
  bool wanted(std::int32_t i, const Plane& plane, Facet& facet) {
    facet.inner = site(i).owner;
    if (plane.is_wall()) {
      facet.wall = plane.wall();
      return true;
    }
    facet.outer = site(plane.site).owner;
    facet.image = plane.image + site(i).home - site(plane.site).home;
    if (facet.outer != facet.inner) return facet.inner < facet.outer;
    if (facet.image != Image{}) return facet.image > Image{};
    if (i < plane.site) out_.joints.emplace_back(i, plane.site);
    return false;
  }

  template <class PowerCellOf>
  void write_facet(std::int32_t i, const PowerCellOf& cell, std::span<const FacetPoint> points,
                   Facet facet) {
    facet.first_corner = static_cast<std::int64_t>(out_.corners.size());
    facet.corner_count = static_cast<std::int32_t>(points.size());
    out_.facets.push_back(facet);
    for (const FacetPoint& point : points) {
      std::array<KeyMember, 4> members;
      members[3] = {i, {}};
      for (std::size_t k = 0; k < 3 && point.planes[k] != kNoPlane; ++k) {
        const Plane& plane = cell.plane(point.planes[k]);
        members[k] = {plane.site, plane.image};
      }
      const PlacedKey placed = placed_key(members);
      const Vec3 at = site(i).at + point.at - image_shift(box_, placed.image);
      out_.corners.push_back({placed.key, at, placed.image + site(i).home});
    }
  }

  const Cell& box_;
  const std::vector<Site>& sites_;
  BlockFacets& out_;
};

std::vector<BlockFacets> all_facets(const Cell& box, const std::vector<Site>& sites, int threads) {
  std::vector<BlockFacets> blocks(static_cast<std::size_t>(block_count(sites)));
  for_power_cells(box, sites, threads, [&](std::int64_t block, std::int32_t i, const auto& cell) {
    FacetWriter(box, sites, blocks[static_cast<std::size_t>(block)]).write(i, cell);
  });
  return blocks;
}

// Connected parts of each owner.
void count_parts(const std::vector<BlockFacets>& blocks, const std::vector<Site>& sites,
                 std::vector<TessellationCell>& cells) {
  DisjointSets sets(sites.size());
  for (TessellationCell& cell : cells) cell.parts = 0;
  for (const BlockFacets& block : blocks) {
    for (const auto& [a, b] : block.joints) sets.join(a, b);
  }
  for (const BlockFacets& block : blocks) {
    for (const std::int32_t i : block.alive) {
      if (sets.first(i) == i) {
        ++cells[static_cast<std::size_t>(sites[static_cast<std::size_t>(i)].owner)].parts;
      }
    }
  }
}

// A corner that comes twice in a row, and a way there and back, are no part of the polygon.
void reduce(std::vector<PlacedVertex>& loop) {
  for (bool changed = true; changed && loop.size() >= 3;) {
    changed = false;
    for (std::size_t k = 0; k < loop.size() && loop.size() >= 3; ++k) {
      const std::size_t n = loop.size(), next = (k + 1) % n, after = (k + 2) % n;
      if (loop[k] == loop[next] || loop[k] == loop[after]) {
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(next));
        changed = true;
      }
    }
  }
}

// Puts the facets of all blocks together, their corners resolved to vertices.
class Assembler {
 public:
  Assembler(const Cell& box, const std::vector<BlockFacets>& blocks, Tessellation& out)
      : box_(box), pool_(box), out_(out) {
    std::size_t facets = 0, corners = 0;
    for (const BlockFacets& block : blocks) {
      facets += block.facets.size();
      corners += block.corners.size();
    }
    facets_.reserve(facets);
    corners_.reserve(corners);
    out.facets.reserve(facets);
    out.corners.reserve(corners);
    pool_.reserve(corners / (box.dimension == 2 ? kCornersPerVertex2 : kCornersPerVertex3));
    for (const BlockFacets& block : blocks) add(block);
  }

  void finish(double same_place) {
    pool_.merge_near(same_place);
    for (PlacedVertex& corner : corners_) corner = pool_.resolve(corner);
    is_corner_.assign(pool_.places().size(), box_.dimension == 2 ? 1 : 0);
    if (box_.dimension == 3) find_corners(same_place);
    number_.assign(pool_.places().size(), -1);
    for (const std::int64_t k : by_inner_cell()) keep(facets_[static_cast<std::size_t>(k)]);
  }

 private:
  // Corners of stored facets that meet in one vertex, in most diagrams.
  static constexpr std::size_t kCornersPerVertex2 = 2;
  static constexpr std::size_t kCornersPerVertex3 = 6;

  void add(const BlockFacets& block) {
    const auto first = static_cast<std::int64_t>(corners_.size());
    for (const RawCorner& corner : block.corners) {
      PlacedVertex vertex = pool_.find_or_add(corner.key, corner.at);
      vertex.image = vertex.image + corner.image;
      corners_.push_back(vertex);
    }
    for (Facet facet : block.facets) {
      facet.first_corner += first;
      facets_.push_back(facet);
    }
  }

  // Facets of one cell in the order in which they came.
  [[nodiscard]] std::vector<std::int64_t> by_inner_cell() const {
    std::vector<std::int64_t> next(out_.cells.size() + 1, 0), order(facets_.size());
    for (const Facet& facet : facets_) ++next[static_cast<std::size_t>(facet.inner) + 1];
    for (std::size_t c = 1; c < next.size(); ++c) next[c] += next[c - 1];
    for (std::size_t k = 0; k < facets_.size(); ++k) {
      order[static_cast<std::size_t>(next[static_cast<std::size_t>(facets_[k].inner)]++)] =
          static_cast<std::int64_t>(k);
    }
    return order;
  }

  [[nodiscard]] Vec3 place(const PlacedVertex& v) const {
    return pool_.places()[static_cast<std::size_t>(v.vertex)] + image_shift(box_, v.image);
  }

  // Where several cells meet in nearly one edge, some of them see a vertex on it that others do
  // not: it divides two facets that are thinner than what counts as one place. It lies on a
  // straight line in all facets, and is left out of them.
  void find_corners(double same_place) {
    for (const Facet& facet : facets_) {
      load(facet);
      reduce(loop_);
      const std::size_t n = loop_.size();
      for (std::size_t k = 0; n >= 3 && k < n; ++k) {
        const Vec3 before = place(loop_[(k + n - 1) % n]),
                   along = place(loop_[(k + 1) % n]) - before;
        const Vec3 here = place(loop_[k]) - before;
        const double off = norm(cross(along, here));
        const double share = dot(here, along);
        const bool between = share > 0.0 && share < norm_sq(along);
        if (!between || off > same_place * norm(along)) {
          is_corner_[static_cast<std::size_t>(loop_[k].vertex)] = 1;
        }
      }
    }
  }

  void load(const Facet& facet) {
    const auto first = corners_.begin() + facet.first_corner;
    loop_.assign(first, first + facet.corner_count);
  }

  void keep(Facet facet) {
    load(facet);
    std::erase_if(loop_, [&](const PlacedVertex& v) {
      return is_corner_[static_cast<std::size_t>(v.vertex)] == 0;
    });
    if (box_.dimension == 3) reduce(loop_);
    const bool gone = box_.dimension == 3 ? loop_.size() < 3 : loop_[0] == loop_[1];
    if (gone) return;
    facet.first_corner = static_cast<std::int64_t>(out_.corners.size());
    facet.corner_count = static_cast<std::int32_t>(loop_.size());
    out_.facets.push_back(facet);
    for (const PlacedVertex& corner : loop_) {
      out_.corners.push_back({number(corner.vertex), corner.image});
    }
  }

  // Vertices are numbered as they come.
  std::int32_t number(std::int32_t vertex) {
    std::int32_t& number = number_[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = static_cast<std::int32_t>(out_.vertices.size());
      out_.vertices.push_back(pool_.places()[static_cast<std::size_t>(vertex)]);
    }
    return number;
  }

  const Cell& box_;
  VertexPool pool_;
  Tessellation& out_;
  std::vector<Facet> facets_;
  std::vector<PlacedVertex> corners_;
  std::vector<PlacedVertex> loop_;
  std::vector<char> is_corner_;  // Of each vertex.
  std::vector<std::int32_t> number_;
};

}  // namespace

Tessellation assemble(const Cell& box, const std::vector<Site>& sites,
                      std::vector<TessellationCell> cells, int threads) {
  const std::vector<BlockFacets> blocks = all_facets(box, sites, threads);
  count_parts(blocks, sites, cells);
  Tessellation tessellation;
  tessellation.box = box;
  tessellation.cells = std::move(cells);
  Assembler assembler(box, blocks, tessellation);
  const double distance =
      std::pow(volume(box) / static_cast<double>(std::max<std::size_t>(1, sites.size())),
               1.0 / box.dimension);
  assembler.finish(kSamePlace * distance);
  return tessellation;
}

}  // namespace packstone::laguerre
