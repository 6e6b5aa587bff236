#include "packstone/io/export_packing.hpp"

#include "io/export/csv_text.hpp"
#include "io/export/formats.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/inscribed_balls.hpp"

namespace packstone {
namespace {

using WriteFormat = void (*)(ByteWriter&, const Packing&, const ExportOptions&);

WriteFormat format_for(const std::filesystem::path& path, bool balls) {
  const std::filesystem::path ending = path.extension();
  if (balls && ending == ".csv") return write_balls_csv;
  if (balls) throw InvalidArgument(path.string() + ": balls are a table, which ends in .csv");
  if (ending == ".vtu") return write_vtu;
  if (ending == ".stl") return write_stl;
  if (ending == ".csv") return write_csv;
  throw InvalidArgument(path.string() + ": exports end in .vtu, .stl or .csv");
}

}  // namespace

void export_packing(const std::filesystem::path& path, const Packing& packing,
                    const ExportOptions& options) {
  const WriteFormat write = format_for(path, options.ball_spacing.has_value());
  check_well_formed(packing);
  const double spacing = options.ball_spacing.value_or(kMostBallSpacing);
  if (!(spacing >= kLeastBallSpacing && spacing <= kMostBallSpacing)) {
    throw InvalidArgument("ball_spacing = " + shortest(spacing) + ", allowed are 0.01 to 1");
  }
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
