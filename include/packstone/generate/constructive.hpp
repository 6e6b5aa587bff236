#pragma once

/// @file
/// What constructive methods have in common: they place bodies one by one, in the order given, each
/// where it touches what stands already, and never move one again.
///
/// Gravity acts along -y in 2D and along -z in 3D. Along this axis the cell has a floor at 0 and a
/// ceiling at its size, between which bodies stay; the other axes are periodic or have walls.
/// Published methods end at the first body that has no position, so that sizes, aspects and
/// orientations follow their laws to sampling error; advancing_layer.hpp tells how it keeps to
/// them, and takes cells that are periodic along the vertical axis too.

#include <cstdint>
#include <string_view>

#include "packstone/core/cell.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Why a constructive method stopped. All of these are ordinary outcomes; none is an exception.
enum class ConstructiveStop {
  target_reached,  ///< Every body ordered stands.
  full,            ///< A body has no position.
  cancelled,       ///< The run was cancelled; the bodies placed so far stand.
  out_of_time,     ///< The time limit passed; the bodies placed so far stand.
};

/// "target_reached", "full", ...
[[nodiscard]] std::string_view name(ConstructiveStop stop) noexcept;

/// What a run produced and what it cost.
struct ConstructiveResult {
  Packing packing;  ///< The bodies that stand, in the order given. Group names are left to the
                    ///< caller.
  ConstructiveStop stop = ConstructiveStop::target_reached;  ///< Read this before the count.
  std::int64_t tested = 0;    ///< Positions tried, those taken included.
  std::int64_t restarts = 0;  ///< Fresh starts, of methods that make any.
};

/// The axis along which gravity acts, downward: 1 (y) in 2D, 2 (z) in 3D.
[[nodiscard]] constexpr std::size_t vertical_axis(const Cell& cell) noexcept {
  return cell.dimension == 2 ? 1 : 2;
}

}  // namespace packstone
