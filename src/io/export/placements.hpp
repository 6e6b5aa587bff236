#pragma once

/// @file
/// Where the bodies of an export stand: each inclusion, and its images if asked for.

#include <array>
#include <cstddef>
#include <vector>

#include "packstone/structure/face_crossings.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// An inclusion or one of its periodic images.
struct Placement {
  std::size_t inclusion = 0;
  std::array<int, 3> image{0, 0, 0};  ///< Periods by which it is shifted; 0, 0, 0: itself.
  Vec3 center;                        ///< Shifted [L].
  CellFaces cuts;                     ///< Faces of the cell that it cuts; none without images.
};

/// All inclusions in order, each followed by its images that reach into the cell when `images` is
/// set: images_reaching_in().
///
/// Errors: throws InvalidArgument when a body has too many images.
[[nodiscard]] std::vector<Placement> placements(const Packing& packing, bool images);

}  // namespace packstone
