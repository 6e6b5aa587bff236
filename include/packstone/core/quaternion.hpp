#pragma once

/// @file
/// Unit quaternions (w, x, y, z): rotations from the body frame to the cell frame.

#include <cmath>

#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A rotation as a unit quaternion; the default is no rotation.
struct Quaternion {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// Hamilton product: turn by `b`, then by `a`.
constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

constexpr Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }

inline double norm(const Quaternion& q) {
  return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}

inline Quaternion normalized(const Quaternion& q) {
  const double n = norm(q);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

/// The rotation matrix of `q`; columns are the body axes in the cell frame.
constexpr Mat3 to_matrix(const Quaternion& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)},
          {2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)},
          {2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)}};
}

/// `v` turned by `q`.
constexpr Vec3 rotate(const Quaternion& q, const Vec3& v) { return to_matrix(q) * v; }

/// The rotation by `angle` [rad] about the unit vector `axis`.
inline Quaternion from_axis_angle(const Vec3& axis, double angle) {
  const double s = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z};
}

/// The shortest rotation that turns the body z axis to the unit vector `axis`; to full precision
/// also where `axis` is nearly -z.
inline Quaternion from_z_to(const Vec3& axis) {
  const double across = std::hypot(axis.x, axis.y);
  if (across == 0.0) return axis.z < 0.0 ? Quaternion{0, 1, 0, 0} : Quaternion{};
  if (axis.z >= 0.0) return normalized(Quaternion{1.0 + axis.z, -axis.y, axis.x, 0.0});
  // 1 + z cancels: times (1 - z) / across throughout, with (1 + z)(1 - z) = across^2.
  const double factor = (1.0 - axis.z) / across;
  return normalized(Quaternion{across, -factor * axis.y, factor * axis.x, 0.0});
}

}  // namespace packstone
