#include "packstone/io/export_tessellation.hpp"

#include <string>

#include "io/tessellation/formats.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

using WriteFormat = void (*)(ByteWriter&, const Tessellation&, const Packing&);

WriteFormat format_by_ending(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  if (ending == ".vtu") return write_cells_vtu;
  if (ending == ".csv") return write_cells_csv;
  if (ending == ".tess") return write_cells_tess;
  if (ending == ".geo") return write_cells_geo;
  throw InvalidArgument(path.string() +
                        ": exports of tessellations end in .vtu, .csv, .tess or .geo");
}

}  // namespace

void check_match(const Tessellation& tessellation, const Packing& packing) {
  check_well_formed(packing);
  check_well_formed(tessellation);
  if (tessellation.box == packing.cell && tessellation.cells.size() == packing.inclusions.size()) {
    return;
  }
  throw InvalidArgument("the tessellation has " + std::to_string(tessellation.cells.size()) +
                        " cells, the packing " + std::to_string(packing.inclusions.size()) +
                        " inclusions, or their boxes differ");
}

std::vector<double> ordered_measures(const Packing& packing) {
  std::vector<double> ordered;
  const double scale = 1.0 / fraction(packing);
  for (const Inclusion& inclusion : packing.inclusions) {
    ordered.push_back(scale * volume(inclusion.body));
  }
  return ordered;
}

void export_tessellation(const std::filesystem::path& path, const Tessellation& tessellation,
                         const Packing& packing) {
  const WriteFormat write = format_by_ending(path);
  check_match(tessellation, packing);
  if (write == write_cells_geo && tessellation.box.dimension == 3) {
    throw InvalidArgument(path.string() + ": .geo holds polygons; the cells are polyhedra");
  }
  AtomicFile file(path);
  ByteWriter out(file);
  write(out, tessellation, packing);
  out.flush();
  file.commit();
}

}  // namespace packstone
