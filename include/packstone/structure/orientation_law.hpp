#pragma once

/// @file
/// How inclusions are turned: random, aligned, planar, or to a prescribed second-order tensor.

#include <cstdint>
#include <variant>
#include <vector>

#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/distribution.hpp"

namespace packstone {

/// Uniform on SO(3); in 2D any angle alike.
struct RandomOrientation {};

/// Symmetry axis (body z; of an ellipsoid its longest axis) along `axis`; random about it.
struct AlignedOrientation {
  Vec3 axis{0, 0, 1};  ///< Unit.
};

/// Symmetry axis uniform in the plane perpendicular to `normal`; random about itself.
struct PlanarOrientation {
  Vec3 normal{0, 0, 1};  ///< Unit.
};

/// Which family of laws a prescribed tensor is drawn from: the tensor alone does not fix it.
enum class TensorFamily {
  angular_central_gaussian,  ///< D. E. Tyler, Biometrika 74 (1987) 579-589. Default.
  bingham,                   ///< Maximum entropy: C. Bingham, Ann. Stat. 2 (1974) 1201-1225.
};

/// Symmetry axes with sample mean <u u^T> equal to `tensor`, exactly for the finite sample.
struct TensorOrientation {
  SymMat3 tensor{1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0};  ///< Trace 1, positive semidefinite.
  TensorFamily family = TensorFamily::angular_central_gaussian;
};

/// 2D: angle of the major axis [degrees], by any law.
struct AngleOrientation {
  Distribution degrees;
};

using OrientationLaw = std::variant<RandomOrientation, AlignedOrientation, PlanarOrientation,
                                    TensorOrientation, AngleOrientation>;

/// Throws InvalidArgument naming `what` when the law is not one (axis not finite or zero, tensor
/// trace not 1 within 1e-9, tensor not positive semidefinite).
void check_orientation_law(const OrientationLaw& law, const std::string& what);

/// `count` symmetry axes, unit. Axis i starts from the numbers of (seed, group, i); the exact
/// correction of a tensor law then moves all of them a little.
///
/// TensorOrientation: max |<u u^T> - tensor| <= 1e-12, if `count` axes can have it at all (one axis
/// has a tensor of rank 1). Throws InvalidArgument when they cannot.
[[nodiscard]] std::vector<Vec3> draw_axes(const OrientationLaw& law, std::int64_t count,
                                          std::uint64_t seed, std::uint64_t group);

/// `count` rotations: the axes of draw_axes(), each with a random turn about itself. `body_axis`
/// says which body axis is the symmetry axis: 0, 1 or 2.
[[nodiscard]] std::vector<Quaternion> draw_rotations(const OrientationLaw& law, std::int64_t count,
                                                     std::uint64_t seed, std::uint64_t group,
                                                     int body_axis);

/// `count` angles in the plane [rad], in [0, pi).
[[nodiscard]] std::vector<double> draw_angles(const OrientationLaw& law, std::int64_t count,
                                              std::uint64_t seed, std::uint64_t group);

/// Sample mean of u u^T.
[[nodiscard]] SymMat3 orientation_tensor(const std::vector<Vec3>& axes) noexcept;

}  // namespace packstone
