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
  throw InvalidArgument(path.string() + ": exports of tessellations end in .vtu or .csv");
}

void check_belongs(const Tessellation& tessellation, const Packing& packing) {
  if (tessellation.box == packing.cell && tessellation.cells.size() == packing.inclusions.size()) {
    return;
  }
  throw InvalidArgument("the tessellation has " + std::to_string(tessellation.cells.size()) +
                        " cells, the packing " + std::to_string(packing.inclusions.size()) +
                        " inclusions, or their boxes differ");
}

}  // namespace

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
  check_well_formed(packing);
  check_well_formed(tessellation);
  check_belongs(tessellation, packing);
  AtomicFile file(path);
  ByteWriter out(file);
  write(out, tessellation, packing);
  out.flush();
  file.commit();
}

}  // namespace packstone
