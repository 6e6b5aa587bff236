#include "io/draw/cells_2d.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "io/draw/palette.hpp"
#include "io/draw/sheet.hpp"
#include "io/tessellation/cell_parts.hpp"
#include "io/tessellation/placed_corners.hpp"
#include "packstone/structure/images.hpp"

namespace packstone::draw {
namespace {

// A part of a cell as it is drawn: its outline and holes.
struct Patch {
  std::vector<std::vector<Vec3>> loops;
  std::size_t cell = 0;
};

Frame bounds_of(const Patch& patch) {
  const Vec2 first = flatten(patch.loops[0][0]);
  Frame bounds{first, first};
  for (const Vec3& p : patch.loops[0]) bounds.include(flatten(p));
  return bounds;
}

Patch shifted(const Patch& patch, const Vec3& by) {
  Patch moved = patch;
  for (auto& loop : moved.loops) {
    for (Vec3& p : loop) p += by;
  }
  return moved;
}

// The images of a patch whose bounds meet the box.
void add_images(const Cell& box, const Patch& patch, std::vector<Patch>& patches) {
  const Frame bounds = bounds_of(patch);
  const auto range = [&box](double low, double high, std::size_t axis) {
    if (!box.periodic[axis]) return std::pair(0, 0);
    const double size = box.size[axis];
    return std::pair(static_cast<int>(std::ceil(-high / size)),
                     static_cast<int>(std::floor(1.0 - low / size)));
  };
  const auto [first_x, last_x] = range(bounds.low.x, bounds.high.x, 0);
  const auto [first_y, last_y] = range(bounds.low.y, bounds.high.y, 1);
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      patches.push_back(shifted(patch, image_shift(box, {x, y, 0})));
    }
  }
}

std::vector<Patch> patches_of(const Tessellation& t, bool cut) {
  std::vector<Patch> patches;
  for (const CellPart& part : cell_parts(t)) {
    Patch patch{{}, static_cast<std::size_t>(part.cell)};
    for (const CornerLoop& loop : part.loops) patch.loops.push_back(positions(t, loop));
    if (cut) {
      add_images(t.box, patch, patches);
    } else {
      patches.push_back(std::move(patch));
    }
  }
  return patches;
}

void trace(cairo_t* to, const Patch& patch) {
  cairo_new_path(to);
  for (const auto& loop : patch.loops) {
    for (const Vec3& p : loop) cairo_line_to(to, p.x, p.y);
    cairo_close_path(to);
  }
}

// All areas first, with a hair of the same color so that no paper shows between them.
void draw_patches(cairo_t* to, const std::vector<Patch>& patches, const std::vector<Vec3>& colors,
                  double line) {
  cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(to, 0.5 * line);
  for (const Patch& patch : patches) {
    trace(to, patch);
    set_color(to, colors[patch.cell]);
    cairo_fill_preserve(to);
    cairo_stroke(to);
  }
  cairo_set_source_rgb(to, 0.1, 0.1, 0.1);
  cairo_set_line_width(to, line);
  for (const Patch& patch : patches) {
    trace(to, patch);
    cairo_stroke(to);
  }
}

void draw_inclusions(cairo_t* to, const Packing& packing, bool cut, double line) {
  cairo_set_line_width(to, line);
  for (const Inclusion& inclusion : packing.inclusions) {
    std::vector<std::array<int, 3>> images{{0, 0, 0}};
    if (cut) images = images_in_cell(packing.cell, inclusion);
    for (const auto& image : images) {
      outline(to, inclusion.body, inclusion.center + image_shift(packing.cell, image));
      cairo_set_source_rgba(to, 1, 1, 1, 0.4);
      cairo_fill_preserve(to);
      cairo_set_source_rgba(to, 0, 0, 0, 0.6);
      cairo_stroke(to);
    }
  }
}

}  // namespace

void cells_2d(const std::filesystem::path& path, const Tessellation& t, const Packing& packing,
              const DrawTessellationOptions& options) {
  const bool cut = options.picture.cut;
  const std::vector<Patch> patches = patches_of(t, cut);
  Frame frame = frame_of(t.box);
  for (const Patch& patch : patches) {
    const Frame bounds = bounds_of(patch);
    if (cut) break;
    frame.include(bounds.low);
    frame.include(bounds.high);
  }
  const Sheet sheet = sheet_for(frame, options.picture);
  const std::vector<Vec3> colors = cell_colors(t, options.picture.color_by);
  draw_sheet(path, sheet, t.box, [&](cairo_t* to) {
    if (cut) clip_to(to, t.box);
    draw_patches(to, patches, colors, 1.2 / sheet.pixels);
    if (options.inclusions) draw_inclusions(to, packing, cut, 0.8 / sheet.pixels);
  });
}

}  // namespace packstone::draw
