#pragma once

/// @file
/// A 3D packing or tessellation, ray-traced with soft light.

#include "io/draw/image.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone::draw {

/// The picture. Cost: width * height * samples^2 primary rays, two further rays each.
[[nodiscard]] Image picture_3d(const Packing& packing, const DrawOptions& options, RunContext& run);

/// The picture of the cells, each whole, with their edges.
[[nodiscard]] Image cells_3d(const Tessellation& tessellation, const DrawOptions& options,
                             RunContext& run);

}  // namespace packstone::draw
