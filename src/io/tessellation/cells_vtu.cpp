#include <cstdint>

#include "io/export/vtk_file.hpp"
#include "io/tessellation/cell_parts.hpp"
#include "io/tessellation/formats.hpp"
#include "io/tessellation/placed_corners.hpp"

namespace packstone {
namespace {

/// The parts as VTK cells: points, the corners of each, and in 3D its faces.
struct VtkCells {
  PlacedCorners points;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::int64_t> faces, face_offsets;  ///< Per polyhedron: count, then count and corners
                                                  ///< of each polygon.
};

void add_polygon(VtkCells& cells, const CornerLoop& outline) {
  for (const FacetCorner& corner : outline) {
    cells.connectivity.push_back(static_cast<std::int64_t>(cells.points.number(corner)));
  }
}

void add_polyhedron(VtkCells& cells, const CellPart& part) {
  PlacedCorners own;
  cells.faces.push_back(static_cast<std::int64_t>(part.loops.size()));
  for (const CornerLoop& loop : part.loops) {
    cells.faces.push_back(static_cast<std::int64_t>(loop.size()));
    for (const FacetCorner& corner : loop) {
      own.number(corner);
      cells.faces.push_back(static_cast<std::int64_t>(cells.points.number(corner)));
    }
  }
  cells.face_offsets.push_back(static_cast<std::int64_t>(cells.faces.size()));
  add_polygon(cells, own.corners());
}

VtkCells vtk_cells(const Tessellation& t, const std::vector<CellPart>& parts) {
  VtkCells cells;
  for (const CellPart& part : parts) {
    if (t.box.dimension == 2) {
      add_polygon(cells, with_slits(t, part));
    } else {
      add_polyhedron(cells, part);
    }
    cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
  }
  return cells;
}

/// One value for each part, from the part or from its cell.
template <class Value>
auto of_parts(const std::vector<CellPart>& parts, Value value) {
  std::vector<decltype(value(parts[0], std::size_t{0}))> values;
  values.reserve(parts.size());
  for (const CellPart& part : parts) {
    values.push_back(value(part, static_cast<std::size_t>(part.cell)));
  }
  return values;
}

std::vector<VtkArray> cell_values(const Tessellation& t, const Packing& packing,
                                  const std::vector<CellPart>& parts) {
  const std::vector<CellShape> shapes = cell_shapes(t);
  const std::vector<double> ordered = ordered_measures(packing);
  const std::vector<int> neighbors = neighbor_counts(t);
  using Part = CellPart;
  std::vector<VtkArray> list;
  const auto add = [&](const char* name, auto value) {
    list.push_back(vtk_array(VtkSection::cell_data, name, of_parts(parts, value)));
  };
  add("inclusion", [](const Part& p, std::size_t) { return static_cast<std::int64_t>(p.cell); });
  add("group", [&](const Part&, std::size_t c) { return std::int32_t{t.cells[c].group}; });
  add("part", [](const Part& p, std::size_t) { return std::int32_t{p.number}; });
  add("part_measure", [](const Part& p, std::size_t) { return p.measure; });
  add("measure", [&](const Part&, std::size_t c) { return shapes[c].measure; });
  add("ordered_measure", [&](const Part&, std::size_t c) { return ordered[c]; });
  add("aspect", [&](const Part&, std::size_t c) { return shapes[c].aspect; });
  add("neighbors", [&](const Part&, std::size_t c) { return std::int32_t{neighbors[c]}; });
  add("semi_axes", [&](const Part&, std::size_t c) { return shapes[c].semi_axes; });
  add("axis", [&](const Part&, std::size_t c) { return shapes[c].axes.col_x; });
  return list;
}

}  // namespace

void write_cells_vtu(ByteWriter& out, const Tessellation& t, const Packing& packing) {
  constexpr std::uint8_t kVtkPolygon = 7, kVtkPolyhedron = 42;
  const std::vector<CellPart> parts = cell_parts(t);
  VtkCells cells = vtk_cells(t, parts);
  const bool flat = t.box.dimension == 2;
  std::vector<VtkArray> arrays;
  const auto add = [&](VtkSection section, const char* name, auto values) {
    arrays.push_back(vtk_array(section, name, std::move(values)));
  };
  const std::uint64_t points = cells.points.corners().size();
  add(VtkSection::points, "Points", cells.points.positions(t));
  add(VtkSection::cells, "connectivity", std::move(cells.connectivity));
  add(VtkSection::cells, "offsets", std::move(cells.offsets));
  add(VtkSection::cells, "types",
      std::vector<std::uint8_t>(parts.size(), flat ? kVtkPolygon : kVtkPolyhedron));
  if (!flat) {
    add(VtkSection::cells, "faces", std::move(cells.faces));
    add(VtkSection::cells, "faceoffsets", std::move(cells.face_offsets));
  }
  for (VtkArray& values : cell_values(t, packing, parts)) arrays.push_back(std::move(values));
  write_vtk_grid(out, points, parts.size(), arrays);
}

}  // namespace packstone
