#pragma once

/// @file
/// Named, seeded inputs shared by tests, benchmarks and examples.

#include <cstdint>
#include <vector>

#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::scenes {

/// FNV-1a over the bits of all centers, sizes and orientations: two packings hash alike only if
/// they are the same to the last bit.
[[nodiscard]] std::uint64_t state_hash(const Packing& packing);

/// `count` prolate ellipsoids of aspect 2 in the periodic unit cube, filling `fraction` of it: a
/// stretched close-packed lattice (with vacancies where the count needs them), shaken by
/// hard-particle Monte Carlo, so that gaps of all sizes occur. Free of overlap. Throws
/// InvalidArgument where the lattice has no room (above some 0.6; less for small counts).
[[nodiscard]] Packing jostled_ellipsoids(std::int64_t count, double fraction, std::uint64_t seed);

/// `count` spheres, radii over a range of 1 to 1000 with density ~ r^-3.5, thrown into the periodic
/// unit cube one by one, largest first, to fill `fraction` (below 0.4). Free of overlap.
[[nodiscard]] Packing polydisperse_spheres(std::int64_t count, double fraction, std::uint64_t seed);

/// `count` spherocylinders of aspect 100, turned at random, thrown into the periodic unit cube one
/// by one to fill `fraction` (below 0.03). Free of overlap.
[[nodiscard]] Packing needles(std::int64_t count, double fraction, std::uint64_t seed);

/// The inclusions of Salnikov et al., Comput. Mech. 55 (2015) 127-144, tables II to VI, in the unit
/// cube: `count_each` equal cylinders with length / diameter `aspect`, axes uniform on the sphere
/// (group 0), then as many equal spheres (group 1). A cylinder that would meet its own image is
/// turned again: it could stand nowhere.
[[nodiscard]] std::vector<OrderedBody> cylinders_and_spheres(int count_each, double sphere_fraction,
                                                             double cylinder_fraction,
                                                             double aspect, std::uint64_t seed);

/// `count` equal ellipsoids of revolution with semi-axes (aspect, 1, 1) times a length, turned
/// uniformly, that fill `fraction` of the unit cube together.
[[nodiscard]] std::vector<OrderedBody> equal_ellipsoids(std::int64_t count, double fraction,
                                                        double aspect, std::uint64_t seed);

}  // namespace packstone::scenes
