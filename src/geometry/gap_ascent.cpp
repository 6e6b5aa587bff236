#include "geometry/gap_ascent.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/support_jet.hpp"
#include "geometry/touching_points.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {
namespace {

double gap_along(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& unit) {
  return dot(unit, r) - support(a, unit) - support(b, unit);
}

class Ascent {
 public:
  Ascent(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& start)
      : body_{&a, &b}, r_(r), d_(start) {
    // Close to the middle of a rod it most likely ends there; if not, the rod is let go.
    constexpr double kClose = 0.05;
    for (std::size_t k = 0; k < 2; ++k) {
      const double x = dot(axis(k), d_);
      end_[k] = x < 0.0 ? -1.0 : 1.0;
      if (is_rod(k) && std::abs(x) < kClose) rest_on(k);
    }
  }

  // Whether it has come to the maximum.
  bool run(double accuracy) {
    constexpr int kMostSteps = 20;
    for (int step = 0; step < kMostSteps; ++step) {
      if (rests_on_flat_end()) return true;
      const double moved = on_side_[0] && on_side_[1] ? to_both_sides()
                           : on_side_[0]              ? step_on_circle(0)
                           : on_side_[1]              ? step_on_circle(1)
                                                      : step_freely();
      if (moved > accuracy) continue;
      if (!let_go()) return true;
    }
    return false;
  }

  [[nodiscard]] const Vec3& direction() const { return d_; }

 private:
  [[nodiscard]] const Vec3& axis(std::size_t k) const { return body_[k]->pose.axis; }
  [[nodiscard]] bool is_rod(std::size_t k) const { return !is_ellipsoid(body_[k]->form); }

  void rest_on(std::size_t k) {
    on_side_[k] = true;
    const Vec3 across = d_ - dot(axis(k), d_) * axis(k);
    const double length = norm(across);
    if (length > 0.0) d_ = across / length;
  }

  [[nodiscard]] SupportJet jet(std::size_t k, const Tangents& at) const {
    return support_jet(*body_[k], at, on_side_[k] ? 0.0 : end_[k]);
  }

  // Goes to `next` unless the middle of a rod lies before it: then there. Returns how far.
  double go_to(const Vec3& next, std::size_t first, std::size_t last) {
    double part = 1.0;
    std::size_t crossed = 2;
    for (std::size_t k = first; k <= last; ++k) {
      if (on_side_[k] || !is_rod(k)) continue;
      const double x = dot(axis(k), d_), x_next = dot(axis(k), next);
      if (end_[k] * x_next >= 0.0) continue;
      const double at = std::max(0.0, x / (x - x_next));
      if (at >= part) continue;
      part = at;
      crossed = k;
    }
    const Vec3 before = d_;
    d_ = normalized(d_ + part * (next - d_));
    if (crossed == 2) return norm(d_ - before);
    if (on_side_[1 - crossed]) {
      on_side_[crossed] = true;
    } else {
      rest_on(crossed);
    }
    return 1.0;
  }

  double step_freely() {
    constexpr double kLongest = 0.4;
    const Tangents at(d_);
    const SupportJet a = jet(0, at), b = jet(1, at);
    const double g_1 = dot(r_, at.t_1) - a.slope_1 - b.slope_1;
    const double g_2 = dot(r_, at.t_2) - a.slope_2 - b.slope_2;
    const double gap = dot(r_, d_) - a.value - b.value;
    // Minus the second derivative along great circles, positive where the bodies are apart.
    const double least = 1e-9 * (a.value + b.value);
    const double h_11 = a.bend_11 + b.bend_11 + gap + least, h_12 = a.bend_12 + b.bend_12,
                 h_22 = a.bend_22 + b.bend_22 + gap + least;
    const double det = h_11 * h_22 - h_12 * h_12;
    double s_1 = g_1 / norm(r_), s_2 = g_2 / norm(r_);
    if (det > 0.0 && h_11 > 0.0) {
      s_1 = (h_22 * g_1 - h_12 * g_2) / det;
      s_2 = (h_11 * g_2 - h_12 * g_1) / det;
    }
    const double length = std::sqrt(s_1 * s_1 + s_2 * s_2);
    const double scale = length > kLongest ? kLongest / length : 1.0;
    return go_uphill(normalized(d_ + (scale * s_1) * at.t_1 + (scale * s_2) * at.t_2), 0, 1);
  }

  // Newton on the great circle across the axis of body k.
  double step_on_circle(std::size_t k) {
    constexpr double kLongest = 0.4;
    const Vec3 t = cross(axis(k), d_);
    Tangents at(d_);
    at.t_1 = t;
    at.t_2 = axis(k);
    const SupportJet own = jet(k, at), other = jet(1 - k, at);
    const double slope = dot(r_, t) - own.slope_1 - other.slope_1;
    const double gap = dot(r_, d_) - own.value - other.value;
    const double bend = own.bend_11 + other.bend_11 + gap;
    const double wanted = bend > 0.0 ? slope / bend : std::copysign(kLongest, slope);
    const double step = std::clamp(wanted, -kLongest, kLongest);
    return go_uphill(normalized(d_ + step * t), 1 - k, 1 - k);
  }

  // Steps that lead downhill are too long.
  double go_uphill(Vec3 next, std::size_t first, std::size_t last) {
    constexpr int kMostHalvings = 5;
    const double here = gap_along(*body_[0], *body_[1], r_, d_);
    const double slack = 1e-15 * norm(r_);
    for (int halving = 0; halving < kMostHalvings; ++halving) {
      if (gap_along(*body_[0], *body_[1], r_, next) >= here - slack) break;
      if (crosses_a_middle(next, first, last)) break;
      next = normalized(d_ + next);
    }
    return go_to(next, first, last);
  }

  [[nodiscard]] bool crosses_a_middle(const Vec3& next, std::size_t first, std::size_t last) const {
    for (std::size_t k = first; k <= last; ++k) {
      if (is_rod(k) && !on_side_[k] && end_[k] * dot(axis(k), next) < 0.0) return true;
    }
    return false;
  }

  double to_both_sides() {
    const Vec3 across = cross(axis(0), axis(1));
    const double length = norm(across);
    constexpr double kParallel = 1e-9;
    // Parallel rods: the plane turns about their axis as one of them would have it.
    if (length < kParallel) {
      on_side_[1] = false;
      const double moved = step_on_circle(0);
      on_side_[1] = true;
      return moved;
    }
    d_ = (dot(across, d_) < 0.0 ? -1.0 / length : 1.0 / length) * across;
    if (gap_along(*body_[0], *body_[1], r_, -d_) > gap_along(*body_[0], *body_[1], r_, d_)) {
      d_ = -d_;
    }
    return 0.0;
  }

  // Where body k comes nearest along `toward`, rods with the end that they are known to turn there.
  [[nodiscard]] Vec3 nearest_point(std::size_t k, const Vec3& toward) const {
    if (!is_rod(k)) return support_point(*body_[k], toward);
    const PosedBody& rod = *body_[k];
    const double sign = k == 0 ? 1.0 : -1.0;
    const Vec3 end = (sign * end_[k] * rod.axial) * rod.pose.axis;
    if (rod.form == Form::spherocylinder) return end + rod.lateral * toward;
    const Vec3 flat = toward - dot(toward, rod.pose.axis) * rod.pose.axis;
    const double length = norm(flat);
    return length > 0.0 ? end + (rod.lateral / length) * flat : end;
  }

  // Where along its axis, from its center, the side of rod k is touched [L].
  [[nodiscard]] double touched_at(std::size_t k) const {
    const std::size_t other = 1 - k;
    const double sign = k == 0 ? 1.0 : -1.0;
    if (!on_side_[other]) {
      return dot(axis(k), sign * r_ + nearest_point(other, -sign * d_));
    }
    constexpr double kParallel = 1e-18;
    const double c = dot(axis(0), axis(1)), sine_sq = norm_sq(cross(axis(0), axis(1)));
    const double along = sign * dot(r_, axis(k)), along_other = sign * dot(r_, axis(other));
    if (sine_sq > kParallel) return (along - c * along_other) / sine_sq;
    // Parallel sides touch along a line, if they lie side by side at all.
    const double beyond = std::abs(along) - body_[other]->axial;
    return beyond > 0.0 ? std::copysign(beyond, along) : 0.0;
  }

  // A rod whose side is not rightly touched goes out of the set: its end is. False: none does.
  bool let_go() {
    std::size_t worst = 2;
    double beyond = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!on_side_[k]) continue;
      const double at = touched_at(k), h = body_[k]->axial;
      const double over = (std::abs(at) - h) / h;
      if (over <= 1e-12 || over <= beyond) continue;
      beyond = over;
      worst = k;
      // Seen from the partner of b the directions are the other way round.
      end_[k] = (at < 0.0) == (k == 0) ? -1.0 : 1.0;
    }
    if (worst == 2) return false;
    on_side_[worst] = false;
    return true;
  }

  // Is a flat end against the other body? It is where the other body's contact point lies over it:
  // then no direction next to its normal has a larger gap, and Newton's steps would find no end.
  bool rests_on_flat_end() {
    constexpr double kNear = 0.25;
    for (std::size_t k = 0; k < 2; ++k) {
      if (body_[k]->form != Form::cylinder || on_side_[k]) continue;
      const Vec3 end = end_[k] * axis(k);
      if (norm_sq(d_ - end) > kNear) continue;
      const double sign = k == 0 ? 1.0 : -1.0;
      const Vec3 to = sign * r_ + support_point(*body_[1 - k], -sign * end);
      if (norm(to - dot(to, axis(k)) * axis(k)) > body_[k]->lateral) continue;
      if (gap_along(*body_[0], *body_[1], r_, end) < gap_along(*body_[0], *body_[1], r_, d_)) {
        continue;
      }
      d_ = end;
      return true;
    }
    return false;
  }

  std::array<const PosedBody*, 2> body_;
  Vec3 r_;
  Vec3 d_;
  std::array<bool, 2> on_side_{false, false};
  std::array<double, 2> end_{1.0, 1.0};  // Of the axis, on which side of the middle d is.
};

Body general_body(const PosedBody& p) {
  switch (p.form) {
    case Form::ball:
      return Sphere{p.lateral};
    case Form::spheroid:
      return Ellipsoid{{p.lateral, p.lateral, p.axial}, from_z_to(p.pose.axis)};
    case Form::cylinder:
      return Cylinder{p.lateral, p.axial, p.pose.axis};
    case Form::spherocylinder:
      return Spherocylinder{p.lateral, p.axial, p.pose.axis};
    case Form::scalene:
      break;
  }
  const Mat3 frame{p.pose.axis, p.pose.second, cross(p.pose.axis, p.pose.second)};
  return Ellipsoid{{p.axial, p.second, p.lateral}, from_matrix(frame)};
}

}  // namespace

Vec3 ascend_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& start,
                double accuracy) {
  // Below 0 the gap can have other maxima along the sphere than the largest.
  const double least = -1e-9 * norm(r);
  Ascent ascent(a, b, r, start);
  if (ascent.run(accuracy) && gap_along(a, b, r, ascent.direction()) > least) {
    return ascent.direction();
  }
  return gap(general_body(a), general_body(b), r).normal;
}

bool climb_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, Vec3& direction,
               double accuracy) {
  Ascent ascent(a, b, r, direction);
  const bool ended = ascent.run(accuracy);
  if (gap_along(a, b, r, ascent.direction()) > gap_along(a, b, r, direction)) {
    direction = ascent.direction();
  }
  return ended;
}

}  // namespace packstone
