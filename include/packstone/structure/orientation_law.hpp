#pragma once

/// @file
/// How inclusions are turned: random, aligned, planar, or to a prescribed second-order tensor.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/distribution.hpp"

namespace packstone {

// The symmetry axis of a body is body z for cylinders and spherocylinders; of an ellipsoid the axis
// of revolution where two semi-axes are equal, and the longest axis otherwise: symmetry_axis() in
// inclusion_mix.hpp. In 2D it is the major axis of the ellipse.

/// Uniform on SO(3); in 2D any angle alike.
struct RandomOrientation {};

/// Symmetry axis along `axis`; random about it.
struct AlignedOrientation {
  Vec3 axis{0, 0, 1};  ///< Of any length > 0; in 2D z = 0.
};

/// Symmetry axis uniform in the plane perpendicular to `normal`; random about itself.
struct PlanarOrientation {
  Vec3 normal{0, 0, 1};  ///< Of any length > 0; in 2D along z.
};

/// Which family of laws a prescribed tensor is drawn from: the tensor alone does not fix it.
enum class TensorFamily {
  angular_central_gaussian,  ///< D. E. Tyler, Biometrika 74 (1987) 579-589. Default.
  bingham,                   ///< Maximum entropy: C. Bingham, Ann. Stat. 2 (1974) 1201-1225.
};

/// Symmetry axes with sample mean <u u^T> equal to `tensor`, exactly for the finite sample.
struct TensorOrientation {
  /// Trace 1 within 1e-9, positive semidefinite within 1e-9; what is missing to both is repaired.
  /// In 2D zz = yz = xz = 0.
  SymMat3 tensor{1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0};
  TensorFamily family = TensorFamily::angular_central_gaussian;
};

/// 2D: angle of the major axis [degrees], by any law.
struct AngleOrientation {
  Distribution degrees;
};

using OrientationLaw = std::variant<RandomOrientation, AlignedOrientation, PlanarOrientation,
                                    TensorOrientation, AngleOrientation>;

/// Throws InvalidArgument naming `what` when the law is not one for a cell of `dimension` 2 or 3:
/// axis not finite or zero, tensor trace not 1 or tensor not positive semidefinite, degrees in 3D,
/// directions out of the plane in 2D.
void check_orientation_law(const OrientationLaw& law, const std::string& what, int dimension = 3);

/// `count` symmetry axes, unit, their sign random or without meaning. Axis i starts from the
/// numbers of (seed, group, i); the exact correction of a tensor law then moves all of them a
/// little: by 50 / sqrt(count) degrees rms, which is the sampling noise itself.
///
/// TensorOrientation: max |<u u^T> - tensor| <= 1e-12 (measured: 1e-15). `count` unit vectors have
/// a second moment A of trace 1 if and only if rank A <= count: the Gram matrix of the vectors has
/// unit diagonal and the eigenvalues of count A, and such a matrix exists when these majorize
/// (1, ..., 1) (I. Schur 1923, A. Horn, Am. J. Math. 76 (1954) 620-630), which count numbers >= 0
/// with sum count always do. Eigenvalues below 1e-13 count as 0; axes then have no component along
/// their eigenvectors at all.
///
/// Errors:  throws InvalidArgument when the rank of the tensor is above `count`, and those of
///          check_orientation_law(). AngleOrientation is for draw_angles() alone.
/// Cost:    some 0.4 us an axis, 1 us with the correction.
[[nodiscard]] std::vector<Vec3> draw_axes(const OrientationLaw& law, std::int64_t count,
                                          std::uint64_t seed, std::uint64_t group);

/// Axes first, first + 1, ... of the law itself, without exact correction: axis i depends on (seed,
/// group, i) alone, and the tensor of a sample is off by some 0.4 / sqrt(count).
[[nodiscard]] std::vector<Vec3> sample_axes(const OrientationLaw& law, std::int64_t count,
                                            std::uint64_t seed, std::uint64_t group,
                                            std::int64_t first = 0);

/// The rotation that turns body axis `body_axis` (0, 1, 2) to the unit vector `axis`, after a turn
/// about itself that is uniform and depends on (seed, group, item) alone.
[[nodiscard]] Quaternion random_turn_about(const Vec3& axis, int body_axis, std::uint64_t seed,
                                           std::uint64_t group, std::int64_t item);

/// `count` rotations: the axes of draw_axes(), each with its random_turn_about().
[[nodiscard]] std::vector<Quaternion> draw_rotations(const OrientationLaw& law, std::int64_t count,
                                                     std::uint64_t seed, std::uint64_t group,
                                                     int body_axis);

/// `count` angles in the plane [rad], in [0, pi), of any law for dimension 2.
[[nodiscard]] std::vector<double> draw_angles(const OrientationLaw& law, std::int64_t count,
                                              std::uint64_t seed, std::uint64_t group);

/// Angles first, first + 1, ... of the law itself, without exact correction.
[[nodiscard]] std::vector<double> sample_angles(const OrientationLaw& law, std::int64_t count,
                                                std::uint64_t seed, std::uint64_t group,
                                                std::int64_t first = 0);

/// Sample mean of u u^T.
[[nodiscard]] SymMat3 orientation_tensor(const std::vector<Vec3>& axes) noexcept;

}  // namespace packstone
