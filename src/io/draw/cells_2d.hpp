#pragma once

/// @file
/// A tessellation of the plane as PNG or SVG by cairo.

#include <filesystem>

#include "packstone/io/draw_tessellation.hpp"

namespace packstone::draw {

/// Draws to `path`, format by ending (.png or .svg). Throws FileError.
void cells_2d(const std::filesystem::path& path, const Tessellation& tessellation,
              const Packing& packing, const DrawTessellationOptions& options);

}  // namespace packstone::draw
