#pragma once

/// @file
/// Mat3 and SymMat3: the small matrices that geometry kernels pass by value.

#include "packstone/core/vec.hpp"

namespace packstone {

/// A 3x3 matrix by columns. A rotation has the body axes, seen in the cell frame, as columns.
struct Mat3 {
  Vec3 col_x{1, 0, 0};
  Vec3 col_y{0, 1, 0};
  Vec3 col_z{0, 0, 1};

  friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
};

constexpr Vec3 operator*(const Mat3& m, const Vec3& v) {
  return v.x * m.col_x + v.y * m.col_y + v.z * m.col_z;
}
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  return {a * b.col_x, a * b.col_y, a * b.col_z};
}
constexpr Mat3 transposed(const Mat3& m) {
  return {{m.col_x.x, m.col_y.x, m.col_z.x},
          {m.col_x.y, m.col_y.y, m.col_z.y},
          {m.col_x.z, m.col_y.z, m.col_z.z}};
}
/// Transpose times vector: cell frame to body frame when `m` is a rotation.
constexpr Vec3 mul_transposed(const Mat3& m, const Vec3& v) {
  return {dot(m.col_x, v), dot(m.col_y, v), dot(m.col_z, v)};
}

/// A symmetric 3x3 matrix by its six entries.
struct SymMat3 {
  double xx = 0, yy = 0, zz = 0;
  double yz = 0, xz = 0, xy = 0;

  friend constexpr bool operator==(const SymMat3&, const SymMat3&) = default;
};

constexpr SymMat3 operator+(const SymMat3& a, const SymMat3& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
}
constexpr SymMat3 operator-(const SymMat3& a, const SymMat3& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.yz - b.yz, a.xz - b.xz, a.xy - b.xy};
}
constexpr SymMat3 operator*(double s, const SymMat3& a) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.yz, s * a.xz, s * a.xy};
}
constexpr Vec3 operator*(const SymMat3& m, const Vec3& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
constexpr double trace(const SymMat3& m) { return m.xx + m.yy + m.zz; }

/// The dyad u u^T.
constexpr SymMat3 dyad(const Vec3& u) {
  return {u.x * u.x, u.y * u.y, u.z * u.z, u.y * u.z, u.x * u.z, u.x * u.y};
}

/// R diag(d) R^T: the tensor with values `d` along the columns of the rotation `r`.
constexpr SymMat3 rotated_diagonal(const Mat3& r, const Vec3& d) {
  return d.x * dyad(r.col_x) + d.y * dyad(r.col_y) + d.z * dyad(r.col_z);
}

}  // namespace packstone
