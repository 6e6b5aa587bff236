// The tessellation files of Neper: R. Quey, P. R. Dawson, F. Barbe, Comput. Methods Appl. Mech.
// Eng. 200 (2011) 1729-1745; its reference manual, "File and Directory Formats", version 2.0.
// Cells stand whole, and what a period makes one is listed under **periodicity.

#include <bit>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/export/csv_text.hpp"
#include "io/tessellation/cell_parts.hpp"
#include "io/tessellation/formats.hpp"
#include "io/tessellation/imaged_items.hpp"
#include "io/tessellation/placed_corners.hpp"

namespace packstone {
namespace {

using Image = std::array<int, 3>;

Image plus(const Image& a, const Image& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Image minus(const Image& a, const Image& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

std::string tag(std::size_t index) { return std::to_string(index + 1); }

// After a space, with a minus where it is passed backward.
std::string spaced_tag(bool backward, std::size_t index) {
  std::string text(backward ? " -" : " ");
  return text += tag(index);
}

std::string words(const Vec3& v) {
  return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z);
}
std::string words(const Image& image) {
  return std::to_string(image[0]) + " " + std::to_string(image[1]) + " " + std::to_string(image[2]);
}

// An edge up to periods: its vertices, and the image of the second one relative to the first.
using EdgeKey = std::tuple<std::int32_t, std::int32_t, Image>;

// A face of the file as its loop of corners, and the edges on the way.
struct TessFace {
  CornerLoop loop;
  std::vector<std::size_t> edges;  // Slots.
  std::vector<bool> backward;
  std::size_t cell = 0;  // In 2D.
};

class TessFile {
 public:
  TessFile(ByteWriter& out, const Tessellation& t)
      : out_(out), t_(t), flat_(t.box.dimension == 2) {}

  void write() {
    flat_ ? collect_polygons() : collect_polyhedra();
    vertices_.finish();
    edges_.finish();
    facets_.finish();
    write_head();
    write_vertices_and_edges();
    write_faces();
    if (!flat_) write_polyhedra();
    write_domain();
    if (periodic()) write_periodicity();
    out_.text("***end\n");
  }

 private:
  // --- What is in the file ---

  void add_edges(TessFace& face) {
    for (const FacetCorner& corner : face.loop) vertices_.add(corner.vertex, corner.image);
    for (std::size_t k = 0; k < face.loop.size(); ++k) {
      const FacetCorner &a = face.loop[k], &b = face.loop[(k + 1) % face.loop.size()];
      const EdgeKey ahead{a.vertex, b.vertex, minus(b.image, a.image)};
      const EdgeKey back{b.vertex, a.vertex, minus(a.image, b.image)};
      face.backward.push_back(back < ahead);
      face.edges.push_back(back < ahead ? edges_.add(back, b.image) : edges_.add(ahead, a.image));
    }
  }

  // A cell of the file is one polygon: cells in parts become several.
  void collect_polygons() {
    for (const CellPart& part : cell_parts(t_)) {
      TessFace face{with_slits(t_, part), {}, {}, static_cast<std::size_t>(part.cell)};
      add_edges(face);
      owners_.push_back(face.cell);
      facets_.add(faces_.size(), {});
      faces_.push_back(std::move(face));
    }
    mark_walls();
  }

  // Each facet where its inner cell stands, and where its outer cell stands when that is elsewhere.
  void collect_polyhedra() {
    const CellFacets of = facets_of_cells(t_);
    for (std::size_t c = 0; c < t_.cells.size(); ++c) {
      if (of.first[c] == of.first[c + 1]) continue;
      owners_.push_back(c);
      std::vector<std::pair<std::size_t, bool>> polyhedron;
      for (auto k = of.first[c]; k < of.first[c + 1]; ++k) {
        const auto& [facet, outer] = of.entries[static_cast<std::size_t>(k)];
        polyhedron.emplace_back(add_facet(static_cast<std::size_t>(facet), outer), outer);
      }
      polyhedra_.push_back(std::move(polyhedron));
    }
    mark_walls();
  }

  std::size_t add_facet(std::size_t f, bool outer) {
    const Facet& facet = t_.facets[f];
    const Image shift = outer ? minus({}, facet.image) : Image{};
    const std::size_t slot = facets_.add(f, shift);
    if (slot < faces_.size()) return slot;
    TessFace face;
    face.loop = placed_facet(t_, facet, outer);
    add_edges(face);
    faces_.push_back(std::move(face));
    return slot;
  }

  // Which walls each vertex and each edge lies in, as bits 1 << wall.
  void mark_walls() {
    for (std::size_t f = 0; f < t_.facets.size(); ++f) {
      const Facet& facet = t_.facets[f];
      if (facet.outer != Facet::kWall) continue;
      TessFace face;
      face.loop = placed_facet(t_, facet, false);
      add_edges(face);
      if (flat_) face.edges.resize(1);  // the way back is the same edge
      vertex_walls_.resize(vertices_.count(), 0);
      edge_walls_.resize(edges_.count(), 0);
      for (const FacetCorner& corner : face.loop) {
        vertex_walls_[vertices_.slot(corner.vertex, corner.image)] |= 1U << facet.wall;
      }
      for (const std::size_t edge : face.edges) edge_walls_[edge] |= 1U << facet.wall;
    }
    vertex_walls_.resize(vertices_.count(), 0);
    edge_walls_.resize(edges_.count(), 0);
  }

  [[nodiscard]] bool periodic() const {
    return t_.box.periodic[0] || t_.box.periodic[1] || (!flat_ && t_.box.periodic[2]);
  }

  // --- Sections ---

  void write_head() {
    out_.text("***tess\n **format\n   2.0\n **general\n   " + std::to_string(t_.box.dimension) +
              (periodic() ? " periodic\n" : " standard\n"));
    out_.text(" **cell\n  " + std::to_string(owners_.size()) + "\n  *id\n  ");
    for (std::size_t k = 0; k < owners_.size(); ++k) {
      out_.text(" " + tag(owners_[k]) + (k % 10 == 9 || k + 1 == owners_.size() ? "\n  " : ""));
    }
    out_.text("*seed\n");
    for (std::size_t k = 0; k < owners_.size(); ++k) {
      out_.text("   " + tag(k) + " " + words(t_.cells[owners_[k]].center) + " 0\n");
    }
  }

  void write_vertices_and_edges() {
    out_.text(" **vertex\n  " + std::to_string(vertices_.count()) + "\n");
    for (std::size_t n = 0; n < vertices_.count(); ++n) {
      const Vec3 at = position(t_, {vertices_.key(n), vertices_.image(n)});
      out_.text("   " + tag(n) + " " + words(at) + " 0\n");
    }
    out_.text(" **edge\n  " + std::to_string(edges_.count()) + "\n");
    for (std::size_t n = 0; n < edges_.count(); ++n) {
      const auto& [a, b, between] = edges_.key(n);
      const Image& image = edges_.image(n);
      const std::size_t from = vertices_.slot(a, image);
      const std::size_t to = vertices_.slot(b, plus(image, between));
      out_.text("   " + tag(n) + " " + tag(vertices_.number(from)) + " " +
                tag(vertices_.number(to)) + " 0\n");
    }
  }

  // d, a, b, c of a x + b y + c z = d.
  [[nodiscard]] std::string plane_of(const CornerLoop& loop) const {
    if (flat_) return "0 0 0 1";
    const std::vector<Vec3> at = positions(t_, loop);
    Vec3 normal = polygon_normal(at);
    // Facets of no area to rounding lie in many planes.
    if (normal == Vec3{}) normal = {0, 0, 1};
    return shortest(dot(normal, at[0])) + " " + words(normal);
  }

  void write_faces() {
    out_.text(" **face\n  " + std::to_string(faces_.size()) + "\n");
    std::vector<std::size_t> slots(faces_.size());
    for (std::size_t slot = 0; slot < slots.size(); ++slot) slots[facets_.number(slot)] = slot;
    for (std::size_t n = 0; n < slots.size(); ++n) {
      const TessFace& face = faces_[slots[n]];
      std::string corners = std::to_string(face.loop.size());
      std::string edges = corners;
      for (std::size_t k = 0; k < face.loop.size(); ++k) {
        const FacetCorner& corner = face.loop[k];
        corners += spaced_tag(false, vertices_.number(vertices_.slot(corner.vertex, corner.image)));
        edges += spaced_tag(face.backward[k], edges_.number(face.edges[k]));
      }
      out_.text("   " + tag(n) + " ");
      for (const std::string& line : {corners, edges, plane_of(face.loop)}) {
        out_.text(line);
        out_.text("\n     ");
      }
      out_.text(flat_ ? "0 -1 0 0 0\n" : "0 0 0 0 0\n");
    }
  }

  void write_polyhedra() {
    out_.text(" **polyhedron\n  " + std::to_string(polyhedra_.size()) + "\n");
    for (std::size_t p = 0; p < polyhedra_.size(); ++p) {
      std::string line = "   " + tag(p) + " " + std::to_string(polyhedra_[p].size());
      for (const auto& [slot, outer] : polyhedra_[p]) {
        line += spaced_tag(outer, facets_.number(slot));
      }
      out_.text(line + "\n");
    }
  }

  // --- The box ---

  // "x0", "x1y0", ...: the walls that meet in a corner, an edge or a face of the box.
  static std::string label(unsigned walls) {
    std::string text;
    for (unsigned wall = 0; wall < 6; ++wall) {
      if ((walls >> wall & 1U) != 0) text += {"xyz"[wall / 2], "01"[wall % 2]};
    }
    return text;
  }

  // All sets of `count` walls of different axes.
  [[nodiscard]] std::vector<unsigned> wall_sets(int count) const {
    std::vector<unsigned> sets;
    const unsigned end = 1U << (2 * t_.box.dimension);
    for (unsigned walls = 0; walls < end; ++walls) {
      const bool both = (walls & walls >> 1 & 0x15U) != 0;
      if (!both && std::popcount(walls) == count) sets.push_back(walls);
    }
    return sets;
  }

  [[nodiscard]] Vec3 corner_of_box(unsigned walls) const {
    Vec3 at;
    for (std::size_t a = 0; a < 3; ++a) {
      if ((walls >> (2 * a + 1) & 1U) != 0) at[a] = t_.box.size[a];
    }
    return at;
  }

  // The numbers of what lies in all of these walls, after their count.
  template <class Items>
  static std::string members(unsigned walls, const std::vector<unsigned>& in, const Items& items) {
    std::size_t count = 0;
    std::string list;
    for (std::size_t slot = 0; slot < in.size(); ++slot) {
      if ((in[slot] & walls) != walls) continue;
      ++count;
      list += spaced_tag(false, items.number(slot));
    }
    return std::to_string(count) + list;
  }

  // Places, among `sets`, of those that hold all of `walls`: the corners of an edge, and so on.
  static std::string holders(unsigned walls, const std::vector<unsigned>& sets) {
    std::size_t count = 0;
    std::string list;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      if ((sets[k] & walls) != walls) continue;
      ++count;
      list += spaced_tag(false, k);
    }
    return std::to_string(count) + list;
  }

  void write_domain() {
    const std::vector<unsigned> corners = wall_sets(t_.box.dimension);
    const std::vector<unsigned> edges = wall_sets(t_.box.dimension - 1);
    out_.text(std::string(" **domain\n  *general\n   ") + (flat_ ? "square" : "cube") + "\n");
    out_.text("  *vertex\n   " + std::to_string(corners.size()) + "\n");
    for (std::size_t k = 0; k < corners.size(); ++k) {
      // None where the box is periodic; the format wants one number.
      std::string inside = members(corners[k], vertex_walls_, vertices_);
      if (inside == "0") inside = "1 0";
      out_.text("   " + tag(k) + " " + words(corner_of_box(corners[k])) + " " + label(corners[k]) +
                "\n      " + inside + "\n");
    }
    out_.text("  *edge\n   " + std::to_string(edges.size()) + "\n");
    for (std::size_t k = 0; k < edges.size(); ++k) {
      out_.text("   " + tag(k) + " " + holders(edges[k], corners) + "\n     " + label(edges[k]) +
                "\n     " + members(edges[k], edge_walls_, edges_) + "\n");
    }
    if (!flat_) write_domain_faces(corners, edges);
  }

  void write_domain_faces(const std::vector<unsigned>& corners,
                          const std::vector<unsigned>& edges) {
    std::vector<unsigned> face_walls;
    for (std::size_t slot = 0; slot < faces_.size(); ++slot) {
      const int wall = t_.facets[facets_.key(facets_.number(slot))].wall;
      face_walls.push_back(wall >= 0 ? 1U << wall : 0U);
    }
    out_.text("  *face\n   6\n");
    for (std::size_t wall = 0; wall < 6; ++wall) {
      const unsigned walls = 1U << wall;
      Vec3 normal;
      normal[wall / 2] = wall % 2 == 0 ? 1.0 : -1.0;
      const double d = wall % 2 == 0 ? 0.0 : -t_.box.size[wall / 2];
      out_.text("   " + tag(wall) + " " + ring_of_corners(walls, corners) + "\n     " +
                holders(walls, edges) + "\n     plane\n     4 " + shortest(d) + " " +
                words(normal) + "\n     " + label(walls) + "\n     " +
                members(walls, face_walls, facets_) + "\n");
    }
  }

  // The four corners of a face of the box in order around it.
  static std::string ring_of_corners(unsigned walls, const std::vector<unsigned>& corners) {
    std::vector<std::size_t> of_face;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if ((corners[k] & walls) == walls) of_face.push_back(k);
    }
    std::swap(of_face[2], of_face[3]);  // they come row by row
    std::string text = "4";
    for (const std::size_t k : of_face) text += spaced_tag(false, k);
    return text;
  }

  // --- What periods make one ---

  template <class Items>
  void write_secondary(const char* section, const Items& items, const char* orientation) {
    out_.text(std::string("  *") + section + "\n   " +
              std::to_string(items.count() - items.primary_count()) + "\n");
    for (std::size_t n = items.primary_count(); n < items.count(); ++n) {
      out_.text("   " + tag(n) + " " + tag(items.primary(n)) + " " + words(items.shift(n)) +
                orientation + "\n");
    }
  }

  void write_secondary_seeds() {
    std::vector<Image> images;
    const auto reach = [&](std::size_t axis) { return t_.box.periodic[axis] ? 1 : 0; };
    for (int z = -reach(2); z <= reach(2); ++z) {
      for (int y = -reach(1); y <= reach(1); ++y) {
        for (int x = -reach(0); x <= reach(0); ++x) {
          if (x != 0 || y != 0 || z != 0) images.push_back({x, y, z});
        }
      }
    }
    out_.text("  *seed\n   " + std::to_string(images.size() * owners_.size()) + "\n");
    std::size_t number = owners_.size();
    for (const Image& image : images) {
      for (std::size_t k = 0; k < owners_.size(); ++k) {
        out_.text("   " + tag(number++) + spaced_tag(false, k) + " " + words(image) + "\n");
      }
    }
  }

  void write_periodicity() {
    const auto& per = t_.box.periodic;
    Vec3 distance;
    for (std::size_t a = 0; a < 3; ++a) distance[a] = per[a] ? t_.box.size[a] : 0.0;
    out_.text(" **periodicity\n  *general\n   " + words(Image{per[0], per[1], per[2]}) + "\n   " +
              words(distance) + "\n");
    write_secondary_seeds();
    write_secondary("vertex", vertices_, "");
    // Edges and facets run as their primaries do.
    write_secondary("edge", edges_, " 1");
    if (!flat_) write_secondary("face", facets_, " 1");
  }

  ByteWriter& out_;
  const Tessellation& t_;
  bool flat_;
  std::vector<std::size_t> owners_;  // The cell of the tessellation for each cell of the file.
  ImagedItems<std::int32_t> vertices_;
  ImagedItems<EdgeKey> edges_;
  ImagedItems<std::size_t> facets_;  // In 2D the polygons, which have no images.
  std::vector<TessFace> faces_;      // By slot of facets_.
  std::vector<std::vector<std::pair<std::size_t, bool>>> polyhedra_;  // Slots; whether turned.
  std::vector<unsigned> vertex_walls_, edge_walls_;                   // By slot.
};

}  // namespace

void write_cells_tess(ByteWriter& out, const Tessellation& tessellation, const Packing&) {
  TessFile(out, tessellation).write();
}

}  // namespace packstone
