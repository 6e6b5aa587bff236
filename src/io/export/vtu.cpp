#include <algorithm>
#include <cmath>

#include "io/export/formats.hpp"
#include "io/export/placements.hpp"
#include "io/export/vtk_file.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/io/surface_mesh.hpp"

namespace packstone {
namespace {

/// Half the length of the body along its own axes; of rods (radius, radius, half length in all).
Vec3 body_half_lengths(const Body& body) {
  return std::visit(Overloaded{[](const Sphere& b) {
                                 return Vec3{b.radius, b.radius, b.radius};
                               },
                               [](const Ellipsoid& b) { return b.semi_axes; },
                               [](const Cylinder& b) {
                                 return Vec3{b.radius, b.radius, b.half_length};
                               },
                               [](const Spherocylinder& b) {
                                 return Vec3{b.radius, b.radius, b.half_length + b.radius};
                               },
                               [](const Disk& b) {
                                 return Vec3{b.radius, b.radius, 0.0};
                               },
                               [](const Ellipse& b) { return lift(b.semi_axes); }},
                    body);
}

/// The packing as points and VTK cells: triangles in 3D, one polygon per body in 2D. Surfaces are
/// made anew for each array rather than kept: a large packing would not fit into memory.
class VtkGrid {
 public:
  VtkGrid(const Packing& packing, const ExportOptions& options)
      : packing_(packing),
        segments_(options.segments),
        flat_(packing.cell.dimension == 2),
        placements_(placements(packing, options.images)) {
    for (const Placement& placement : placements_) {
      point_total_ += points_of(placement);
      cell_total_ += cells_of(placement);
    }
  }

  [[nodiscard]] std::uint64_t point_total() const { return point_total_; }
  [[nodiscard]] std::uint64_t cell_total() const { return cell_total_; }

  [[nodiscard]] std::vector<VtkArray> arrays() const {
    std::vector<VtkArray> list;
    add_geometry(list);
    add_cells(list);
    add_values(list);
    return list;
  }

 private:
  [[nodiscard]] const Body& body(const Placement& placement) const {
    return packing_.inclusions[placement.inclusion].body;
  }
  [[nodiscard]] std::uint64_t points_of(const Placement& placement) const {
    return flat_ ? static_cast<std::uint64_t>(segments_)
                 : point_count(kind(body(placement)), segments_);
  }
  [[nodiscard]] std::uint64_t cells_of(const Placement& placement) const {
    return flat_ ? 1 : triangle_count(kind(body(placement)), segments_);
  }
  [[nodiscard]] std::uint64_t corners_per_cell() const {
    return flat_ ? static_cast<std::uint64_t>(segments_) : 3;
  }

  void add_geometry(std::vector<VtkArray>& list) const {
    list.push_back(
        {VtkSection::points, "Points", "Float64", 3, 24 * point_total_, [this](auto& out) {
           for (const Placement& p : placements_) {
             const std::vector<Vec3> points =
                 flat_ ? outline(body(p), segments_) : surface_mesh(body(p), segments_).points;
             for (const Vec3& point : points) write_vector(out, p.center + point);
           }
         }});
    if (flat_) return;
    list.push_back(
        {VtkSection::point_data, "normal", "Float64", 3, 24 * point_total_, [this](auto& out) {
           for (const Placement& p : placements_) {
             for (const Vec3& n : surface_mesh(body(p), segments_).normals) write_vector(out, n);
           }
         }});
  }

  void add_cells(std::vector<VtkArray>& list) const {
    const std::uint64_t corners = corners_per_cell();
    list.push_back({VtkSection::cells, "connectivity", "Int64", 1, 8 * corners * cell_total_,
                    [this](auto& out) { write_connectivity(out); }});
    list.push_back(
        {VtkSection::cells, "offsets", "Int64", 1, 8 * cell_total_, [this, corners](auto& out) {
           for (std::uint64_t i = 1; i <= cell_total_; ++i) out.number(i * corners);
         }});
    constexpr std::uint8_t kVtkTriangle = 5, kVtkPolygon = 7;
    list.push_back({VtkSection::cells, "types", "UInt8", 1, cell_total_, [this](auto& out) {
                      for (std::uint64_t i = 0; i < cell_total_; ++i) {
                        out.number(flat_ ? kVtkPolygon : kVtkTriangle);
                      }
                    }});
  }

  void write_connectivity(ByteWriter& out) const {
    std::int64_t first = 0;
    for (const Placement& p : placements_) {
      if (flat_) {
        for (std::int64_t i = 0; i < segments_; ++i) out.number(first + i);
      } else {
        for (const auto& triangle : surface_mesh(body(p), segments_).triangles) {
          for (const int corner : triangle) out.number(first + corner);
        }
      }
      first += static_cast<std::int64_t>(points_of(p));
    }
  }

  /// A value per body, repeated for each of its cells.
  template <class Write>
  void add_value(std::vector<VtkArray>& list, const char* name, const char* type, int components,
                 std::uint64_t bytes, Write write) const {
    list.push_back({VtkSection::cell_data, name, type, components, bytes * cell_total_,
                    [this, write](ByteWriter& out) {
                      for (const Placement& p : placements_) {
                        for (std::uint64_t i = 0; i < cells_of(p); ++i) write(out, p);
                      }
                    }});
  }

  void add_values(std::vector<VtkArray>& list) const {
    add_value(list, "inclusion", "Int64", 1, 8, [](auto& out, const Placement& p) {
      out.number(static_cast<std::int64_t>(p.inclusion));
    });
    add_value(list, "group", "Int32", 1, 4, [this](auto& out, const Placement& p) {
      out.number(packing_.inclusions[p.inclusion].group);
    });
    add_value(list, "shape", "UInt8", 1, 1, [this](auto& out, const Placement& p) {
      out.number(static_cast<std::uint8_t>(body(p).index()));
    });
    add_value(list, "image", "Int32", 3, 12, [](auto& out, const Placement& p) {
      for (const int shift : p.image) out.number(shift);
    });
    add_value(list, "volume", "Float64", 1, 8,
              [this](auto& out, const Placement& p) { out.number(volume(body(p))); });
    add_value(list, "semi_axes", "Float64", 3, 24, [this](auto& out, const Placement& p) {
      write_vector(out, body_half_lengths(body(p)));
    });
    add_value(list, "axis", "Float64", 3, 24,
              [this](auto& out, const Placement& p) { write_vector(out, long_axis(body(p))); });
  }

  const Packing& packing_;
  int segments_;
  bool flat_;
  std::vector<Placement> placements_;
  std::uint64_t point_total_ = 0;
  std::uint64_t cell_total_ = 0;
};

}  // namespace

void write_vtu(ByteWriter& out, const Packing& packing, const ExportOptions& options) {
  const VtkGrid grid(packing, options);
  write_vtk_grid(out, grid.point_total(), grid.cell_total(), grid.arrays());
}

}  // namespace packstone
