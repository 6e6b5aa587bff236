#pragma once

/// @file
/// Endless supplies for methods that fill a cell, and cells with room for so many.

#include <cstdint>

#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::scenes {

/// Balls with radii R = exp(sigma z), z normal, |z| <= ln(ratio) / (2 sigma), so that the largest
/// is `ratio` times the smallest; disks in dimension 2, spheres in 3. sigma 0: all of radius 1.
[[nodiscard]] BodySource lognormal_balls(int dimension, double sigma, double ratio,
                                         std::uint64_t seed);

/// Ellipses of aspect a / b = `aspect`, areas uniform in [1, area_ratio], turned uniformly.
[[nodiscard]] BodySource uniform_ellipses(double aspect, double area_ratio, std::uint64_t seed);

/// A square or cube, periodic along the horizontal axes or with walls all around, that `count`
/// bodies of the supply fill to `fraction`.
[[nodiscard]] Cell cell_for(const BodySource& supply, std::int64_t count, double fraction,
                            bool periodic);

/// The part of the window of `packing` that bodies cover: farther than `margin` from floor and
/// walls, and than twice that from the top of what stands. By 2^18 random points.
[[nodiscard]] double interior_fraction(const Packing& packing, double margin);

}  // namespace packstone::scenes
