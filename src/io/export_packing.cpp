#include "packstone/io/export_packing.hpp"

#include "io/export/formats.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

using WriteFormat = void (*)(ByteWriter&, const Packing&, const ExportOptions&);

WriteFormat format_by_ending(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  if (ending == ".vtu") return write_vtu;
  if (ending == ".stl") return write_stl;
  if (ending == ".csv") return write_csv;
  throw InvalidArgument(path.string() + ": exports end in .vtu, .stl or .csv");
}

}  // namespace

void export_packing(const std::filesystem::path& path, const Packing& packing,
                    const ExportOptions& options) {
  const WriteFormat write = format_by_ending(path);
  check_well_formed(packing);
  if (options.segments < 8 || options.segments > 4096) {
    throw InvalidArgument("segments = " + std::to_string(options.segments) +
                          ", allowed are 8 to 4096");
  }
  AtomicFile file(path);
  ByteWriter out(file);
  write(out, packing, options);
  out.flush();
  file.commit();
}

}  // namespace packstone
