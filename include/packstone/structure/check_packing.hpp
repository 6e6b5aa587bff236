#pragma once

/// @file
/// The independent verdict on a packing. Shares pair kernels, but no code path, with generators.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/certificate.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Options of check_packing().
struct CheckOptions {
  /// Least gap that every pair must keep [L]. >= 0.
  double min_gap = 0.0;
};

/// Proof that one near pair is apart: g(direction) > 0 in equation (1) of contact.hpp.
struct PairWitness {
  std::int64_t a = 0;          ///< Index of the first inclusion.
  std::int64_t b = 0;          ///< Index of the second; a = b: own image.
  std::array<int, 3> image{};  ///< Periods by which b is shifted.
  Vec3 direction;              ///< Unit, from a to the image of b.
  double gap = 0.0;            ///< Proven lower bound on the gap [L]; <= 0: not proven apart.
};

/// Checks every pair of inclusions over all periodic images, own images included, and every wall.
///
/// What is proven, and how rounding and walls are treated: docs/certificate.md. Reports progress;
/// does not stop half-way, since half a check proves nothing.
///
/// Errors:  throws InvalidArgument if the packing is not well formed, min_gap is not a number >= 0
///          and below every period, or an inclusion is longer than 500 periods or meets over a
///          million own images.
/// Cost:    proportional to inclusions times near neighbors; parallel over inclusions. The result
///          does not depend on the number of threads.
[[nodiscard]] Certificate check_packing(const Packing& packing, const CheckOptions& options = {},
                                        RunContext run = {});

/// An inclusion that is not proven to stay inside the walls.
struct WallCrossing {
  std::int64_t inclusion = 0;
  int axis = 0;        ///< Across which the wall stands: 0, 1, 2 for x, y, z.
  double wall = 0.0;   ///< Where it stands along this axis: 0 or the length of the cell [L].
  double depth = 0.0;  ///< How far the inclusion reaches beyond it [L]; may be mere rounding.
};

/// Every inclusion that Certificate::outside_walls counts, with the wall that it crosses deepest.
///
/// Errors:  throws InvalidArgument if the packing is not well formed.
[[nodiscard]] std::vector<WallCrossing> wall_crossings(const Packing& packing);

/// The deepest of them; nothing where all stay inside. Errors as wall_crossings().
[[nodiscard]] std::optional<WallCrossing> deepest_crossing(const Packing& packing);

/// One separating direction for every pair whose bounding boxes come within `min_gap` of each
/// other: all other pairs are apart because their boxes are. Ordered by (a, b, image).
[[nodiscard]] std::vector<PairWitness> separating_directions(const Packing& packing,
                                                             const CheckOptions& options = {},
                                                             RunContext run = {});

}  // namespace packstone
