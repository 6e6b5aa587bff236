#pragma once

/// @file
/// Colors of inclusions and of cells, linear RGB.

#include <vector>

#include "packstone/core/vec.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone::draw {

/// One color per inclusion, linear RGB in [0, 1].
[[nodiscard]] std::vector<Vec3> inclusion_colors(const Packing& packing, ColorBy color_by);

/// One color per cell of a tessellation, by its own size and orientation.
[[nodiscard]] std::vector<Vec3> cell_colors(const Tessellation& tessellation, ColorBy color_by);

/// Linear intensity in [0, 1] to the sRGB curve, in [0, 1].
[[nodiscard]] double to_srgb(double linear) noexcept;

}  // namespace packstone::draw
