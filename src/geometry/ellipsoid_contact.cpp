#include "packstone/geometry/ellipsoid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/perram_wertheim.hpp"
#include "geometry/posed_ellipsoid.hpp"
#include "packstone/core/tolerances.hpp"

namespace packstone {
namespace {

/// Where contact_scale() may stop [-].
constexpr double kScaleWidth = 2e-13;

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

/// A pair under decision: bodies, separation, the gap asked for and the two proofs.
struct EllipsoidPair {
  PosedEllipsoid a, b;
  Vec3 r;
  double roundoff;

  EllipsoidPair(const Ellipsoid& body_a, const Ellipsoid& body_b, const Vec3& r_ab)
      : a(body_a), b(body_b), r(r_ab), roundoff(gap_roundoff(a, b, r_ab)) {}

  /// Certainly at most g(d), equation (1) of contact.hpp.
  double proven_gap(const Vec3& d) const {
    return dot(d, r) - a.support(d) - b.support(d) - roundoff;
  }
  /// Certainly at most mu: d separates the bodies scaled by less, equation (2).
  double proven_scale(const Vec3& d) const {
    const double rounding = 4 * kUnitRoundoff * norm(r);
    return (dot(d, r) - rounding) / ((a.support(d) + b.support(d)) * (1.0 + kSupportRoundoff));
  }
  /// Certainly at least mu: both bodies scaled by it hold the point, equation (3). It is given from
  /// both centers; the one of the thinner body is believed, since there a rounding costs more.
  double holding_scale(Vec3 from_a, Vec3 from_b) const {
    if (a.least < b.least) {
      from_b = from_a - r;
    } else {
      from_a = from_b + r;
    }
    return std::max(a.level_bound(from_a), b.level_bound(from_b));
  }
  bool both_contain(const Vec3& x) const { return a.contains(x) && b.contains(x - r); }
};

/// A unit vector along r where it has a direction.
Vec3 any_direction(const Vec3& r) {
  const double length = norm(r);
  return length > 0.0 ? r / length : Vec3{0, 0, 1};
}

/// Balls about and in the bodies, before anything is rotated.
Decision decide_by_balls(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r, double min_gap) {
  const auto [least_a, largest_a] = std::minmax({a.semi_axes.x, a.semi_axes.y, a.semi_axes.z});
  const auto [least_b, largest_b] = std::minmax({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z});
  const double apart_sq = norm_sq(r);
  // The slack covers the proof as evaluated by proven_gap(), not only the truth.
  const double outer = (largest_a + largest_b + min_gap) * (1.0 + 8 * kProofRoundoff);
  const double inner = (least_a + least_b) * (1.0 - 8 * kProofRoundoff);
  if (apart_sq > outer * outer) return {Verdict::separated, r / std::sqrt(apart_sq)};
  if (apart_sq < inner * inner) {
    return {Verdict::overlapping,
            min_gap > 0.0 ? any_direction(r) : (least_a / (least_a + least_b)) * r};
  }
  return {};
}

/// Walks along k until a direction proves a gap above `min_gap`, or a point that the bare bodies
/// overlap.
Decision decide_by_pencil(const EllipsoidPair& pair, double min_gap) {
  const double support_a = pair.a.support(pair.r), support_b = pair.b.support(pair.r);
  Decision decision;
  if (norm_sq(pair.r) > support_a + support_b) {
    decision.witness = normalized(pair.r);
    if (pair.proven_gap(decision.witness) > min_gap) {
      decision.verdict = Verdict::separated;
      return decision;
    }
  }
  const EllipsoidPencil pencil(pair.a, pair.b, pair.r);
  search_pencil(pencil, support_a / support_b, [&](const PencilSample& sample) {
    if (sample.separates()) {
      decision.witness = pair.a.rotation * normalized(pencil.direction(sample.k));
      if (pair.proven_gap(decision.witness) <= min_gap) return false;
      decision.verdict = Verdict::separated;
      return true;
    }
    if (!sample.shares_point()) return false;
    const Vec3 point = pair.a.rotation * pencil.point(sample);
    if (!pair.both_contain(point)) return false;
    decision = {Verdict::overlapping, point};
    return true;
  });
  return decision;
}

/// Where rounding of the pencil leaves both proofs open: the gap itself, whose direction does not
/// depend on Y, and the middle of the overlap along it.
Decision decide_closely(const EllipsoidPair& pair, const Gap& gap, double min_gap) {
  if (pair.proven_gap(gap.normal) > min_gap) return {Verdict::separated, gap.normal};
  if (min_gap > 0.0) return decide_by_gap(gap, min_gap);
  const Vec3 middle = 0.5 * (gap.point_a + gap.point_b);
  if (pair.both_contain(middle)) return {Verdict::overlapping, middle};
  return {Verdict::undecided, gap.normal};
}

}  // namespace

Decision decide_by_gap(const Gap& gap, double min_gap) noexcept {
  if (gap.value - gap.error > min_gap) return {Verdict::separated, gap.normal};
  if (gap.value + gap.error <= min_gap) return {Verdict::overlapping, gap.normal};
  return {Verdict::undecided, gap.normal};
}

Decision decide(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab, double min_gap) noexcept {
  const Decision quick = decide_by_balls(a, b, r_ab, min_gap);
  if (quick.verdict != Verdict::undecided) return quick;
  const EllipsoidPair pair(a, b, r_ab);
  const Decision bare = decide_by_pencil(pair, min_gap);
  if (bare.verdict == Verdict::undecided) return decide_closely(pair, gap(a, b, r_ab), min_gap);
  const bool any_gap_overlaps = bare.verdict == Verdict::overlapping && min_gap > 0.0;
  return any_gap_overlaps ? Decision{Verdict::overlapping, any_direction(r_ab)} : bare;
}

ContactScale contact_scale(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  if (r_ab == Vec3{}) return {};
  const EllipsoidPair pair(a, b, r_ab);
  const EllipsoidPencil pencil(pair.a, pair.b, r_ab);
  ContactScale scale{0.0, std::numeric_limits<double>::infinity()};
  search_pencil(
      pencil, pair.a.support(r_ab) / pair.b.support(r_ab), [&](const PencilSample& sample) {
        const Vec3 d = pair.a.rotation * normalized(pencil.direction(sample.k));
        scale.lower = std::max(scale.lower, pair.proven_scale(d));
        const auto [from_a, from_b] = pencil.refined_ends(sample);
        scale.upper = std::min(
            scale.upper, pair.holding_scale(pair.a.rotation * from_a, pair.a.rotation * from_b));
        return scale.upper - scale.lower <= kScaleWidth * scale.upper;
      });
  return scale;
}

}  // namespace packstone
