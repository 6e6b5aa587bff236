#include "io/draw/picture_2d.hpp"

#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "io/draw/cairo_file.hpp"
#include "io/draw/palette.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/structure/images.hpp"

namespace packstone::draw {
namespace {

void set_color(cairo_t* to, const Vec3& linear) {
  cairo_set_source_rgb(to, to_srgb(linear.x), to_srgb(linear.y), to_srgb(linear.z));
}

// The outline of a body as the current path; cairo's arcs are exact to a fraction of a pixel.
void outline(cairo_t* to, const Body& body, const Vec3& center) {
  cairo_save(to);
  cairo_translate(to, center.x, center.y);
  std::visit(Overloaded{[to](const Disk& b) { cairo_scale(to, b.radius, b.radius); },
                        [to](const Ellipse& b) {
                          cairo_rotate(to, b.angle);
                          cairo_scale(to, b.semi_axes.x, b.semi_axes.y);
                        },
                        [](const auto&) {}},
             body);
  cairo_new_path(to);
  cairo_arc(to, 0.0, 0.0, 1.0, 0.0, 2.0 * std::numbers::pi);
  cairo_close_path(to);
  cairo_restore(to);
}

struct Frame {
  Vec2 low;
  Vec2 high;
};

// Every body whole, or the cell alone when bodies are cut at it.
Frame frame_of(const Packing& packing, bool cut) {
  Frame frame{{0, 0}, flatten(packing.cell.size)};
  if (cut) return frame;
  for (const Inclusion& inclusion : packing.inclusions) {
    const Vec2 half = flatten(half_extents(inclusion.body));
    const Vec2 center = flatten(inclusion.center);
    frame.low = {std::min(frame.low.x, center.x - half.x),
                 std::min(frame.low.y, center.y - half.y)};
    frame.high = {std::max(frame.high.x, center.x + half.x),
                  std::max(frame.high.y, center.y + half.y)};
  }
  return frame;
}

// The largest picture within the width and height asked for that has the shape of the frame.
struct Sheet {
  Frame frame;
  double pixels = 1.0;  // per unit length
  int width = 0;
  int height = 0;
};

constexpr double kMargin = 12.0;  // [pixels], or a tenth of a small picture

Sheet sheet_for(const Packing& packing, const DrawOptions& options) {
  Sheet sheet{frame_of(packing, options.cut)};
  const Vec2 span = sheet.frame.high - sheet.frame.low;
  const double margin = std::min(kMargin, 0.1 * std::min(options.width, options.height));
  sheet.pixels =
      std::min((options.width - 2 * margin) / span.x, (options.height - 2 * margin) / span.y);
  sheet.width = static_cast<int>(std::ceil(sheet.pixels * span.x + 2 * margin));
  sheet.height = static_cast<int>(std::ceil(sheet.pixels * span.y + 2 * margin));
  return sheet;
}

// Cell coordinates to pixels, y upward.
void fit(cairo_t* to, const Sheet& sheet) {
  const Frame& frame = sheet.frame;
  cairo_translate(to, 0.5 * sheet.width, 0.5 * sheet.height);
  cairo_scale(to, sheet.pixels, -sheet.pixels);
  cairo_translate(to, -0.5 * (frame.low.x + frame.high.x), -0.5 * (frame.low.y + frame.high.y));
}

void draw_body(cairo_t* to, const Body& body, const Vec3& center, const Vec3& color, double line) {
  outline(to, body, center);
  set_color(to, color);
  cairo_fill_preserve(to);
  set_color(to, 0.35 * color);
  cairo_set_line_width(to, line);
  cairo_stroke(to);
}

void draw_all(cairo_t* to, const Packing& packing, const Sheet& sheet, const DrawOptions& options) {
  cairo_set_source_rgb(to, 1, 1, 1);
  cairo_paint(to);
  fit(to, sheet);
  const double line = 0.8 / sheet.pixels;
  const std::vector<Vec3> colors = inclusion_colors(packing, options.color_by);
  const Vec3& size = packing.cell.size;
  cairo_save(to);
  if (options.cut) {
    cairo_rectangle(to, 0, 0, size.x, size.y);
    cairo_clip(to);
  }
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
  cairo_restore(to);
  cairo_rectangle(to, 0, 0, size.x, size.y);
  cairo_set_source_rgb(to, 0, 0, 0);
  cairo_set_line_width(to, 1.6 / sheet.pixels);
  cairo_stroke(to);
}

void write_svg(const std::filesystem::path& path, const Packing& packing, const Sheet& sheet,
               const DrawOptions& options) {
  std::string content;
  {
    const SurfacePointer surface(
        cairo_svg_surface_create_for_stream(append_to_string, &content, sheet.width, sheet.height));
    const ContextPointer context(cairo_create(surface.get()));
    draw_all(context.get(), packing, sheet, options);
    cairo_surface_finish(surface.get());
    check_cairo(cairo_surface_status(surface.get()), path);
  }
  write_atomically(path, content);
}

}  // namespace

void picture_2d(const std::filesystem::path& path, const Packing& packing,
                const DrawOptions& options) {
  const Sheet sheet = sheet_for(packing, options);
  if (path.extension() == ".svg") {
    write_svg(path, packing, sheet, options);
    return;
  }
  const SurfacePointer surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, sheet.width, sheet.height));
  const ContextPointer context(cairo_create(surface.get()));
  draw_all(context.get(), packing, sheet, options);
  check_cairo(cairo_status(context.get()), path);
  write_png(path, surface.get());
}

}  // namespace packstone::draw
