#include "generate/rsa/outline.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/overloaded.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"

namespace packstone::rsa {
namespace {

// Verdicts drawn from outlines keep this distance from equality [-]. It is far above the rounding
// of the few operations below and above kProofRoundoff, so that the exact kernel, asked about the
// same pair, proves what the outline has claimed.
constexpr double kMargin = 1e-12;
static_assert(kMargin > 32 * kProofRoundoff);

// The capsule about an ellipsoid with the longest semi-axis `a` along `axis` and the next one `b`:
// at height z its section has the radius b sqrt(1 - z^2 / a^2) <= sqrt(b^2 - (|z| - h)^2) for
// h = a - b, since (|z| - h) <= b |z| / a.
void set_loose(Outline& outline, const Vec3& axis, double a, double b) {
  outline.axis = axis;
  outline.half_length = a - b;
  outline.radius = b;
  outline.ends = Outline::Ends::loose;
}

void set_ellipsoid(Outline& outline, const Ellipsoid& body) {
  const Mat3 rotation = to_matrix(body.orientation);
  const Vec3& s = body.semi_axes;
  if (s.x >= s.y && s.x >= s.z) {
    set_loose(outline, rotation.col_x, s.x, std::max(s.y, s.z));
  } else if (s.y >= s.z) {
    set_loose(outline, rotation.col_y, s.y, std::max(s.x, s.z));
  } else {
    set_loose(outline, rotation.col_z, s.z, std::max(s.x, s.y));
  }
}

void set_ellipse(Outline& outline, const Ellipse& body) {
  const double c = std::cos(body.angle), s = std::sin(body.angle);
  if (body.semi_axes.x >= body.semi_axes.y) {
    set_loose(outline, {c, s, 0}, body.semi_axes.x, body.semi_axes.y);
  } else {
    set_loose(outline, {-s, c, 0}, body.semi_axes.y, body.semi_axes.x);
  }
}

// Parameters of the closest points of the segments s u_a and r + t u_b. Nearly parallel segments
// may get a pair that is only nearly closest; no verdict rests on it being closest.
struct ClosestPoints {
  double s;
  double t;
  bool common_perpendicular;  // Inside both segments, where rounding leaves no doubt about it.
};
inline ClosestPoints closest_points(const Outline& a, const Outline& b, const Vec3& r) {
  const double c = dot(a.axis, b.axis);
  const double ra = dot(a.axis, r), rb = dot(b.axis, r);
  const double det = 1.0 - c * c;
  double s = 0.0;
  if (det > 1e-10) {
    const double free_s = (ra - c * rb) / det;
    const double free_t = c * free_s - rb;
    if (std::abs(free_s) < a.half_length && std::abs(free_t) < b.half_length) {
      return {free_s, free_t, det > 1e-2};
    }
    s = std::clamp(free_s, -a.half_length, a.half_length);
  } else {
    // Parallel: the middle of the stretch along which they face each other.
    const double lo = std::max(-a.half_length, ra - b.half_length);
    const double hi = std::min(a.half_length, ra + b.half_length);
    s = std::clamp(0.5 * (lo + hi), -a.half_length, a.half_length);
  }
  const double t = std::clamp(c * s - rb, -b.half_length, b.half_length);
  s = std::clamp(ra + c * t, -a.half_length, a.half_length);
  return {s, t, false};
}

// Support function of the capsule, or of the cylinder with flat ends, along the unit vector n.
double reach(const Outline& body, const Vec3& n) {
  const double c = std::abs(dot(body.axis, n));
  if (body.ends != Outline::Ends::flat) return body.half_length * c + body.radius;
  return body.half_length * c + body.radius * std::sqrt(std::max(0.0, 1.0 - c * c));
}

// Is the point x, relative to the center, within `slack` of the body for certain?
bool holds(const Outline& body, const Vec3& x, double slack) {
  const double along = dot(body.axis, x);
  if (body.ends == Outline::Ends::flat) {
    const double radial = (body.radius + slack) * (1.0 - kMargin);
    return std::abs(along) <= body.half_length * (1.0 - kMargin) &&
           norm_sq(x - along * body.axis) <= radial * radial;
  }
  const double t = std::clamp(along, -body.half_length, body.half_length);
  const double radius = (body.radius + slack) * (1.0 - kMargin);
  return norm_sq(x - t * body.axis) <= radius * radius;
}

// The point nearest to x, relative to the center, of the cylinder of a body with flat or round
// ends.
Vec3 nearest_inside(const Outline& body, const Vec3& x) {
  const double along = dot(body.axis, x);
  const double half = body.half_length * (1.0 - 2 * kMargin);
  const double radius = body.radius * (1.0 - 2 * kMargin);
  const Vec3 across = x - along * body.axis;
  const double side_sq = norm_sq(across);
  const double part = side_sq > radius * radius ? radius / std::sqrt(side_sq) : 1.0;
  return std::clamp(along, -half, half) * body.axis + part * across;
}

double norm1(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// |e| times the part of the support function across the axis, along e / |e|.
double across_reach(const Outline& body, double along, double length_sq) {
  if (body.ends != Outline::Ends::flat) return body.radius * std::sqrt(length_sq);
  return body.radius * std::sqrt(std::max(0.0, length_sq - along * along));
}

// Verdict for a body `a` with a ball `b` at r: the distance of a point from a segment or a
// cylinder.
Verdict verdict_with_ball(const Outline& a, const Outline& b, const Vec3& r, double min_gap) {
  const double along = dot(a.axis, r);
  const double height = std::abs(along);
  const double past_end = std::max(0.0, height - a.half_length);
  const double side_sq = std::max(0.0, norm_sq(r) - along * along);
  double range = b.radius + min_gap;
  double distance_sq = 0.0;
  if (a.ends == Outline::Ends::flat) {
    const double past_side = std::max(0.0, std::sqrt(side_sq) - a.radius);
    distance_sq = past_end * past_end + past_side * past_side;
  } else {
    range += a.radius;
    distance_sq = past_end * past_end + side_sq;
  }
  // |r|^2 - along^2 loses digits where the center is near the axis, but then it is far below range.
  const double error = 8 * kMargin * (range * range + 1e-3 * norm_sq(r));
  if (distance_sq > range * range + error) return Verdict::separated;
  if (a.ends == Outline::Ends::loose || b.ends != Outline::Ends::round) return Verdict::undecided;
  return distance_sq < range * range - error ? Verdict::overlapping : Verdict::undecided;
}

}  // namespace

Outline outline_of(const Body& body) noexcept {
  Outline outline;
  outline.in_radius = in_radius(body) * (1.0 - kMargin);
  outline.circum_radius = circum_radius(body) * (1.0 + kMargin);
  const auto rod = [&](const auto& b, Outline::Ends ends) {
    outline.axis = b.axis;
    outline.half_length = b.half_length;
    outline.radius = b.radius;
    outline.ends = ends;
  };
  std::visit(Overloaded{[&](const Sphere& b) { outline.radius = b.radius; },
                        [&](const Ellipsoid& b) { set_ellipsoid(outline, b); },
                        [&](const Cylinder& b) { rod(b, Outline::Ends::flat); },
                        [&](const Spherocylinder& b) { rod(b, Outline::Ends::round); },
                        [&](const Disk& b) { outline.radius = b.radius; },
                        [&](const Ellipse& b) { set_ellipse(outline, b); }},
             body);
  return outline;
}

Verdict verdict_of_segments(const Outline& a, const Outline& b, const Vec3& r,
                            double min_gap) noexcept {
  if (b.half_length == 0.0) return verdict_with_ball(a, b, r, min_gap);
  if (a.half_length == 0.0) return verdict_with_ball(b, a, -r, min_gap);
  const ClosestPoints closest = closest_points(a, b, r);
  const Vec3 e = r + closest.t * b.axis - closest.s * a.axis;
  const double length_sq = norm_sq(e);
  const double range = a.radius + b.radius + min_gap;
  const double range_sq = range * range;
  const bool exact_ends = a.ends != Outline::Ends::loose && b.ends != Outline::Ends::loose;
  // On the common perpendicular capsules and bodies with flat ends agree. It is one within 1e-13,
  // as the segments are not nearly parallel; the verdict keeps 1e-10 away from contact.
  if (closest.common_perpendicular) {
    if (length_sq > range_sq * (1.0 + 1e-10)) return Verdict::separated;
    if (exact_ends && length_sq < range_sq * (1.0 - 1e-10)) return Verdict::overlapping;
  }
  if (length_sq <= range_sq * (1.0 - kMargin) && a.ends == Outline::Ends::round &&
      b.ends == Outline::Ends::round) {
    return Verdict::overlapping;
  }
  const double along_a = std::abs(dot(a.axis, e)), along_b = std::abs(dot(b.axis, e));
  // g(e / |e|) |e| for the capsules, equation (1) of contact.hpp, without taking a root.
  const double axial = dot(r, e) - a.half_length * along_a - b.half_length * along_b;
  if (axial > 0.0 && axial * axial > range_sq * length_sq * (1.0 + 2 * kMargin)) {
    return Verdict::separated;
  }
  if (a.ends != Outline::Ends::flat && b.ends != Outline::Ends::flat) return Verdict::undecided;
  const double across_a = across_reach(a, along_a, length_sq);
  const double across_b = across_reach(b, along_b, length_sq);
  const double length = std::sqrt(length_sq);
  if (axial - across_a - across_b > (min_gap + kMargin * (norm1(r) + range)) * length) {
    return Verdict::separated;
  }
  if (!exact_ends || length_sq > range_sq) return Verdict::undecided;
  const double slack = 0.5 * min_gap;
  const Vec3 point = closest.s * a.axis + ((a.radius + slack) / range) * e;
  if (holds(a, point, slack) && holds(b, point - r, slack)) return Verdict::overlapping;
  // Where flat ends meet something: the point of one body nearest to the foot in the other.
  const Vec3 foot_a = closest.s * a.axis, foot_b = r + closest.t * b.axis;
  const bool meet = holds(b, nearest_inside(a, foot_b) - r, min_gap) ||
                    holds(a, nearest_inside(b, foot_a - r) + r, min_gap);
  return meet ? Verdict::overlapping : Verdict::undecided;
}

Glance glance(const Outline& a, const Outline& b, const Vec3& r, double min_gap) noexcept {
  const double distance_sq = norm_sq(r);
  const double distance = std::sqrt(distance_sq);
  const double far = a.circum_radius + b.circum_radius;
  Glance seen;
  seen.normal = distance > 0.0 ? r / distance : Vec3{1, 0, 0};
  seen.gap_bound = distance - far;
  if (seen.gap_bound > min_gap) {
    seen.verdict = Verdict::separated;
    return seen;
  }
  if (distance <= a.in_radius + b.in_radius + min_gap) {
    seen.verdict = Verdict::overlapping;
    return seen;
  }
  if (a.half_length == 0.0 && b.half_length == 0.0) return seen;

  const ClosestPoints closest = closest_points(a, b, r);
  const Vec3 e = r + closest.t * b.axis - closest.s * a.axis;
  const double length = norm(e);
  if (length <= kMargin * far) {
    // The segments meet within rounding, and each body holds its own with room to spare.
    const bool inner = std::abs(closest.s) < a.half_length && std::abs(closest.t) < b.half_length;
    if (inner) seen.verdict = Verdict::overlapping;
    return seen;
  }
  const Vec3 n = e / length;
  const double bound = dot(r, n) - reach(a, n) - reach(b, n) - kMargin * far;
  if (bound > seen.gap_bound) {
    seen.gap_bound = bound;
    seen.normal = n;
  }
  if (bound > min_gap) {
    seen.verdict = Verdict::separated;
    return seen;
  }
  if (a.ends == Outline::Ends::loose || b.ends == Outline::Ends::loose) return seen;
  const double slack = 0.5 * min_gap;
  const double share = (a.radius + slack) / (a.radius + b.radius + min_gap);
  const Vec3 point = closest.s * a.axis + share * e;
  if (holds(a, point, slack) && holds(b, point - r, slack)) seen.verdict = Verdict::overlapping;
  return seen;
}

double nearest_on_segment(const Outline& a, const Outline& b, const Vec3& r) noexcept {
  return closest_points(a, b, r).s;
}

bool meets_ball(const Outline& body, const Vec3& x, double ball_radius, double min_gap) noexcept {
  if (body.ends == Outline::Ends::loose || ball_radius <= 0.0) return false;
  const double along = dot(body.axis, x);
  const double range = (ball_radius + min_gap) * (1.0 - kMargin);
  if (body.ends == Outline::Ends::round) return holds(body, x, range);
  const double past_end = std::max(0.0, std::abs(along) - body.half_length * (1.0 - kMargin));
  const double past_side =
      std::max(0.0, norm(x - along * body.axis) - body.radius * (1.0 - kMargin));
  return past_end * past_end + past_side * past_side <= range * range;
}

}  // namespace packstone::rsa
