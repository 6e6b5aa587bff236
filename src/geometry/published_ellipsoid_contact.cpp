#include "packstone/geometry/published_ellipsoid_contact.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"

namespace packstone {
namespace {

constexpr Vec3 squared(const Vec3& v) { return scale(v, v); }

constexpr Vec3 inverse(const Vec3& v) { return {1.0 / v.x, 1.0 / v.y, 1.0 / v.z}; }

constexpr double product(const Vec3& v) { return v.x * v.y * v.z; }

/// The upper left 3x3 block of the paper's A, in the frame of the cell or, with `rotation` relative
/// to another body, in the frame of that.
SymMat3 quadric(const Ellipsoid& body, const Mat3& rotation) {
  return rotated_diagonal(rotation, inverse(squared(body.semi_axes)));
}

/// The three principal minors of two rows: without x, without y, without z.
constexpr Vec3 minors(const SymMat3& m) {
  return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy};
}

constexpr double determinant(const SymMat3& m) {
  return m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) +
         m.xz * (m.xy * m.yz - m.yy * m.xz);
}

/// m^-1 v for a positive definite m.
Vec3 solved(const SymMat3& m, const Vec3& v) {
  const Vec3 d = minors(m);
  const SymMat3 adjugate{d.x,
                         d.y,
                         d.z,
                         m.xy * m.xz - m.xx * m.yz,
                         m.xy * m.yz - m.yy * m.xz,
                         m.xz * m.yz - m.zz * m.xy};
  return adjugate * v / determinant(m);
}

/// The matrix C of Algorithm 3, symmetric, in blocks.
struct Bordered {
  SymMat3 block;        // C_11 to C_33
  Vec3 border;          // C_14, C_24, C_34
  double corner = 0.0;  // C_44
};

Bordered in_frame_of_a(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) {
  const Quaternion to_a = conjugate(a.orientation);
  const SymMat3 block = quadric(b, to_matrix(to_a * b.orientation));
  const Vec3 r = rotate(to_a, r_ab);
  const Vec3 border = -(block * r);
  return {block, border, -dot(r, border) - 1.0};
}

/// Two roots of p are positive only if p_1 to p_5 change sign twice; the ends are negative always.
bool changes_sign(const PublishedQuartic& p) {
  return std::any_of(p.begin() + 1, p.end() - 1, [&](double p_k) { return p_k / p[0] < 0.0; });
}

/// The largest root of p', by Newton's method from Cauchy's bound: p' has three real roots, beyond
/// the largest of which p' / p_1 is convex, so that the steps never cross it.
double largest_root_of_derivative(const PublishedQuartic& p) {
  const double b = 0.75 * p[1] / p[0], c = 0.5 * p[2] / p[0], d = 0.25 * p[3] / p[0];
  double x = 1.0 + std::max({std::abs(b), std::abs(c), std::abs(d)});
  constexpr int kMostSteps = 200;  // A third of the distance a step at first.
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = ((x + b) * x + c) * x + d, slope = (3.0 * x + 2.0 * b) * x + c;
    const double next = x - value / slope;
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

}  // namespace

PublishedQuartic published_quartic(const Ellipsoid& a, const Ellipsoid& b,
                                   const Vec3& r_ab) noexcept {
  const auto [block, border, corner] = in_frame_of_a(a, b, r_ab);
  const Vec3 delta = inverse(squared(a.semi_axes));
  const Vec3 pairs{delta.y * delta.z, delta.x * delta.z, delta.x * delta.y};
  const Vec3 diagonal{block.xx, block.yy, block.zz};
  const double p_1 = -product(delta);
  const double p_2 = -dot(pairs, diagonal) - p_1 * corner;
  const double p_3 = dot(pairs, corner * diagonal - squared(border)) - dot(delta, minors(block));
  // The minors of three rows that hold the last one and leave out x, y or z.
  const Vec3 bordered{determinant({block.yy, block.zz, corner, border.z, border.y, block.yz}),
                      determinant({block.xx, block.zz, corner, border.z, border.x, block.xz}),
                      determinant({block.xx, block.yy, corner, border.y, border.x, block.xy})};
  const double p_4 = dot(delta, bordered) - determinant(block);
  const double p_5 = -1.0 / product(squared(b.semi_axes));
  return {p_1, p_2, p_3, p_4, p_5};
}

PublishedEtas published_etas(const PublishedQuartic& p) noexcept {
  const double q_1 = -p[1] / (4.0 * p[0]), q_2 = p[2] / (6.0 * p[0]);
  const double q_3 = -p[3] / (4.0 * p[0]), q_4 = p[4] / p[0];
  const double d_11 = q_1 * q_1 - q_2, d_12 = q_3 - q_1 * q_2;
  const double d_22 = q_2 * q_2 - q_1 * q_3, d_13 = q_4 - q_1 * q_3;
  const double beta_1 = d_13 + 3.0 * d_22;
  const double beta_2 = -q_3 * d_12 - q_4 * d_11 - q_2 * d_22;
  const double first = -9.0 * d_12 * d_12, second = 27.0 * d_11 * d_22, third = -3.0 * d_13 * d_11;
  return {.eta_1 = beta_1 * beta_1 * beta_1 - 27.0 * beta_2 * beta_2,
          .eta_2 = first + second + third,
          .eta_3 = beta_1 * d_12 - 3.0 * q_1 * beta_2,
          .eta_4 = -d_13,
          .eta_5 = d_11,
          .eta_2_size = std::abs(first) + std::abs(second) + std::abs(third)};
}

bool published_touching(const PublishedEtas& eta) noexcept {
  constexpr double kZero = 1e-6;
  if (!(eta.eta_5 > 0.0)) return false;
  if (std::abs(eta.eta_2) <= kZero * eta.eta_2_size) return eta.eta_4 < 0.0;
  return eta.eta_2 > 0.0 && eta.eta_3 < 0.0;
}

PublishedRelation published_relation(const PublishedQuartic& p, PublishedForm form) noexcept {
  const PublishedEtas eta = published_etas(p);
  if (eta.eta_1 == 0.0 && published_touching(eta)) return PublishedRelation::tangent;
  const bool case_1 = eta.eta_1 == 0.0 && eta.eta_2 > 0.0 && eta.eta_3 > 0.0 && eta.eta_5 > 0.0;
  const bool case_2 = eta.eta_1 > 0.0 && eta.eta_2 > 0.0 && eta.eta_5 > 0.0;
  const bool separate = (case_1 || case_2) && (form == PublishedForm::printed || changes_sign(p));
  return separate ? PublishedRelation::separate : PublishedRelation::overlapping;
}

PublishedRelation published_relation(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab,
                                     PublishedForm form) noexcept {
  return published_relation(published_quartic(a, b, r_ab), form);
}

PublishedTouch published_touch(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  const SymMat3 quadric_a = quadric(a, to_matrix(a.orientation));
  const SymMat3 quadric_b = quadric(b, to_matrix(b.orientation));
  const double root = largest_root_of_derivative(published_quartic(a, b, r_ab));
  const Vec3 point = solved(root * quadric_a + quadric_b, quadric_b * r_ab);
  return {root, point, normalized(quadric_a * point)};
}

}  // namespace packstone
