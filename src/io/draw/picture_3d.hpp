#pragma once

/// @file
/// A 3D packing, ray-traced with soft light.

#include "io/draw/image.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::draw {

/// The picture. Cost: width * height * samples^2 primary rays, two further rays each.
[[nodiscard]] Image picture_3d(const Packing& packing, const DrawOptions& options, RunContext& run);

}  // namespace packstone::draw
