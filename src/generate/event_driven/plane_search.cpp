#include "generate/event_driven/plane_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/axis_segments.hpp"
#include "geometry/gap_ascent.hpp"
#include "packstone/core/mat.hpp"

namespace packstone::event_driven {

namespace {

// The matrix whose quadratic form is the square of the support function.
SymMat3 shape_matrix(const PosedBody& body) {
  const double lateral_sq = body.lateral * body.lateral;
  SymMat3 m = (body.axial * body.axial - lateral_sq) * dyad(body.pose.axis);
  if (body.form == Form::scalene) {
    m = m + (body.second * body.second - lateral_sq) * dyad(body.pose.second);
  }
  m.xx += lateral_sq;
  m.yy += lateral_sq;
  m.zz += lateral_sq;
  return m;
}

struct Adjugate {
  SymMat3 matrix;
  double determinant;
};

Adjugate adjugate(const SymMat3& m) {
  const SymMat3 c{m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
                  m.xy * m.xz - m.xx * m.yz, m.xy * m.yz - m.xz * m.yy, m.xz * m.yz - m.xy * m.zz};
  return {c, m.xx * c.xx + m.xy * c.xy + m.xz * c.xz};
}

// Perram and Wertheim's function of l, see equation (1) of ellipsoid_contact.hpp; Newton's steps on
// (1-l)^2 p = l^2 q.
class Pencil {
 public:
  Pencil(const PosedBody& a, const PosedBody& b, const Vec3& r)
      : a_(shape_matrix(a)), b_(shape_matrix(b)), r_(r) {}

  // One step from l: the normal there, moved on to where the step ends. Returns the step.
  double step(double& l, Vec3& normal) const {
    const Adjugate y = adjugate((1.0 - l) * a_ + l * b_);
    const double per_det = 1.0 / y.determinant;
    const Vec3 n = per_det * (y.matrix * r_);
    const Vec3 an = a_ * n, bn = b_ * n;
    const double p = dot(n, an), q = dot(n, bn);
    const Vec3 slope = per_det * (y.matrix * (an - bn));
    const Vec3 w = (1.0 - l) * (1.0 - l) * an - l * l * bn;
    const double first = (1.0 - l) * (1.0 - l) * p - l * l * q;
    const double second = -2.0 * (1.0 - l) * p - 2.0 * l * q + 2.0 * dot(w, slope);
    const double next = std::clamp(l - first / second, 0.1 * l, 1.0 - 0.1 * (1.0 - l));
    const double moved = next - l;
    normal = n + moved * slope;
    l = next;
    return moved;
  }

 private:
  SymMat3 a_, b_;
  Vec3 r_;
};

Vec3 ellipsoid_normal(const PosedBody& a, const PosedBody& b, const Vec3& r, const Vec3& known,
                      Effort effort) {
  constexpr int kMostSteps = 40;
  constexpr double kConverged = 1e-9;
  // Where the levels of both bodies are equal for the known normal they nearly are for the next.
  const Vec3 guess = known == Vec3{} ? r : known;
  const double h_a = support(a, guess), h_b = support(b, guess);
  double l = h_a / (h_a + h_b);
  const Pencil pencil(a, b, r);
  Vec3 normal;
  const int most = effort == Effort::step ? 1 : kMostSteps;
  for (int k = 0; k < most; ++k) {
    const double moved = pencil.step(l, normal);
    if (std::abs(moved) <= kConverged * std::min(l, 1.0 - l)) break;
  }
  return normal;
}

// A segment such that the body lies within some radius of it, as near as bodies with one long axis
// allow.
Segment core_segment(const PosedBody& body) {
  const double across = std::max(body.second, body.lateral);
  const double half = is_ellipsoid(body.form) ? body.axial - across : body.axial;
  return {std::max(0.0, half), body.pose.axis};
}

// Where a search for the largest gap begins when nothing is known.
Vec3 first_normal(const PosedBody& a, const PosedBody& b, const Vec3& r) {
  const Vec3 between = nearest_points(core_segment(a), core_segment(b), r).between;
  return normalized(norm_sq(between) > 0.0 ? between : r);
}

}  // namespace

PosedBody posed(const Bodies& bodies, std::int32_t i, const Pose& pose, double factor) {
  const auto k = static_cast<std::size_t>(i);
  const Spin& spin = bodies.spin[k];
  const double second = bodies.second_semi_axis(k);
  return {bodies.form[k], pose, factor * spin.axial, factor * second, factor * spin.lateral};
}

Vec3 find_plane(const PosedBody& a, const PosedBody& b, const Vec3& r, double min_gap,
                const Vec3& known, Effort effort) {
  if (a.form == Form::ball && b.form == Form::ball) return normalized(r);
  if (is_ellipsoid(a.form) && is_ellipsoid(b.form) && min_gap == 0.0) {
    return ellipsoid_normal(a, b, r, known, effort);
  }
  // Any plane will do for the next stretch of time; at a contact its error is a gap.
  const double accuracy = effort == Effort::step ? 1e-3 : 1e-9;
  const Vec3 start = known == Vec3{} ? first_normal(a, b, r) : normalized(known);
  return ascend_gap(a, b, r, start, accuracy);
}

namespace {

// Conditions c.m = value on the turn m of a normal; at most two that say different things.
class TurnConditions {
 public:
  explicit TurnConditions(const Vec3& normal) : unit_(normalized(normal)) {}

  void add(const Vec3& direction, double value) {
    const Vec3 c = direction - dot(direction, unit_) * unit_;
    const double length = norm(c);
    if (count_ == 2 || length < 1e-3) return;
    const Vec3 unit = c / length;
    if (count_ == 1 && norm(cross(unit, direction_[0])) < 1e-3) return;
    direction_[static_cast<std::size_t>(count_)] = unit;
    value_[static_cast<std::size_t>(count_)] = value / length;
    ++count_;
  }

  // The shortest m that meets them.
  [[nodiscard]] Vec3 solution() const {
    if (count_ == 0) return {};
    if (count_ == 1) return value_[0] * direction_[0];
    const double c = dot(direction_[0], direction_[1]);
    const double det = 1.0 - c * c;
    return ((value_[0] - c * value_[1]) / det) * direction_[0] +
           ((value_[1] - c * value_[0]) / det) * direction_[1];
  }

 private:
  Vec3 unit_;
  std::array<Vec3, 2> direction_;
  std::array<double, 2> value_{};
  int count_ = 0;
};

// What the flat side or the straight line of a rod that the plane rests on asks for: the normal,
// seen from the body, must not leave it.
void add_conditions(const PosedBody& body, const Vec3& angular, const Vec3& normal, double length,
                    TurnConditions& conditions) {
  constexpr double kOnSide = 1e-5;
  if (is_ellipsoid(body.form)) return;
  const double along = dot(normal, body.pose.axis);
  const Vec3 turn = cross(normal, angular);
  if (std::abs(along) < kOnSide * length) {
    conditions.add(body.pose.axis, -dot(body.pose.axis, turn));
    return;
  }
  const Vec3 flat = normal - along * body.pose.axis;
  if (body.form != Form::cylinder || norm(flat) > kOnSide * length) return;
  const Vec3 first = any_perpendicular(body.pose.axis);
  const Vec3 second = cross(body.pose.axis, first);
  conditions.add(first, -dot(first, turn));
  conditions.add(second, -dot(second, turn));
}

}  // namespace

Vec3 normal_rate(const PosedBody& a, const PosedBody& b, const Vec3& angular_a,
                 const Vec3& angular_b, const Vec3& normal) {
  if (is_ellipsoid(a.form) && is_ellipsoid(b.form)) return {};
  const double length = norm(normal);
  TurnConditions conditions(normal);
  add_conditions(a, angular_a, normal, length, conditions);
  add_conditions(b, angular_b, normal, length, conditions);
  return conditions.solution();
}

double gap_bound(const PosedBody& a, const PosedBody& b, const Vec3& r) {
  const auto along = [&](const Vec3& n) {
    return (dot(n, r) - support(a, n) - support(b, n)) / norm(n);
  };
  double bound = along(r);
  if (a.form == Form::ball && b.form == Form::ball) return bound;
  if (is_ellipsoid(a.form) && is_ellipsoid(b.form)) {
    const Vec3 first = ellipsoid_normal(a, b, r, {}, Effort::step);
    const Vec3 second = ellipsoid_normal(a, b, r, first, Effort::step);
    return std::max({bound, along(first), along(second)});
  }
  const Vec3 between = nearest_points(core_segment(a), core_segment(b), r).between;
  if (norm_sq(between) > 0.0) bound = std::max(bound, along(between));
  const auto on_either_side = [&](const Vec3& u) { return along(dot(u, r) < 0.0 ? -u : u); };
  return std::max({bound, on_either_side(a.pose.axis), on_either_side(b.pose.axis)});
}

}  // namespace packstone::event_driven
