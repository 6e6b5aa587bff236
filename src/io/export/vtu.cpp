// The XML format of VTK: "VTK File Formats", in W. Schroeder, K. Martin, B. Lorensen, The
// Visualization Toolkit, 4th ed. (2006); arrays appended raw, each after its size in bytes.

#include <algorithm>
#include <cmath>
#include <functional>

#include "io/export/formats.hpp"
#include "io/export/placements.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/io/surface_mesh.hpp"

namespace packstone {
namespace {

enum class Section { points, cells, point_data, cell_data };

/// One array of the file: its XML attributes, its size, and what writes its values.
struct Array {
  Section section;
  std::string name;
  std::string type;
  int components;
  std::uint64_t bytes;
  std::function<void(ByteWriter&)> write;
};

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

void write_vector(ByteWriter& out, const Vec3& v) {
  out.number(v.x);
  out.number(v.y);
  out.number(v.z);
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

  [[nodiscard]] std::vector<Array> arrays() const {
    std::vector<Array> list;
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

  void add_geometry(std::vector<Array>& list) const {
    list.push_back({Section::points, "Points", "Float64", 3, 24 * point_total_, [this](auto& out) {
                      for (const Placement& p : placements_) {
                        const std::vector<Vec3> points =
                            flat_ ? outline(body(p), segments_)
                                  : surface_mesh(body(p), segments_).points;
                        for (const Vec3& point : points) write_vector(out, p.center + point);
                      }
                    }});
    if (flat_) return;
    list.push_back(
        {Section::point_data, "normal", "Float64", 3, 24 * point_total_, [this](auto& out) {
           for (const Placement& p : placements_) {
             for (const Vec3& n : surface_mesh(body(p), segments_).normals) write_vector(out, n);
           }
         }});
  }

  void add_cells(std::vector<Array>& list) const {
    const std::uint64_t corners = corners_per_cell();
    list.push_back({Section::cells, "connectivity", "Int64", 1, 8 * corners * cell_total_,
                    [this](auto& out) { write_connectivity(out); }});
    list.push_back(
        {Section::cells, "offsets", "Int64", 1, 8 * cell_total_, [this, corners](auto& out) {
           for (std::uint64_t i = 1; i <= cell_total_; ++i) out.number(i * corners);
         }});
    constexpr std::uint8_t kVtkTriangle = 5, kVtkPolygon = 7;
    list.push_back({Section::cells, "types", "UInt8", 1, cell_total_, [this](auto& out) {
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
  void add_value(std::vector<Array>& list, const char* name, const char* type, int components,
                 std::uint64_t bytes, Write write) const {
    list.push_back({Section::cell_data, name, type, components, bytes * cell_total_,
                    [this, write](ByteWriter& out) {
                      for (const Placement& p : placements_) {
                        for (std::uint64_t i = 0; i < cells_of(p); ++i) write(out, p);
                      }
                    }});
  }

  void add_values(std::vector<Array>& list) const {
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

void write_section(ByteWriter& out, const std::vector<Array>& arrays, Section section,
                   const std::string& tag) {
  out.text("      <" + tag + ">\n");
  std::uint64_t offset = 0;
  for (const Array& array : arrays) {
    if (array.section == section) {
      out.text("        <DataArray type=\"" + array.type + "\" Name=\"" + array.name +
               "\" NumberOfComponents=\"" + std::to_string(array.components) +
               "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n");
    }
    offset += sizeof(std::uint64_t) + array.bytes;
  }
  out.text("      </" + tag + ">\n");
}

}  // namespace

void write_vtu(ByteWriter& out, const Packing& packing, const ExportOptions& options) {
  const VtkGrid grid(packing, options);
  const std::vector<Array> arrays = grid.arrays();
  out.text(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n  <UnstructuredGrid>\n");
  out.text("    <Piece NumberOfPoints=\"" + std::to_string(grid.point_total()) +
           "\" NumberOfCells=\"" + std::to_string(grid.cell_total()) + "\">\n");
  write_section(out, arrays, Section::points, "Points");
  write_section(out, arrays, Section::cells, "Cells");
  write_section(out, arrays, Section::point_data, "PointData");
  write_section(out, arrays, Section::cell_data, "CellData");
  out.text("    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  for (const Array& array : arrays) {
    out.number(array.bytes);
    array.write(out);
  }
  out.text("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace packstone
