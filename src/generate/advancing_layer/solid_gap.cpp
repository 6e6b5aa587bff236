#include "generate/advancing_layer/solid_gap.hpp"

#include <algorithm>
#include <cmath>

namespace packstone::advancing_layer {
namespace {

// The solution of m x = v, m positive definite; 0 where rounding leaves nothing of m.
Vec3 solved(const SymMat3& m, const Vec3& v) {
  const SymMat3 adjugate{m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz,
                         m.xx * m.yy - m.xy * m.xy, m.xy * m.xz - m.xx * m.yz,
                         m.xy * m.yz - m.xz * m.yy, m.xz * m.yz - m.xy * m.zz};
  const double det = m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz;
  return det > 0.0 ? (1.0 / det) * (adjugate * v) : Vec3{};
}

// The point where a plane across d touches, and the support function there.
struct Touch {
  double support;
  Vec3 point;

  Touch(const SolidEllipsoid& body, const Vec3& d) {
    const Vec3 along = mul_transposed(body.semi, d);
    support = norm(along);
    point = (1.0 / support) * (body.semi * along);
  }
};

// g at one direction.
class Sample {
 public:
  Sample(const SolidEllipsoid& a, const SolidEllipsoid& b, const Vec3& r, const Vec3& unit)
      : d(unit), a_(a, d), b_(b, d) {
    g = dot(d, r) - a_.support - b_.support;
  }

  // Equations (1) and (2). Where bodies overlap H may be indefinite; without g it never is.
  [[nodiscard]] Vec3 newton_step(const SolidEllipsoid& a, const SolidEllipsoid& b,
                                 const Vec3& r) const {
    constexpr double kMost = 0.8;
    const double per_a = 1.0 / a_.support, per_b = 1.0 / b_.support;
    const Vec3 away = r - a_.point - b_.point;
    const double round = std::max(g, 0.0);
    const double along = a_.support + b_.support;
    SymMat3 h =
        per_a * (a.shape - dyad(a_.point)) + per_b * (b.shape - dyad(b_.point)) + along * dyad(d);
    h.xx += round;
    h.yy += round;
    h.zz += round;
    const Vec3 step = solved(h, away - dot(away, d) * d);
    const double length_sq = norm_sq(step);
    return length_sq > kMost * kMost ? (kMost / std::sqrt(length_sq)) * step : step;
  }

  Vec3 d;
  double g;

 private:
  Touch a_, b_;
};

}  // namespace

SolidEllipsoid::SolidEllipsoid(const PosedBody& body) {
  const bool is_ball = body.form == Form::ball;
  const Vec3 axis = is_ball ? Vec3{0, 0, 1} : body.pose.axis;
  const Vec3 second = body.form == Form::scalene ? body.pose.second : any_perpendicular(axis);
  const double second_semi = body.form == Form::scalene ? body.second : body.lateral;
  semi = {body.axial * axis, second_semi * second, body.lateral * cross(axis, second)};
  shape = dyad(semi.col_x) + dyad(semi.col_y) + dyad(semi.col_z);
}

Vec3 first_direction(const SolidEllipsoid& a, const SolidEllipsoid& b, const Vec3& r) {
  const Vec3 n = solved(a.shape + b.shape, r);
  const double length = norm(n);
  return length > 0.0 ? n / length : Vec3{0, 0, 1};
}

double solid_gap(const SolidEllipsoid& a, const SolidEllipsoid& b, const Vec3& r, double limit,
                 int most_steps, Vec3& d) {
  constexpr double kConverged = 1e-9;
  constexpr int kMostCuts = 12;
  Sample best(a, b, r, d);
  for (int k = 0; k < most_steps && best.g <= limit; ++k) {
    Vec3 step = best.newton_step(a, b, r);
    if (!(norm_sq(step) > kConverged * kConverged)) break;
    bool better = false;
    for (int cut = 0; cut < kMostCuts && !better; ++cut, step *= 0.4) {
      const Sample next(a, b, r, normalized(best.d + step));
      better = next.g > best.g;
      if (better) best = next;
    }
    if (!better) break;
  }
  d = best.d;
  return best.g;
}

}  // namespace packstone::advancing_layer
