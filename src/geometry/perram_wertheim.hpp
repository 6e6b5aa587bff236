#pragma once

/// @file
/// The one-parameter search behind the contact of two ellipsoids or two ellipses.
///
/// A Pencil is built from two posed bodies and r. It knows the shape matrices A and B and the
/// separation r, and gives for k > 0 a vector n(k) along (A + kB)^-1 r with its derivative. With k
/// = l / (1-l) these are the vectors of equation (1) in ellipsoid_contact.hpp; k is kept in place
/// of l because bodies of very different sizes meet at l next to 0 or 1, where 1-l has no digits
/// left. n may carry any positive factor: everything below is homogeneous in it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {

/// What one n(k) says: its reach along r, the supports of the bodies, and how both change with k.
struct PencilSample {
  double k = 1.0;          ///< Where [-].
  double reach = 0.0;      ///< n.r
  double support_a = 0.0;  ///< sqrt(n.An)
  double support_b = 0.0;  ///< sqrt(n.Bn)
  double bend_a = 0.0;     ///< An.dn/dk, half the slope of n.An
  double bend_b = 0.0;     ///< Bn.dn/dk, half the slope of n.Bn

  /// n.(A + kB)n; the factor that n carries is energy / reach.
  double energy() const { return support_a * support_a + k * support_b * support_b; }
  /// Does n separate the bodies, rounding aside? Equation (2).
  bool separates() const { return reach > support_a + support_b; }
  /// Do both bodies hold the point A (A + kB)^-1 r, rounding aside? Equation (3).
  bool shares_point() const { return std::max(support_a, k * support_b) * reach < energy(); }

  /// Newton's step on support_a / support_b - k, whose root makes both levels of (3) equal.
  double newton_step() const {
    const double quad_b = support_b * support_b;
    const double bend = bend_a * quad_b - bend_b * support_a * support_a;
    return (support_a - k * support_b) * support_a * quad_b /
           (support_a * support_b * quad_b - bend);
  }
};

/// Evaluates `pencil` at one k after another, each nearer to the k where both levels are equal, and
/// hands every sample to `visit` until that returns true. Newton's step, replaced by bisection of
/// log k where it leaves the interval known to hold the root.
///
/// @return  Whether `visit` was satisfied within the budget.
template <class Pencil, class Visit>
bool search_pencil(const Pencil& pencil, double start, const Visit& visit) {
  constexpr int kBudget = 60;
  constexpr double kResolution = 4e-16;
  double low = 0.0, high = std::numeric_limits<double>::infinity(), k = start;
  for (int step = 0; step < kBudget; ++step) {
    const PencilSample sample = pencil.at(k);
    if (visit(sample)) return true;
    (sample.support_a > k * sample.support_b ? low : high) = k;
    double next = k + sample.newton_step();
    if (!(next > low && next < high)) next = std::clamp(std::sqrt(low * high), 0.1 * k, 10.0 * k);
    if (std::abs(next - k) <= kResolution * k) return false;
    k = next;
  }
  return false;
}

/// A pair with the two proofs that a verdict may rest on. Posed is PosedEllipsoid or PosedEllipse.
template <class Posed>
struct PosedPair {
  Posed a, b;
  Vec3 r;
  double roundoff;  ///< What rounding may add to g(d), see kProofRoundoff [L].

  template <class Body>
  PosedPair(const Body& body_a, const Body& body_b, const Vec3& r_ab)
      : a(body_a),
        b(body_b),
        r(r_ab),
        roundoff(kProofRoundoff * (norm(r_ab) + a.largest + b.largest)) {}

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
inline Vec3 any_direction(const Vec3& r) {
  const double length = norm(r);
  return length > 0.0 ? r / length : Vec3{1, 0, 0};
}

inline std::pair<double, double> extreme_semi_axes(const Ellipsoid& body) {
  return std::minmax({body.semi_axes.x, body.semi_axes.y, body.semi_axes.z});
}
inline std::pair<double, double> extreme_semi_axes(const Ellipse& body) {
  return std::minmax({body.semi_axes.x, body.semi_axes.y});
}

/// Balls about and in the bodies, before anything is rotated.
inline Decision decide_by_balls(double least_a, double largest_a, double least_b, double largest_b,
                                const Vec3& r, double min_gap) {
  const double apart_sq = norm_sq(r);
  // The slack covers the proof as proven_gap() and contains() evaluate it, not only the truth.
  const double outer = (largest_a + largest_b + min_gap) * (1.0 + 8 * kProofRoundoff);
  const double inner = (least_a + least_b) * (1.0 - 8 * kProofRoundoff);
  if (apart_sq > outer * outer) return {Verdict::separated, r / std::sqrt(apart_sq)};
  if (apart_sq >= inner * inner) return {};
  const Vec3 shared = (least_a / (least_a + least_b)) * r;
  return {Verdict::overlapping, min_gap > 0.0 ? any_direction(r) : shared};
}

/// Walks along k until a direction proves a gap above `min_gap`, or a point that the bare bodies
/// overlap.
template <class Pencil, class Posed>
Decision decide_by_pencil(const PosedPair<Posed>& pair, double min_gap) {
  const double support_a = pair.a.support(pair.r), support_b = pair.b.support(pair.r);
  if (norm_sq(pair.r) > support_a + support_b) {
    const Vec3 d = normalized(pair.r);
    if (pair.proven_gap(d) > min_gap) return {Verdict::separated, d};
  }
  Decision decision;
  const Pencil pencil(pair.a, pair.b, pair.r);
  search_pencil(pencil, support_a / support_b, [&](const PencilSample& sample) {
    if (sample.separates()) {
      const Vec3 d = normalized(pair.a.to_cell(pencil.direction(sample.k)));
      if (pair.proven_gap(d) <= min_gap) return false;
      decision = {Verdict::separated, d};
      return true;
    }
    if (!sample.shares_point()) return false;
    const Vec3 point = pair.a.to_cell(pencil.point(sample));
    if (!pair.both_contain(point)) return false;
    decision = {Verdict::overlapping, min_gap > 0.0 ? any_direction(pair.r) : point};
    return true;
  });
  return decision;
}

/// The verdict that a gap with its error supports.
inline Decision decide_by_gap(const Gap& gap, double min_gap) {
  if (gap.value - gap.error > min_gap) return {Verdict::separated, gap.normal};
  if (gap.value + gap.error <= min_gap) return {Verdict::overlapping, gap.normal};
  return {Verdict::undecided, gap.normal};
}

/// Where rounding of the pencil leaves both proofs open: the gap itself, whose direction does not
/// depend on Y, and the middle of the overlap along it.
template <class Posed>
Decision decide_closely(const PosedPair<Posed>& pair, const Gap& gap, double min_gap) {
  if (pair.proven_gap(gap.normal) > min_gap) return {Verdict::separated, gap.normal};
  if (min_gap > 0.0) return decide_by_gap(gap, min_gap);
  const Vec3 middle = 0.5 * (gap.point_a + gap.point_b);
  if (pair.both_contain(middle)) return {Verdict::overlapping, middle};
  return {Verdict::undecided, gap.normal};
}

/// All stages, the cheap ones first. `find_gap()` is asked where rounding leaves the others open.
template <class Pencil, class Posed, class Body, class FindGap>
Decision decide_in_stages(const Body& a, const Body& b, const Vec3& r, double min_gap,
                          const FindGap& find_gap) {
  const auto [least_a, largest_a] = extreme_semi_axes(a);
  const auto [least_b, largest_b] = extreme_semi_axes(b);
  const Decision quick = decide_by_balls(least_a, largest_a, least_b, largest_b, r, min_gap);
  if (quick.verdict != Verdict::undecided) return quick;
  const PosedPair<Posed> pair(a, b, r);
  const Decision decision = decide_by_pencil<Pencil>(pair, min_gap);
  if (decision.verdict != Verdict::undecided) return decision;
  return decide_closely(pair, find_gap(), min_gap);
}

/// Bracket of mu from (2) and (3), as narrow as rounding allows but not below 2e-13.
template <class Pencil, class Posed>
ContactScale scale_by_pencil(const PosedPair<Posed>& pair) {
  constexpr double kWidth = 2e-13;
  if (pair.r == Vec3{}) return {};
  const Pencil pencil(pair.a, pair.b, pair.r);
  ContactScale scale{0.0, std::numeric_limits<double>::infinity()};
  search_pencil(
      pencil, pair.a.support(pair.r) / pair.b.support(pair.r), [&](const PencilSample& sample) {
        const Vec3 d = normalized(pair.a.to_cell(pencil.direction(sample.k)));
        scale.lower = std::max(scale.lower, pair.proven_scale(d));
        const auto [from_a, from_b] = pencil.refined_ends(sample);
        scale.upper = std::min(scale.upper,
                               pair.holding_scale(pair.a.to_cell(from_a), pair.a.to_cell(from_b)));
        return scale.upper - scale.lower <= kWidth * scale.upper;
      });
  return scale;
}

}  // namespace packstone
