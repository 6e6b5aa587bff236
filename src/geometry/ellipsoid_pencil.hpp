#pragma once

/// @file
/// The pencil of two ellipsoids, for the search in perram_wertheim.hpp.

#include <cmath>

#include "geometry/perram_wertheim.hpp"
#include "geometry/posed_ellipsoid.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// The pencil of equation (1) in the frame of a, where A is diagonal. n(k) is adj(A + kB) r: a
/// quadratic in k whose coefficients are found once, so that a sample costs no solve.
class EllipsoidPencil {
 public:
  EllipsoidPencil(const PosedEllipsoid& a, const PosedEllipsoid& b, const Vec3& r)
      : b_frame_{a.to_body(b.rotation.col_x), a.to_body(b.rotation.col_y),
                 a.to_body(b.rotation.col_z)},
        r_(a.to_body(r)),
        alpha_(scale(a.axes, a.axes)),
        beta_(scale(b.axes, b.axes)),
        b_(rotated_diagonal(b_frame_, beta_)),
        adj_a_{alpha_.y * alpha_.z, alpha_.z * alpha_.x, alpha_.x * alpha_.y},
        adj_b_{beta_.y * beta_.z, beta_.z * beta_.x, beta_.x * beta_.y},
        // adj(A + kB) = adj A + k M + k^2 adj B; M for a diagonal A:
        mixed_{alpha_.y * b_.zz + alpha_.z * b_.yy,
               alpha_.x * b_.zz + alpha_.z * b_.xx,
               alpha_.x * b_.yy + alpha_.y * b_.xx,
               -alpha_.x * b_.yz,
               -alpha_.y * b_.xz,
               -alpha_.z * b_.xy},
        n0_(scale(adj_a_, r_)),
        n1_(mixed_ * r_),
        n2_(b_frame_ * scale(adj_b_, b.to_body(r))) {}

  /// Along (A + kB)^-1 r, in the frame of a.
  Vec3 direction(double k) const { return n0_ + k * (n1_ + k * n2_); }

  PencilSample at(double k) const {
    const Vec3 n = direction(k);
    const Vec3 slope = n1_ + (2.0 * k) * n2_;
    const Vec3 an = scale(alpha_, n);
    const Vec3 bn = b_ * n;
    return {.k = k,
            .reach = dot(n, r_),
            .support_a = std::sqrt(dot(n, an)),
            .support_b = std::sqrt(dot(n, bn)),
            .bend_a = dot(slope, an),
            .bend_b = dot(slope, bn)};
  }

  /// x of equation (3), relative to the center of a, in its frame.
  Vec3 point(const PencilSample& sample) const {
    return (sample.reach / sample.energy()) * scale(alpha_, direction(sample.k));
  }

  /// Both ends of equation (3), A n and -kB n relative to the centers of a and b, in the frame of
  /// a, after one step of iterative refinement of n = (A + kB)^-1 r. B acts through its axes:
  /// entries of b_ are rounded relative to the largest semi-axis, which the thinnest one feels.
  struct Ends {
    Vec3 from_a, from_b;
  };
  Ends refined_ends(const PencilSample& sample) const {
    const double per_det = sample.reach / sample.energy();  // 1 / det(A + kB)
    Vec3 n = per_det * direction(sample.k);
    const Vec3 residual = r_ - scale(alpha_, n) - sample.k * apply_b(beta_, n);
    n += per_det * adjugate(sample.k, residual);
    return {scale(alpha_, n), -sample.k * apply_b(beta_, n)};
  }

 private:
  Vec3 apply_b(const Vec3& diagonal, const Vec3& v) const {
    return b_frame_ * scale(diagonal, mul_transposed(b_frame_, v));
  }
  Vec3 adjugate(double k, const Vec3& v) const {
    return scale(adj_a_, v) + k * (mixed_ * v + k * apply_b(adj_b_, v));
  }

  Mat3 b_frame_;
  Vec3 r_, alpha_, beta_;
  SymMat3 b_;
  Vec3 adj_a_, adj_b_;
  SymMat3 mixed_;
  Vec3 n0_, n1_, n2_;
};

}  // namespace packstone
