#pragma once

/// @file
/// Pictures of tessellations, without a display.

#include <filesystem>

#include "packstone/core/run_context.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// Options of draw_tessellation().
struct DrawTessellationOptions {
  /// Size, colors, camera, and whether cells are cut at the faces of the box (2D only) or each is
  /// drawn whole. Size and orientation are those of the cells.
  DrawOptions picture;

  /// Also the inclusions, over the cells. 2D only.
  bool inclusions = false;
};

/// Draws to `path`: `.png`, in 2D also `.svg`.
///
/// @param packing  What the tessellation was made of: one inclusion per cell, in order.
///
/// Errors: throws InvalidArgument for an unknown ending, an option out of range, cut or inclusions
///         in 3D, or a tessellation or a packing that is not well formed or does not belong to the
///         other; FileError when the file cannot be written.
void draw_tessellation(const std::filesystem::path& path, const Tessellation& tessellation,
                       const Packing& packing, const DrawTessellationOptions& options = {},
                       RunContext run = {});

}  // namespace packstone
