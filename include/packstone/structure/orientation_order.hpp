#pragma once

/// @file
/// How far from isotropic a sample of axes is, and how far chance alone takes it.
///
/// With <uu> the orientation tensor of the axes (orientation_tensor(), orientation_law.hpp) and
/// l_1 >= l_2 >= l_3 its eigenvalues,
///
///     S   = (3 l_1 - 1) / 2,  in the plane 2 l_1 - 1                                       (1)
///     rho = l_1 / l_3,        in the plane l_1 / l_2                                       (2)
///
/// S is the nematic order parameter, the largest eigenvalue of Q = (3 <uu> - 1) / 2, in the plane
/// 2 <uu> - 1; rho the ratio of E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013) 471-490,
/// section 5. S is 0 and rho 1 for a tensor that is isotropic, and above that for every finite
/// sample: by about 0.80 / sqrt(N) and 3.2 / sqrt(N) for N random axes. So neither is to be judged
/// without random_order(N).

#include <cstdint>
#include <vector>

#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Measures of a tensor <uu>.
struct OrientationOrder {
  Vec3 eigenvalues;      ///< Descending, of sum 1 [-]; in the plane z = 0.
  double nematic = 0.0;  ///< S, equation (1) [-]: 0 isotropic, 1 aligned, 1/4 random in a plane.
  double rho = 1.0;      ///< Equation (2) [-]; infinite where the least eigenvalue is below 1e-13.

  friend bool operator==(const OrientationOrder&, const OrientationOrder&) = default;
};

/// Order of axes with this tensor of trace 1; `dimension` 2 or 3.
[[nodiscard]] OrientationOrder orientation_order(const SymMat3& tensor, int dimension) noexcept;

/// Symmetry axes, symmetry_axis() of inclusion_mix.hpp, of the inclusions of a group: of ellipsoids
/// with three different semi-axes the longest one. None of spheres and disks.
[[nodiscard]] std::vector<Vec3> symmetry_axes(const Packing& packing, int group);

/// A number that chance decides.
struct RandomValue {
  double mean = 0.0;                ///< Infinite where there is none.
  double standard_deviation = 0.0;  ///< Infinite where there is none.
  double low = 0.0;                 ///< One sample in 40 lies below,
  double high = 0.0;                ///< and one in 40 above: 95 % lie between the two.

  friend bool operator==(const RandomValue&, const RandomValue&) = default;
};

/// What independent uniform axes show.
struct RandomOrder {
  RandomValue nematic;  ///< S, equation (1).
  RandomValue rho;      ///< Equation (2).

  friend bool operator==(const RandomOrder&, const RandomOrder&) = default;
};

/// Order of a sample of `count` >= 1 axes that are independent and uniform on the sphere (the
/// circle for `dimension` 2).
///
/// Few axes are easily almost coplanar, which leaves rho without a mean: it is infinite below 5
/// axes (4 in the plane), and its standard deviation below 7 (6). One or two axes in space, or one
/// in the plane, have rho infinite always. The interval from low to high exists from 3 axes (2) on
/// and is the better judge of a single sample.
///
/// Accuracy: 0.3 % of each number (1 % of the upper end of rho below 5 axes). From a table of 2 x
/// 10^6 to 2 x 10^8 samples a row, interpolated in 1 / sqrt(N) between rows, with the limit of
/// large N in closed form: docs/algorithms/orientations.md.
///
/// Cost: 0.2 us for any count. Throws InvalidArgument when count < 1 or dimension is not 2 or 3.
[[nodiscard]] RandomOrder random_order(std::int64_t count, int dimension);

}  // namespace packstone
