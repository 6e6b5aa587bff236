#include "io/draw/picture_2d.hpp"

#include <vector>

#include "io/draw/palette.hpp"
#include "io/draw/sheet.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/images.hpp"

namespace packstone::draw {
namespace {

// Every body whole, or the cell alone when bodies are cut at it.
Frame frame_of_bodies(const Packing& packing, bool cut) {
  Frame frame = frame_of(packing.cell);
  if (cut) return frame;
  for (const Inclusion& inclusion : packing.inclusions) {
    const Vec3 half = half_extents(inclusion.body);
    frame.include(flatten(inclusion.center - half));
    frame.include(flatten(inclusion.center + half));
  }
  return frame;
}

void draw_body(cairo_t* to, const Body& body, const Vec3& center, const Vec3& color, double line) {
  outline(to, body, center);
  set_color(to, color);
  cairo_fill_preserve(to);
  set_color(to, 0.35 * color);
  cairo_set_line_width(to, line);
  cairo_stroke(to);
}

void draw_bodies(cairo_t* to, const Packing& packing, const DrawOptions& options, double line) {
  const std::vector<Vec3> colors = inclusion_colors(packing, options.color_by);
  if (options.cut) clip_to(to, packing.cell);
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    const Inclusion& inclusion = packing.inclusions[i];
    if (options.cut) {
      for (const auto& image : images_in_cell(packing.cell, inclusion)) {
        const Vec3 center = inclusion.center + image_shift(packing.cell, image);
        draw_body(to, inclusion.body, center, colors[i], line);
      }
    } else {
      draw_body(to, inclusion.body, inclusion.center, colors[i], line);
    }
  }
}

}  // namespace

void picture_2d(const std::filesystem::path& path, const Packing& packing,
                const DrawOptions& options) {
  const Sheet sheet = sheet_for(frame_of_bodies(packing, options.cut), options);
  draw_sheet(path, sheet, packing.cell,
             [&](cairo_t* to) { draw_bodies(to, packing, options, 0.8 / sheet.pixels); });
}

}  // namespace packstone::draw
