#include "io/export/vtk_file.hpp"

namespace packstone {
namespace {

void write_section(ByteWriter& out, const std::vector<VtkArray>& arrays, VtkSection section,
                   const std::string& tag) {
  out.text("      <" + tag + ">\n");
  std::uint64_t offset = 0;
  for (const VtkArray& array : arrays) {
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

void write_vtk_grid(ByteWriter& out, std::uint64_t points, std::uint64_t cells,
                    const std::vector<VtkArray>& arrays) {
  out.text(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n  <UnstructuredGrid>\n");
  out.text("    <Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
           std::to_string(cells) + "\">\n");
  write_section(out, arrays, VtkSection::points, "Points");
  write_section(out, arrays, VtkSection::cells, "Cells");
  write_section(out, arrays, VtkSection::point_data, "PointData");
  write_section(out, arrays, VtkSection::cell_data, "CellData");
  out.text("    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  for (const VtkArray& array : arrays) {
    out.number(array.bytes);
    array.write(out);
  }
  out.text("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace packstone
