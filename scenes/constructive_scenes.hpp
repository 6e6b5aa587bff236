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

/// Balls with normal radii in [1, ratio]: mean in the middle, deviation a sixth of the range.
[[nodiscard]] BodySource normal_balls(int dimension, double ratio, std::uint64_t seed);

/// Balls with radii in [1, ratio] of two normal modes of equal weight at a quarter and three
/// quarters of the range, each of deviation 0.08 of it.
[[nodiscard]] BodySource bimodal_balls(int dimension, double ratio, std::uint64_t seed);

/// Ellipses of aspect a / b = `aspect`, areas uniform in [1, area_ratio], turned uniformly.
[[nodiscard]] BodySource uniform_ellipses(double aspect, double area_ratio, std::uint64_t seed);

/// The same, turned by a normal law about x, of this deviation within a half turn [degrees] > 0.
[[nodiscard]] BodySource aligned_ellipses(double aspect, double area_ratio, double deviation,
                                          std::uint64_t seed);

/// Prolate ellipsoids of this aspect turned uniformly, of unit size or log-normal sizes (sigma of
/// the logarithm of the length), within 3 sigma.
[[nodiscard]] BodySource prolate_ellipsoids(double aspect, double sigma, std::uint64_t seed);

/// A square or cube, periodic along the horizontal axes or with walls all around, that `count`
/// bodies of the supply fill to `fraction`.
[[nodiscard]] Cell cell_for(const BodySource& supply, std::int64_t count, double fraction,
                            bool periodic);

/// The part of the window of `packing` that bodies cover: farther than `margin` from floor and
/// walls, and than twice that from the top of what stands. By 2^18 random points.
[[nodiscard]] double interior_fraction(const Packing& packing, double margin);

}  // namespace packstone::scenes
