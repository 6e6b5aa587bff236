#pragma once

/// @file
/// A 2D packing as PNG or SVG by cairo.

#include <filesystem>

#include "packstone/io/draw.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::draw {

/// Draws to `path`, format by ending (.png or .svg). Throws FileError.
void picture_2d(const std::filesystem::path& path, const Packing& packing,
                const DrawOptions& options);

}  // namespace packstone::draw
