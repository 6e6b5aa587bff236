#pragma once

/// @file
/// A picture in the plane by cairo, as PNG or SVG.

#include <cairo/cairo.h>

#include <filesystem>
#include <functional>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/io/draw.hpp"

namespace packstone::draw {

/// The part of the plane that a picture shows [L].
struct Frame {
  Vec2 low;
  Vec2 high;

  /// Grows until it holds `p`.
  void include(const Vec2& p);
};

/// The cell alone.
[[nodiscard]] Frame frame_of(const Cell& cell);

/// A picture with the shape of its frame.
struct Sheet {
  Frame frame;
  double pixels = 1.0;  ///< Per unit length.
  int width = 0;
  int height = 0;
};

/// The largest picture within the width and height asked for.
[[nodiscard]] Sheet sheet_for(const Frame& frame, const DrawOptions& options);

void set_color(cairo_t* to, const Vec3& linear);

/// The outline of a body in the plane as the current path.
void outline(cairo_t* to, const Body& body, const Vec3& center);

/// From now on nothing is drawn outside the cell.
void clip_to(cairo_t* to, const Cell& cell);

/// Draws on white paper, with y upward and in units of the cell, by calling `draw`; then the faces
/// of the cell. Writes to `path`, format by ending (.png or .svg). Throws FileError.
void draw_sheet(const std::filesystem::path& path, const Sheet& sheet, const Cell& cell,
                const std::function<void(cairo_t*)>& draw);

}  // namespace packstone::draw
