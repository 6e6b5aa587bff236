#pragma once

/// @file
/// Orders for bodies that grow: the packings of Ghossein and Levesque, and others of every shape.
///
/// All are meant for the unit cube, disks and ellipses for the unit square, periodic along every
/// axis. Group 0 throughout, but for mixtures.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::scenes {

/// Ellipsoids with semi-axes a, b = a / R_1, c = a / R_2, turned uniformly.
struct EllipsoidScene {
  std::string_view name;            ///< "prolate-2", "fig-2a", ...
  int count = 0;                    ///< N.
  double fraction = 0.0;            ///< V_f [-].
  std::array<double, 2> r_1{1, 1};  ///< Uniform from, to; equal: constant [-].
  std::array<double, 2> r_2{1, 1};  ///< The same.
};

/// E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013) 471-490: the twelve rows of table 2,
/// prolate ones first, then oblate ones, "prolate-2" to "oblate-40".
[[nodiscard]] const std::vector<EllipsoidScene>& ghossein_table_2();

/// The same paper: the packings of figures 2 to 5, "fig-2a" to "fig-5b".
[[nodiscard]] const std::vector<EllipsoidScene>& ghossein_figures();

/// A scene of ellipsoids, all with one R_1 and one R_2.
[[nodiscard]] EllipsoidScene alike(std::string_view name, int count, double fraction, double r_1,
                                   double r_2);

/// The bodies of a scene. Where the aspect ratios differ all have the same semi-axis a, as in
/// algorithm 1 of the paper, so that the volumes differ as well.
[[nodiscard]] std::vector<OrderedBody> ellipsoids(const EllipsoidScene& scene, std::uint64_t seed);

/// `count` equal spheres that fill `fraction`.
[[nodiscard]] std::vector<OrderedBody> equal_spheres(std::int64_t count, double fraction);

/// `count` equal cylinders of length / diameter `aspect` that fill `fraction`, axes uniform on the
/// sphere.
[[nodiscard]] std::vector<OrderedBody> equal_cylinders(std::int64_t count, double fraction,
                                                       double aspect, std::uint64_t seed);

/// `count_each` equal cylinders (group 0) and as many equal spheres (group 1), all of the same
/// volume, that fill `fraction` together.
[[nodiscard]] std::vector<OrderedBody> equal_volume_mixture(int count_each, double fraction,
                                                            double aspect, std::uint64_t seed);

/// `count` equal disks that fill `fraction` of the unit square.
[[nodiscard]] std::vector<OrderedBody> equal_disks(std::int64_t count, double fraction);

/// `count` equal ellipses with semi-axes (aspect, 1) times a length, turned uniformly, that fill
/// `fraction` of the unit square.
[[nodiscard]] std::vector<OrderedBody> equal_ellipses(std::int64_t count, double fraction,
                                                      double aspect, std::uint64_t seed);

}  // namespace packstone::scenes
