#include "packstone/geometry/ellipse_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/ball_contact.hpp"
#include "geometry/perram_wertheim.hpp"
#include "geometry/posed_ellipse.hpp"

namespace packstone {
namespace {

/// A symmetric matrix of the plane.
struct SymMat2 {
  double xx = 0.0, yy = 0.0, xy = 0.0;

  Vec2 operator*(const Vec2& v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
  SymMat2 adjugate() const { return {yy, xx, -xy}; }
};

SymMat2 rotated_diagonal(const Vec2& u, const Vec2& d) {
  return {d.x * u.x * u.x + d.y * u.y * u.y, d.x * u.y * u.y + d.y * u.x * u.x,
          (d.x - d.y) * u.x * u.y};
}

/// The pencil of equation (1) in ellipsoid_contact.hpp, in the frame of a: n(k) = adj(A + kB) r.
class EllipsePencil {
 public:
  EllipsePencil(const PosedEllipse& a, const PosedEllipse& b, const Vec3& r)
      : r_(a.to_body(r)),
        alpha_{a.axes.x * a.axes.x, a.axes.y * a.axes.y},
        b_(rotated_diagonal(a.to_body(lift(b.x_axis)), {b.axes.x * b.axes.x, b.axes.y * b.axes.y})),
        n0_{alpha_.y * r_.x, alpha_.x * r_.y},
        n1_(b_.adjugate() * r_) {}

  Vec2 direction(double k) const { return n0_ + k * n1_; }

  PencilSample at(double k) const {
    const Vec2 n = direction(k);
    const Vec2 an = apply_a(n);
    const Vec2 bn = b_ * n;
    return {.k = k,
            .reach = dot(n, r_),
            .support_a = std::sqrt(dot(n, an)),
            .support_b = std::sqrt(dot(n, bn)),
            .bend_a = dot(n1_, an),
            .bend_b = dot(n1_, bn)};
  }

  Vec2 point(const PencilSample& sample) const {
    return (sample.reach / sample.energy()) * apply_a(direction(sample.k));
  }

  struct Ends {
    Vec2 from_a, from_b;
  };
  /// Both ends of equation (3), after one step of iterative refinement.
  Ends refined_ends(const PencilSample& sample) const {
    const double per_det = sample.reach / sample.energy();
    Vec2 n = per_det * direction(sample.k);
    const Vec2 residual = r_ - apply_a(n) - sample.k * (b_ * n);
    const Vec2 adj_a{alpha_.y * residual.x, alpha_.x * residual.y};
    n = n + per_det * (adj_a + sample.k * (b_.adjugate() * residual));
    return {apply_a(n), -sample.k * (b_ * n)};
  }

 private:
  Vec2 apply_a(const Vec2& v) const { return {alpha_.x * v.x, alpha_.y * v.y}; }

  Vec2 r_, alpha_;
  SymMat2 b_;
  Vec2 n0_, n1_;
};

/// One ellipse along one direction.
struct OutlineSample {
  double support;
  Vec3 point;
  double curvature_radius;
};

struct CurvedEllipse {
  PosedEllipse pose;
  double product_sq;       ///< (a b)^2 [L^4].
  double least_radius;     ///< Of curvature [L].
  double greatest_radius;  ///< Likewise [L].

  explicit CurvedEllipse(const Ellipse& body) : pose(body) {
    const double product = pose.axes.x * pose.axes.y;
    product_sq = product * product;
    least_radius = pose.least * (pose.least / pose.largest);
    greatest_radius = pose.largest * (pose.largest / pose.least);
  }

  OutlineSample at(const Vec3& d) const {
    const Vec2 v = pose.to_body(d);
    const Vec2 w{pose.axes.x * v.x, pose.axes.y * v.y};
    const double s = norm(w);
    return {s, pose.to_cell({pose.axes.x * w.x / s, pose.axes.y * w.y / s}),
            product_sq / (s * s * s)};
  }

  /// A lower bound on the radius of curvature within `angle` of the sample's direction: S there is
  /// at most what its slope and the greatest radius of curvature allow.
  double least_radius_near(const OutlineSample& s, double slope, double angle) const {
    const double high =
        std::min(pose.largest, s.support + angle * (slope + 0.5 * angle * greatest_radius));
    return std::max(least_radius, product_sq / (high * high * high));
  }
};

/// g and its slope at one angle.
struct AngleSample {
  double angle = 0.0;
  Vec3 d;
  OutlineSample a{}, b{};
  double g = 0.0;
  double slope = 0.0;
  double steepness = 0.0;  ///< |slope|, rounding included.
};

/// Maximizes g over the circle of directions and proves the maximum, equations (1) and (2).
class EllipseGapSearch {
 public:
  EllipseGapSearch(const Ellipse& a, const Ellipse& b, const Vec3& r)
      : a_(a),
        b_(b),
        r_{r.x, r.y, 0.0},
        size_(norm(r_) + a_.pose.largest + b_.pose.largest),
        slope_roundoff_(kSupportRoundoff * (size_ + a_.greatest_radius + b_.greatest_radius)) {}

  Gap run() {
    best_ = climb(at(std::atan2(r_.y, r_.x)));
    const double everywhere =
        bound_within(best_, a_.least_radius + b_.least_radius, std::numbers::pi);
    double upper = everywhere;
    if (everywhere > best_.g + tolerance()) {
      upper = -size_;
      for (int quarter = 0; quarter < 4; ++quarter) {
        upper = std::max(
            upper, bound_on_arc((quarter + 0.5) * 0.5 * std::numbers::pi, 0.25 * std::numbers::pi));
      }
    }
    const double error = std::max(0.0, upper - best_.g) + 2 * kProofRoundoff * size_;
    return {best_.g, error, best_.d, best_.a.point, r_ - best_.b.point};
  }

 private:
  double tolerance() const {
    return 0.25 * kGapRoundoff * std::max(a_.pose.largest, b_.pose.largest);
  }

  AngleSample at(double angle) const {
    AngleSample s;
    s.angle = angle;
    s.d = {std::cos(angle), std::sin(angle), 0.0};
    s.a = a_.at(s.d);
    s.b = b_.at(s.d);
    s.g = dot(s.d, r_) - s.a.support - s.b.support;
    const Vec3 along{-s.d.y, s.d.x, 0.0};
    s.slope = dot(along, r_ - s.a.point - s.b.point);
    s.steepness = std::abs(s.slope) + slope_roundoff_;
    return s;
  }

  /// Equation (2), greatest value for |s| <= half.
  static double bound_within(const AngleSample& s, double rho, double half) {
    const double lifted = s.g + rho;
    const double sine = std::sin(half), cosine = std::cos(half);
    if (lifted > 0.0 && s.steepness * cosine <= lifted * sine) {
      return s.g + s.steepness * s.steepness / (std::hypot(lifted, s.steepness) + lifted);
    }
    return lifted * cosine + s.steepness * sine - rho;
  }

  /// Newton's method on g' with steps halved until g does not fall.
  AngleSample climb(AngleSample s) const {
    const double noise = 4 * kUnitRoundoff * size_;
    for (int iteration = 0; iteration < 50; ++iteration) {
      const double bend = s.g + s.a.curvature_radius + s.b.curvature_radius;
      const double cap = 0.5 * std::numbers::pi;
      double step = bend > 0.0 ? s.slope / bend : std::copysign(0.5, s.slope);
      step = std::clamp(step, -cap, cap);
      bool accepted = false;
      for (int halving = 0; halving < 30 && !accepted; ++halving, step *= 0.5) {
        const AngleSample next = at(s.angle + step);
        accepted =
            next.g > s.g + noise || (next.g >= s.g - noise && next.steepness < 0.9 * s.steepness);
        if (accepted) s = next;
      }
      if (!accepted) break;
    }
    return s;
  }

  /// Upper bound on g over the arc: equation (2) from its middle, or the larger of its halves.
  double bound_on_arc(double middle, double half) {
    const AngleSample s = at(middle);
    if (s.g > best_.g) best_ = climb(s);
    const Vec3 along{-s.d.y, s.d.x, 0.0};
    const double rho = a_.least_radius_near(s.a, std::abs(dot(along, s.a.point)), half) +
                       b_.least_radius_near(s.b, std::abs(dot(along, s.b.point)), half);
    const double bound = bound_within(s, rho, half * (1.0 + 1e-12));
    if (bound <= best_.g + tolerance() || ++spent_ > kBudget || half < 1e-9) return bound;
    return std::max(bound_on_arc(middle - 0.5 * half, 0.5 * half),
                    bound_on_arc(middle + 0.5 * half, 0.5 * half));
  }

  static constexpr int kBudget = 20'000;

  CurvedEllipse a_, b_;
  Vec3 r_;
  double size_;
  double slope_roundoff_;
  AngleSample best_;
  int spent_ = 0;
};

Ellipse as_ellipse(const Disk& disk, double angle) { return {{disk.radius, disk.radius}, angle}; }

Vec3 in_plane(const Vec3& r) { return {r.x, r.y, 0.0}; }

}  // namespace

Decision decide(const Disk& a, const Disk& b, const Vec3& r_ab, double min_gap) noexcept {
  const Vec3 r = in_plane(r_ab);
  const double apart = norm(r);
  const double roundoff = kProofRoundoff * (apart + a.radius + b.radius);
  const Vec3 d = any_direction(r);
  if (apart - a.radius - b.radius - 2 * roundoff > min_gap) return {Verdict::separated, d};
  if (min_gap > 0.0) return decide_by_gap(gap(a, b, r_ab), min_gap);
  const double share = a.radius / (a.radius + b.radius);
  const Vec3 x = share * r;
  const bool in_a = norm(x) <= a.radius * (1.0 - kSupportRoundoff);
  const bool in_b = norm(x - r) <= b.radius * (1.0 - kSupportRoundoff);
  if (in_a && in_b) return {Verdict::overlapping, x};
  return {Verdict::undecided, d};
}

Gap gap(const Disk& a, const Disk& b, const Vec3& r_ab) noexcept {
  const Vec3 r = in_plane(r_ab);
  const double apart = norm(r);
  const Vec3 d = any_direction(r);
  return {apart - a.radius - b.radius, kProofRoundoff * (apart + a.radius + b.radius), d,
          a.radius * d, r - b.radius * d};
}

ContactScale contact_scale(const Disk& a, const Disk& b, const Vec3& r_ab) noexcept {
  const double scale = norm(in_plane(r_ab)) / (a.radius + b.radius);
  return {scale * (1.0 - 4 * kUnitRoundoff), scale * (1.0 + 4 * kUnitRoundoff)};
}

Decision decide(const Disk& a, const Ellipse& b, const Vec3& r_ab, double min_gap) noexcept {
  return decide_ball_in_stages<EllipsePencil, PosedEllipse>(a.radius, as_ellipse(a, b.angle), b,
                                                            in_plane(r_ab), min_gap);
}

Gap gap(const Disk& a, const Ellipse& b, const Vec3& r_ab) noexcept {
  return ball_gap(a.radius, PosedEllipse(b), in_plane(r_ab));
}

ContactScale contact_scale(const Disk& a, const Ellipse& b, const Vec3& r_ab) noexcept {
  return contact_scale(as_ellipse(a, b.angle), b, r_ab);
}

Decision decide(const Ellipse& a, const Ellipse& b, const Vec3& r_ab, double min_gap) noexcept {
  const Vec3 r = in_plane(r_ab);
  return decide_in_stages<EllipsePencil, PosedEllipse>(a, b, r, min_gap,
                                                       [&] { return gap(a, b, r); });
}

Gap gap(const Ellipse& a, const Ellipse& b, const Vec3& r_ab) noexcept {
  return EllipseGapSearch(a, b, r_ab).run();
}

ContactScale contact_scale(const Ellipse& a, const Ellipse& b, const Vec3& r_ab) noexcept {
  return scale_by_pencil<EllipsePencil>(PosedPair<PosedEllipse>(a, b, in_plane(r_ab)));
}

}  // namespace packstone
