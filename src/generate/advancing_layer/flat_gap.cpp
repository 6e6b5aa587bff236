#include "generate/advancing_layer/flat_gap.hpp"

#include <algorithm>
#include <cmath>

namespace packstone::advancing_layer {
namespace {

// An ellipse along one direction.
struct Outline {
  double support;
  Vec2 point;        // Where the tangent across the direction touches.
  double curvature;  // Radius of curvature there.
};

Outline outline(const PosedBody& body, const Vec2& d) {
  const Vec2 axis = flatten(body.pose.axis);
  const double across_sq = body.lateral * body.lateral;
  const double extra = body.axial * body.axial - across_sq;
  const double along = dot(axis, d);
  const double support = std::sqrt(across_sq + extra * along * along);
  const double product = body.axial * body.lateral;
  const double per = 1.0 / support;
  return {support, per * (across_sq * d + (extra * along) * axis),
          product * product * per * per * per};
}

// g and its derivatives at one direction.
class Sample {
 public:
  Sample(const PosedBody& a, const PosedBody& b, const Vec2& r, const Vec2& unit) : d(unit) {
    const Outline of_a = outline(a, d), of_b = outline(b, d);
    g = dot(d, r) - of_a.support - of_b.support;
    slope = dot(Vec2{-d.y, d.x}, r - of_a.point - of_b.point);
    bend = g + of_a.curvature + of_b.curvature;
  }

  [[nodiscard]] double newton_step() const {
    constexpr double kMost = 0.8;
    const double step = bend > 0.0 ? slope / bend : std::copysign(kMost, slope);
    return std::clamp(step, -kMost, kMost);
  }

  Vec2 d;
  double g, slope, bend;
};

Vec2 turned(const Vec2& d, double step) {
  const Vec2 q{d.x - step * d.y, d.y + step * d.x};
  return q / norm(q);
}

// The matrix of the squared support function.
struct ShapeMatrix {
  double xx, xy, yy;

  explicit ShapeMatrix(const PosedBody& body) {
    const double across_sq = body.lateral * body.lateral;
    const double extra = body.axial * body.axial - across_sq;
    const Vec3& u = body.pose.axis;
    xx = across_sq + extra * u.x * u.x;
    xy = extra * u.x * u.y;
    yy = across_sq + extra * u.y * u.y;
  }
};

}  // namespace

Vec3 first_direction(const PosedBody& a, const PosedBody& b, const Vec3& r) {
  const ShapeMatrix of_a(a), of_b(b);
  const double xx = of_a.xx + of_b.xx, xy = of_a.xy + of_b.xy, yy = of_a.yy + of_b.yy;
  const Vec2 n{yy * r.x - xy * r.y, xx * r.y - xy * r.x};
  const double length = norm(n);
  return length > 0.0 ? lift(n / length) : Vec3{0, 1, 0};
}

double flat_gap(const PosedBody& a, const PosedBody& b, const Vec3& r, double limit, int most_steps,
                Vec3& d) {
  constexpr double kConverged = 1e-9;
  constexpr int kMostCuts = 12;
  const Vec2 flat = flatten(r);
  Sample best(a, b, flat, flatten(d));
  for (int k = 0; k < most_steps && best.g <= limit; ++k) {
    double step = best.newton_step();
    if (std::abs(step) < kConverged) break;
    bool better = false;
    for (int cut = 0; cut < kMostCuts && !better; ++cut, step *= 0.4) {
      const Sample next(a, b, flat, turned(best.d, step));
      better = next.g > best.g;
      if (better) best = next;
    }
    if (!better) break;
  }
  d = lift(best.d);
  return best.g;
}

}  // namespace packstone::advancing_layer
