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

/// The rotation with this matrix; the largest of the four components is found first, so that none
/// cancels. K. Shoemake, SIGGRAPH Comput. Graph. 19 (1985) 245-254.
inline Quaternion from_matrix(const Mat3& m) {
  const double xx = m.col_x.x, yy = m.col_y.y, zz = m.col_z.z;
  const double yz = m.col_y.z, zy = m.col_z.y, zx = m.col_z.x, xz = m.col_x.z, xy = m.col_x.y,
               yx = m.col_y.x;
  if (xx + yy + zz > 0.0) {
    return normalized(Quaternion{1.0 + xx + yy + zz, yz - zy, zx - xz, xy - yx});
  }
  if (xx > yy && xx > zz) {
    return normalized(Quaternion{yz - zy, 1.0 + xx - yy - zz, yx + xy, xz + zx});
  }
  if (yy > zz) return normalized(Quaternion{zx - xz, xy + yx, 1.0 + yy - xx - zz, zy + yz});
  return normalized(Quaternion{xy - yx, zx + xz, zy + yz, 1.0 + zz - xx - yy});
}

/// The shortest rotation that turns the unit vector `from` to the unit vector `to`.
inline Quaternion from_to(const Vec3& from, const Vec3& to) {
  constexpr double kOpposite = 1e-6;
  const Vec3 across = cross(from, to);
  const double cosine = dot(from, to);
  if (cosine < -1.0 + kOpposite) {
    // By half a turn first, from where the rest is short.
    const Vec3 axis = any_perpendicular(from);
    return from_to(-from, to) * Quaternion{0.0, axis.x, axis.y, axis.z};
  }
  return normalized(Quaternion{1.0 + cosine, across.x, across.y, across.z});
}

}  // namespace packstone
