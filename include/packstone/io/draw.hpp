#pragma once

/// @file
/// Pictures of packings, without a display: 3D ray-traced, 2D crisp.

#include <filesystem>

#include "packstone/core/run_context.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// What the color of an inclusion says.
enum class ColorBy { group, size, orientation };

/// Options of draw_packing().
struct DrawOptions {
  int width = 1200;   ///< [pixels], 16 to 16384. A 2D picture keeps the shape of the cell within
  int height = 1000;  ///< width x height.
  ColorBy color_by = ColorBy::group;

  /// true: bodies and their images are cut at the faces of the cell; false: each body whole.
  bool cut = false;

  /// Camera direction: turn about z, then height above the horizon [degrees].
  double azimuth = 35.0;
  double elevation = 25.0;

  /// Rays per pixel = samples^2, and as many for soft light. 1 to 32.
  int samples = 4;
};

/// Draws to `path`: `.png`, and for 2D packings also `.svg`.
///
/// Errors: throws InvalidArgument for an unknown ending or an option out of range, FileError when
/// the
///         file cannot be written.
void draw_packing(const std::filesystem::path& path, const Packing& packing,
                  const DrawOptions& options = {}, RunContext run = {});

}  // namespace packstone
