#pragma once

/// @file
/// Windows and what stands in them.

#include <limits>

#include "packstone/measure/density.hpp"

namespace packstone::density {

/// Along an axis of this kind every image of a body counts in full.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// How a body stands to a window.
enum class Place { inside, cut, outside };

/// How the box from center - half to center + half stands to the window along the axes other than
/// `skipped`; periodic ones do not count.
[[nodiscard]] Place place_beside(const Cell& cell, const Window& window, const Vec3& center,
                                 const Vec3& half, std::size_t skipped) noexcept;

/// fraction_in_window() of a packing and a window that are known to be good.
[[nodiscard]] WindowFraction fraction_in(const Packing& packing, const Window& window, int threads);

}  // namespace packstone::density
