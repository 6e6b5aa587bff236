#pragma once

/// @file
/// Support functions bounded from below by quadratic functions of the unit vector d.
///
/// The support functions of our cores are concave functions of one quadratic form,
///
///     ellipsoid            S = sqrt(x),                       x = d.Ad                      (1)
///     cylinder, segment    S = h sqrt(x) + rho sqrt(1 - x),   x = (u.d)^2                   (2)
///
/// and so lie above their chords over any interval of x. For an ellipsoid with low <= S <= high
///
///     S  >=  (x + low high) / (low + high)  =  S + ((S - m)^2 - w^2) / 2m                   (3)
///
/// with m the middle and w the half width of the interval: wrong by the square of the width.
///
/// (2) has kinks, at u.d = 0 (the side lines of a cylinder) and, for rho > 0, at d = +-u (its
/// ends), where chords are wrong by the width itself. There a plane is laid under the kinked term,
/// the one that cancels what slope the rest of the sum has across the kink. With w across u,
///
///     h |u.d|          >=  (u.d) (t + w.d) + (h - |t| - |w|) (u.d)^2 / widest               (4)
///     rho |d - (u.d)u| >=  t.d + (u.d) (w.d) + (rho - |t| - |w|) |d - (u.d)u|^2 / widest    (5)
///
/// where `widest` bounds |u.d| and |d - (u.d)u|.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/axis_segments.hpp"
#include "geometry/minkowski_sum.hpp"
#include "geometry/quadratic_on_sphere.hpp"

namespace packstone {

/// Of a parameter that says where S may be replaced by one quadratic function.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A plane given for the side lines of a rod: t of equation (4), and what is left of h above it.
/// The bend starts `shift` away from the kink.
struct SidePlane {
  double t = 0.0;
  double left = 0.0;
  double shift = 0.0;
};

/// What a minorant may be fitted to.
struct Fit {
  SphereQuadratic rest;             ///< The other terms of the sum.
  Vec3 tight;                       ///< A direction where the bound should be tight.
  double hold = 0.0;                ///< Penalty outside the interval, > 0 above, < 0 below it [L].
  const SidePlane* side = nullptr;  ///< Used in place of a plane fitted to `rest`.
};

/// Minorants of the support of one core over intervals of a parameter of d.
template <class Core>
class SupportChords;

/// Equation (3); the parameter is S itself.
template <>
class SupportChords<Ellipsoid> {
 public:
  explicit SupportChords(const Ellipsoid& body) {
    const Vec3& s = body.semi_axes;
    form_ = rotated_diagonal(to_matrix(body.orientation), scale(s, s));
    range_ = {std::min({s.x, s.y, s.z}) * (1.0 - 4 * kUnitTolerance),
              std::max({s.x, s.y, s.z}) * (1.0 + 4 * kUnitTolerance)};
  }

  Interval range() const { return range_; }
  double parameter(const Vec3& d) const { return support(d); }
  double support(const Vec3& d) const { return std::sqrt(dot(d, form_ * d)); }
  double size() const { return range_.high; }

  SphereQuadratic minorant(const Interval& i, const Fit&) const {
    const double per_sum = 1.0 / (i.low + i.high);
    return {(2.0 * per_sum) * form_, {}, i.low * (i.high * per_sum)};
  }
  bool can_split(const Interval& i) const { return i.low < i.high; }
  /// Chords rise above S outside their interval by themselves.
  int strays(const Interval&, const Vec3&) const { return 0; }

 private:
  SymMat3 form_;
  Interval range_;
};

/// Equations (2), (4), (5); the parameter is the angle between d and the plane across the axis.
class RodChords {
 public:
  /// An axis that is unit but for rounding: its length goes to the half length.
  RodChords(const Vec3& axis, double half_length, double radius)
      : axis_(normalized(axis)), half_length_(half_length * norm(axis)), radius_(radius) {}

  Interval range() const { return {0.0, kRightAngle}; }
  double parameter(const Vec3& d) const {
    return std::atan2(std::abs(dot(axis_, d)), norm(part_across(axis_, d)));
  }
  double support(const Vec3& d) const {
    return half_length_ * std::abs(dot(axis_, d)) + radius_ * norm(part_across(axis_, d));
  }
  double size() const { return half_length_ + radius_; }
  double half_length() const { return half_length_; }
  const Vec3& axis() const { return axis_; }

  SphereQuadratic minorant(const Interval& i, const Fit& fit) const {
    const double sine[] = {std::sin(i.low), std::sin(i.high)};
    const double cosine[] = {std::cos(i.low), std::cos(i.high)};
    const double along = half_length_ / (sine[0] + sine[1]);
    const double across = radius_ / (cosine[0] + cosine[1]);
    const double x_low = sine[0] * sine[0], x_high = sine[1] * sine[1];
    SphereQuadratic m;
    switch (kink(i)) {
      case Kink::none:
        m = chord(along - across, half_length_ * sine[0] + radius_ * cosine[0], x_low);
        break;
      case Kink::side:
        m = chord(-across, radius_ * cosine[0], x_low);
        add_side(m, fit, std::max(sine[1], kNarrowest));
        break;
      case Kink::end:
        m = chord(along, half_length_ * sine[0], x_low);
        add_end(m, fit, std::max(cosine[0], kNarrowest));
        break;
    }
    return m + chord(fit.hold, 0.0, fit.hold > 0.0 ? x_high : x_low);
  }
  bool can_split(const Interval& i) const {
    return i.high - i.low > (kink(i) == Kink::none ? 0.0 : kFinest);
  }
  /// 1: d lies above the interval, -1: below, where planes do not rise above S; 0: neither.
  int strays(const Interval& i, const Vec3& d) const {
    if (kink(i) == Kink::none) return 0;
    const double p = parameter(d);
    return p > i.high ? 1 : p < i.low ? -1 : 0;
  }
  bool at_side(const Interval& i) const { return kink(i) == Kink::side; }

  /// Narrower bends at a kink would make entries of Q that drown the others.
  static constexpr double kNarrowest = 0.02;

 private:
  static constexpr double kRightAngle = 0.5 * std::numbers::pi;
  /// Likewise chords so near a kink.
  static constexpr double kSteepest = 0.005;
  /// Splitting an interval at a kink further gains nothing: it errs by its fourth power.
  static constexpr double kFinest = 1e-7;

  enum class Kink { none, side, end };
  Kink kink(const Interval& i) const {
    const bool side = i.low == 0.0 || i.high <= kSteepest;
    const bool end = radius_ > 0.0 && (i.high == kRightAngle || i.low >= kRightAngle - kSteepest);
    return side == end ? Kink::none : side ? Kink::side : Kink::end;
  }

  /// value + slope (x - x0) with x = (u.d)^2.
  SphereQuadratic chord(double slope, double value, double x0) const {
    return {(2.0 * slope) * dyad(axis_), {}, value - slope * x0};
  }
  /// The matrix of (u.d)(w.d), twice.
  SymMat3 mixed(const Vec3& w) const {
    const Vec3& u = axis_;
    return {2 * u.x * w.x,         2 * u.y * w.y,         2 * u.z * w.z,
            u.y * w.z + u.z * w.y, u.x * w.z + u.z * w.x, u.x * w.y + u.y * w.x};
  }

  /// Equation (4). Where h is too small to cancel the slope everywhere, it is cancelled at `tight`.
  void add_side(SphereQuadratic& m, const Fit& fit, double widest) const {
    if (fit.side) {
      const double bend = fit.side->left / (widest + fit.side->shift);
      m.g -= fit.side->t * axis_;
      m = m + chord(bend, 0.0, fit.side->shift * fit.side->shift);
      return;
    }
    const SphereQuadratic sum = fit.rest + m;
    const double slope = dot(sum.g, axis_);
    double t = slope;
    Vec3 w = -part_across(axis_, sum.q * axis_);
    if (std::abs(t) + norm(w) > half_length_) {
      const Vec3 across = part_across(axis_, fit.tight);
      const double length = norm(across);
      const Vec3 e = length > 0.0 ? across / length : Vec3{};
      const double wanted = std::clamp(slope + dot(w, e), -half_length_, half_length_);
      t = std::clamp(slope, 0.5 * (wanted - half_length_), 0.5 * (wanted + half_length_));
      w = (wanted - t) * e;
    }
    const double left = std::max(0.0, half_length_ - std::abs(t) - norm(w));
    m.q = m.q + mixed(w);
    m.g -= t * axis_;
    m = m + chord(left / widest, 0.0, 0.0);
  }

  /// Equation (5), likewise.
  void add_end(SphereQuadratic& m, const Fit& fit, double widest) const {
    const SphereQuadratic sum = fit.rest + m;
    Vec3 t = part_across(axis_, sum.g);
    Vec3 w = -part_across(axis_, sum.q * axis_);
    if (norm(t) + norm(w) > radius_) {
      const double sign = dot(axis_, fit.tight) < 0.0 ? -1.0 : 1.0;
      const bool odd = norm_sq(t) > norm_sq(w);
      Vec3 wanted = w + sign * t;
      const double length = norm(wanted);
      if (length > radius_) wanted *= radius_ / length;
      t = odd ? sign * wanted : Vec3{};
      w = odd ? Vec3{} : wanted;
    }
    const double left = std::max(0.0, radius_ - norm(t) - norm(w));
    m.q = m.q + mixed(w);
    m.g -= t;
    m = m + chord(-left / widest, 0.0, 1.0);
  }

  Vec3 axis_;
  double half_length_;
  double radius_;
};

template <>
class SupportChords<Cylinder> : public RodChords {
 public:
  explicit SupportChords(const Cylinder& b) : RodChords(b.axis, b.half_length, b.radius) {}
};
template <>
class SupportChords<SegmentCore> : public RodChords {
 public:
  explicit SupportChords(const SegmentCore& b) : RodChords(b.axis, b.half_length, 0.0) {}
};

/// Planes for the sides of two rods with nearly parallel axes, whose side lines kink together:
/// those of the nearest points of the axes, s_a and s_b from the centers. With aligned axes an
/// angle apart
///
///     h_a |u_a.d| + h_b |u_b.d| - s_a u_a.d - s_b u_b.d
///         >=  (h_a + h_b - |s_a + s_b|) (|u_a.d| - angle)
///
/// so that what is left of both bends at |u_a.d| = angle, and is given to the first. That costs the
/// square of the angle, and is done only where little is left of either alone.
struct ParallelSides {
  SidePlane alone[2];     ///< Where the other one is not at its side.
  SidePlane together[2];  ///< Where both are.

  ParallelSides(const RodChords& a, const RodChords& b, const Vec3& r) {
    const double sign = dot(a.axis(), b.axis()) < 0.0 ? -1.0 : 1.0;
    const NearestPoints points =
        nearest_points({a.half_length(), a.axis()}, {b.half_length(), b.axis()}, r);
    const double s_a = dot(points.on_a, a.axis()), s_b = -dot(points.on_b, b.axis());
    alone[0] = {s_a, std::max(0.0, a.half_length() - std::abs(s_a)), 0.0};
    alone[1] = {s_b, std::max(0.0, b.half_length() - std::abs(s_b)), 0.0};
    const double left = a.half_length() + b.half_length() - std::abs(s_a + sign * s_b);
    if (alone[0].left + alone[1].left > 0.25 * left) {
      together[0] = alone[0], together[1] = alone[1];
      return;
    }
    const double angle = 1.01 * norm(b.axis() - sign * a.axis()) + 8 * kUnitRoundoff;
    together[0] = {s_a, std::max(0.0, left), angle};
    together[1] = {s_b, 0.0, 0.0};
  }
};

}  // namespace packstone
