#include <algorithm>
#include <cmath>

#include "geometry/chord_search.hpp"
#include "geometry/posed_ellipsoid.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"

namespace packstone {
namespace {

/// Support of one body along a unit vector, and the point where it is attained.
struct BodySample {
  double support;
  Vec3 point;
};

/// What the search needs of one body besides its pose.
struct CurvedBody {
  PosedEllipsoid pose;
  SymMat3 shape;           ///< A [L^2].
  double trace, det;       ///< Of A.
  double least_radius;     ///< Of curvature, over the whole surface [L].
  double greatest_radius;  ///< Likewise [L].

  explicit CurvedBody(const Ellipsoid& body)
      : pose(body), shape(rotated_diagonal(pose.rotation, scale(pose.axes, pose.axes))) {
    const Vec3 squares = scale(pose.axes, pose.axes);
    trace = squares.x + squares.y + squares.z;
    det = squares.x * squares.y * squares.z;
    least_radius = pose.least * (pose.least / pose.largest);
    greatest_radius = pose.largest * (pose.largest / pose.least);
  }

  BodySample at(const Vec3& d) const {
    const Vec3 v = scale(pose.axes, pose.to_body(d));
    const double support = norm(v);
    return {support, pose.rotation * (scale(pose.axes, v) / support)};
  }

  /// Hessian of the support function; on the tangent plane its values are the radii of curvature.
  SymMat3 hessian(const BodySample& s) const { return (1.0 / s.support) * (shape - dyad(s.point)); }

  /// A lower bound on the radii of curvature over all directions within `angle` of d. The two radii
  /// have product det / S^4 and sum (trace - |x|^2) / S with |x| >= S; S is bounded on the cap by
  /// its own slope and the greatest radius of curvature.
  double least_radius_near(const Vec3& d, const BodySample& s, double angle) const {
    const double slope = norm(s.point - s.support * d);
    const double high =
        std::min(pose.largest, s.support + angle * (slope + 0.5 * angle * greatest_radius));
    const double low = std::max(pose.least, s.support * std::cos(angle) - slope * std::sin(angle));
    const double product = det / (high * high * high * high);
    const double sum = (trace - low * low) / low;
    const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * product));
    return std::max(least_radius, 2.0 * product / (sum + root));
  }
};

/// g and its tangential gradient at one direction.
struct Sample {
  Vec3 d;
  BodySample a, b;
  double g = 0.0;
  Vec3 tangent;
  double steepness = 0.0;  ///< |tangent|, rounding included.
};

/// Greatest value of (g0 + rho) cos phi + t0 sin phi - rho for 0 <= phi <= angle, equation (5).
double bound_within(double g, double steepness, double rho, double angle) {
  const double lifted = g + rho;
  const double c = std::cos(angle), s = std::sin(angle);
  const bool peak_inside = lifted > 0.0 && steepness * c <= lifted * s;
  if (peak_inside) {
    // sqrt(lifted^2 + steepness^2) - rho without cancellation.
    return g + steepness * steepness / (std::hypot(lifted, steepness) + lifted);
  }
  return lifted * c + steepness * s - rho;
}

class GapSearch {
 public:
  GapSearch(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r)
      : a_(a), b_(b), r_(r), size_(norm(r) + a_.pose.largest + b_.pose.largest) {
    roundoff_ = kProofRoundoff * size_;
    // A support point is off by the rounding of D R^T d times the semi-axes over the support.
    tangent_roundoff_ =
        kSupportRoundoff * (size_ + a_.pose.largest * (a_.pose.largest / a_.pose.least) +
                            b_.pose.largest * (b_.pose.largest / b_.pose.least));
  }

  Gap run(const Ellipsoid& a, const Ellipsoid& b) {
    best_ = climb(at(start_direction()));
    double upper = whole_sphere_bound(best_);
    if (upper - best_.g > tolerance()) {
      ChordSearch<Ellipsoid, Ellipsoid> search(SupportChords<Ellipsoid>(a),
                                               SupportChords<Ellipsoid>(b), r_);
      const double proven = search.upper_bound(*this, tolerance());
      upper = std::min(whole_sphere_bound(best_), proven);
    }
    Gap gap;
    gap.value = best_.g;
    gap.error = std::max(0.0, upper - best_.g) + 2 * roundoff_;
    gap.normal = best_.d;
    gap.point_a = best_.a.point;
    gap.point_b = r_ - best_.b.point;
    return gap;
  }

  // What ChordSearch asks for.
  double g() const { return best_.g; }
  const Vec3& direction() const { return best_.d; }
  void look(const Vec3& d) {
    const Sample there = at(d);
    if (!(there.g > best_.g)) return;
    best_ = climb(there);
    cap_is_known_ = false;
  }
  bool covers(const Vec3& d, double distance) {
    const double from_best = norm(d - best_.d);
    if (!(from_best + distance < 1.5)) return false;
    if (!cap_is_known_) cap_ = certified_cap();
    cap_is_known_ = true;
    return 2.0 * (std::asin(0.5 * from_best) + std::asin(0.5 * distance)) <= cap_;
  }

 private:
  double tolerance() const {
    return 0.25 * kGapRoundoff * std::max(a_.pose.largest, b_.pose.largest);
  }

  Sample at(const Vec3& d) const {
    Sample s;
    s.d = d;
    s.a = a_.at(d);
    s.b = b_.at(d);
    s.g = dot(d, r_) - s.a.support - s.b.support;
    const Vec3 gradient = r_ - s.a.point - s.b.point;
    s.tangent = gradient - dot(gradient, d) * d;
    s.steepness = norm(s.tangent) + tangent_roundoff_;
    return s;
  }

  Vec3 start_direction() const;

  double whole_sphere_bound(const Sample& s) const {
    const double lifted = s.g + a_.least_radius + b_.least_radius;
    if (lifted < 0.0) return s.g - 2.0 * lifted + s.steepness;
    return s.g + s.steepness * s.steepness / (std::hypot(lifted, s.steepness) + lifted);
  }

  double cap_bound(const Sample& s, double angle) const {
    const double rho =
        a_.least_radius_near(s.d, s.a, angle) + b_.least_radius_near(s.d, s.b, angle);
    return bound_within(s.g, s.steepness, rho, angle);
  }

  Vec3 newton_step(const Sample& s) const;
  Sample climb(Sample s) const;
  double certified_cap() const;

  CurvedBody a_, b_;
  Vec3 r_;
  double size_;
  double roundoff_ = 0.0;
  double tangent_roundoff_ = 0.0;
  Sample best_;
  double cap_ = 0.0;  ///< certified_cap() of best_, once asked for.
  bool cap_is_known_ = false;
};

/// The line of centers; where the centers coincide, the shortest semi-axis of the thinner body.
Vec3 GapSearch::start_direction() const {
  if (norm_sq(r_) > 0.0) return normalized(r_);
  const PosedEllipsoid& thin = a_.pose.least < b_.pose.least ? a_.pose : b_.pose;
  return thin.axes.x == thin.least   ? thin.rotation.col_x
         : thin.axes.y == thin.least ? thin.rotation.col_y
                                     : thin.rotation.col_z;
}

/// Newton's step for g on the sphere, in the tangent plane: the Riemannian Hessian of g is minus
/// E^T (H_a + H_b) E - g. Shifted where that is not positive definite.
Vec3 GapSearch::newton_step(const Sample& s) const {
  const SymMat3 hessian = a_.hessian(s.a) + b_.hessian(s.b);
  const Vec3 e1 = any_perpendicular(s.d);
  const Vec3 e2 = cross(s.d, e1);
  double m11 = dot(e1, hessian * e1) + s.g;
  double m22 = dot(e2, hessian * e2) + s.g;
  const double m12 = dot(e1, hessian * e2);
  const double mean = 0.5 * (m11 + m22);
  const double spread = std::hypot(0.5 * (m11 - m22), m12);
  const double least = mean - spread, magnitude = std::abs(mean) + spread;
  if (least < 1e-9 * magnitude) {
    m11 += 1e-3 * magnitude - least;
    m22 += 1e-3 * magnitude - least;
  }
  const double det = m11 * m22 - m12 * m12;
  const double t1 = dot(e1, s.tangent), t2 = dot(e2, s.tangent);
  const Vec3 step = ((m22 * t1 - m12 * t2) / det) * e1 + ((m11 * t2 - m12 * t1) / det) * e2;
  const double length = norm(step);
  constexpr double kLongestStep = 0.7;
  return length > kLongestStep ? (kLongestStep / length) * step : step;
}

/// Ascent to a local maximum of g. Ends when neither g nor, at equal g, the gradient improves.
Sample GapSearch::climb(Sample s) const {
  const double noise = 4 * kUnitRoundoff * size_;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Vec3 step = newton_step(s);
    bool accepted = false;
    for (int halving = 0; halving < 30 && !accepted; ++halving, step *= 0.5) {
      const Sample next = at(normalized(s.d + step));
      accepted =
          next.g > s.g + noise || (next.g >= s.g - noise && next.steepness < 0.9 * s.steepness);
      if (accepted) s = next;
      if (norm_sq(step) < kUnitRoundoff * kUnitRoundoff) break;
    }
    if (!accepted) break;
  }
  return s;
}

/// Radius of a cap about the best direction in which nothing exceeds it by more than the tolerance.
double GapSearch::certified_cap() const {
  for (double angle = 1.5; angle > 1e-6; angle *= 0.7) {
    if (cap_bound(best_, angle) <= best_.g + tolerance()) return angle;
  }
  return 0.0;
}

}  // namespace

Gap gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& r_ab) noexcept {
  return GapSearch(a, b, r_ab).run(a, b);
}

}  // namespace packstone
