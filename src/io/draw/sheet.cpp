#include "io/draw/sheet.hpp"

#include <cairo/cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "io/draw/cairo_file.hpp"
#include "io/draw/palette.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone::draw {
namespace {

constexpr double kMargin = 12.0;  // [pixels], or a tenth of a small picture

// Cell coordinates to pixels, y upward.
void fit(cairo_t* to, const Sheet& sheet) {
  const Frame& frame = sheet.frame;
  cairo_translate(to, 0.5 * sheet.width, 0.5 * sheet.height);
  cairo_scale(to, sheet.pixels, -sheet.pixels);
  cairo_translate(to, -0.5 * (frame.low.x + frame.high.x), -0.5 * (frame.low.y + frame.high.y));
}

void draw_on_paper(cairo_t* to, const Sheet& sheet, const Cell& cell,
                   const std::function<void(cairo_t*)>& draw) {
  cairo_set_source_rgb(to, 1, 1, 1);
  cairo_paint(to);
  fit(to, sheet);
  cairo_save(to);
  draw(to);
  cairo_restore(to);
  cairo_rectangle(to, 0, 0, cell.size.x, cell.size.y);
  cairo_set_source_rgb(to, 0, 0, 0);
  cairo_set_line_width(to, 1.6 / sheet.pixels);
  cairo_stroke(to);
}

void write_svg(const std::filesystem::path& path, const Sheet& sheet, const Cell& cell,
               const std::function<void(cairo_t*)>& draw) {
  std::string content;
  {
    const SurfacePointer surface(
        cairo_svg_surface_create_for_stream(append_to_string, &content, sheet.width, sheet.height));
    const ContextPointer context(cairo_create(surface.get()));
    draw_on_paper(context.get(), sheet, cell, draw);
    cairo_surface_finish(surface.get());
    check_cairo(cairo_surface_status(surface.get()), path);
  }
  write_atomically(path, content);
}

}  // namespace

void Frame::include(const Vec2& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y)};
}

Frame frame_of(const Cell& cell) { return {{0, 0}, flatten(cell.size)}; }

Sheet sheet_for(const Frame& frame, const DrawOptions& options) {
  Sheet sheet{frame};
  const Vec2 span = frame.high - frame.low;
  const double margin = std::min(kMargin, 0.1 * std::min(options.width, options.height));
  sheet.pixels =
      std::min((options.width - 2 * margin) / span.x, (options.height - 2 * margin) / span.y);
  sheet.width = static_cast<int>(std::ceil(sheet.pixels * span.x + 2 * margin));
  sheet.height = static_cast<int>(std::ceil(sheet.pixels * span.y + 2 * margin));
  return sheet;
}

void set_color(cairo_t* to, const Vec3& linear) {
  cairo_set_source_rgb(to, to_srgb(linear.x), to_srgb(linear.y), to_srgb(linear.z));
}

// Cairo's arcs are exact to a fraction of a pixel.
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

void clip_to(cairo_t* to, const Cell& cell) {
  cairo_rectangle(to, 0, 0, cell.size.x, cell.size.y);
  cairo_clip(to);
}

void draw_sheet(const std::filesystem::path& path, const Sheet& sheet, const Cell& cell,
                const std::function<void(cairo_t*)>& draw) {
  if (path.extension() == ".svg") {
    write_svg(path, sheet, cell, draw);
    return;
  }
  const SurfacePointer surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, sheet.width, sheet.height));
  const ContextPointer context(cairo_create(surface.get()));
  draw_on_paper(context.get(), sheet, cell, draw);
  check_cairo(cairo_status(context.get()), path);
  write_png(path, surface.get());
}

}  // namespace packstone::draw
