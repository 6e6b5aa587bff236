#include "packstone/io/draw.hpp"

#include <cmath>
#include <string>

#include "io/draw/cells_2d.hpp"
#include "io/draw/image.hpp"
#include "io/draw/picture_2d.hpp"
#include "io/draw/picture_3d.hpp"
#include "io/tessellation/formats.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/io/draw_tessellation.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

void check_range(const char* option, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InvalidArgument(std::string("draw option ") + option + " = " + number_text(value) +
                        ", allowed is " + number_text(low) + " to " + number_text(high));
}

void check_options(const std::filesystem::path& path, const Cell& cell, const char* what,
                   const DrawOptions& options) {
  check_range("width", options.width, 16, 16384);
  check_range("height", options.height, 16, 16384);
  check_range("samples", options.samples, 1, 32);
  check_range("azimuth", options.azimuth, -360, 360);
  check_range("elevation", options.elevation, -89, 89);
  const std::string ending = path.extension().string();
  const bool flat = cell.dimension == 2;
  if (ending == ".png" || (flat && ending == ".svg")) return;
  throw InvalidArgument(path.string() + ": cannot draw a " + (flat ? "2D " : "3D ") + what +
                        " to the ending \"" + ending + "\", allowed " +
                        (flat ? "are .png and .svg" : "is .png"));
}

}  // namespace

void draw_packing(const std::filesystem::path& path, const Packing& packing,
                  const DrawOptions& options, RunContext run) {
  check_options(path, packing.cell, "packing", options);
  check_well_formed(packing);
  if (options.cut) check_images(packing);
  if (packing.cell.dimension == 2) {
    draw::picture_2d(path, packing, options);
    return;
  }
  const draw::Image image = draw::picture_3d(packing, options, run);
  if (run.stop_request() == StopRequest::none) draw::write_png(path, image);
}

void draw_tessellation(const std::filesystem::path& path, const Tessellation& tessellation,
                       const Packing& packing, const DrawTessellationOptions& options,
                       RunContext run) {
  check_options(path, tessellation.box, "tessellation", options.picture);
  check_match(tessellation, packing);
  if (tessellation.box.dimension == 2) {
    if (options.inclusions) check_images(packing);
    draw::cells_2d(path, tessellation, packing, options);
    return;
  }
  if (options.picture.cut) throw InvalidArgument("polyhedra are drawn whole, not cut at the box");
  if (options.inclusions)
    throw InvalidArgument("inclusions are drawn over cells in the plane only");
  const draw::Image image = draw::cells_3d(tessellation, options.picture, run);
  if (run.stop_request() == StopRequest::none) draw::write_png(path, image);
}

}  // namespace packstone
