#include "generate/published_advancing_layer/multi_circle.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "packstone/geometry/inscribed_balls.hpp"

namespace packstone::published_layer {
namespace {

using std::numbers::pi;

constexpr double kPartOfGap = 0.5;    // What two circles may lack of the gap of contacts.
constexpr double kAngleSlack = 1e-9;  // Arcs that touch are taken to meet [rad].

Vec2 unit_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

// The angle at `a`, from the line to the center of `b`, at which both circles cross.
double angle_of_crossing(const Circle& a, const Circle& b) {
  const double distance = norm(b.offset - a.offset);
  const double lens = (a.radius - b.radius) * (a.radius + b.radius);
  const double cos = (distance * distance + lens) / (2.0 * distance * a.radius);
  return std::acos(std::clamp(cos, -1.0, 1.0));
}

double wrapped_angle(double angle) {
  if (angle > pi) return angle - 2.0 * pi;
  return angle <= -pi ? angle + 2.0 * pi : angle;
}

// What two arcs of normals share; half < 0: nothing.
OutlineArc shared(const OutlineArc& a, const OutlineArc& b) {
  if (a.half >= pi) return b;
  if (b.half >= pi) return a;
  const double turn = wrapped_angle(b.middle - a.middle);
  const double lo = std::max(-a.half, turn - b.half);
  const double hi = std::min(a.half, turn + b.half);
  return {0, a.middle + 0.5 * (lo + hi), 0.5 * (hi - lo)};
}

}  // namespace

MultiCircle::MultiCircle(const Body& body, double spacing) : semi_axis_(0.0) {
  for (const InscribedBall& ball : inscribed_balls(body, spacing)) {
    circles_.push_back({flatten(ball.center), ball.radius});
  }
  const Vec2 last = circles_.back().offset;
  semi_axis_ = norm(last) + circles_.back().radius;
  set_half();
  set_outline(std::atan2(last.y, last.x));
}

MultiCircle::MultiCircle(double radius)
    : circles_{{{}, radius}}, half_{radius, radius}, semi_axis_(radius) {
  set_outline(0.0);
}

void MultiCircle::set_half() {
  half_ = {};
  for (const Circle& circle : circles_) {
    half_.x = std::max(half_.x, circle.offset.x + circle.radius);
    half_.y = std::max(half_.y, circle.offset.y + circle.radius);
  }
}

// A circle shows between the crossings with its neighbors on both sides of the axis, one at the
// end of the axis about its tip.
void MultiCircle::set_outline(double axis) {
  const std::size_t last = circles_.size() - 1;
  if (last == 0) {
    outline_.push_back({0, 0.0, pi});
    return;
  }
  for (std::size_t i = 0; i <= last; ++i) {
    const double front = i < last ? angle_of_crossing(circles_[i], circles_[i + 1]) : 0.0;
    const double back = i > 0 ? angle_of_crossing(circles_[i], circles_[i - 1]) : 0.0;
    if (i == last) {
      outline_.push_back({i, wrapped_angle(axis), pi - back});
    } else if (i == 0) {
      outline_.push_back({i, wrapped_angle(axis + pi), pi - front});
    } else {
      const double middle = 0.5 * (front + pi - back);
      const double half = 0.5 * (pi - back - front);
      outline_.push_back({i, wrapped_angle(axis + middle), half});
      outline_.push_back({i, wrapped_angle(axis - middle), half});
    }
  }
}

// The circles of a body are the same seen from behind, so that those of the moving one, mirrored at
// its center, are its own: centers of contact are sums of offsets.
void contact_arcs(const MultiCircle& fixed, const MultiCircle& moving, double contact_gap,
                  std::vector<ContactArc>& arcs) {
  arcs.clear();
  for (const OutlineArc& a : fixed.outline()) {
    for (const OutlineArc& b : moving.outline()) {
      const OutlineArc both = shared(a, b);
      if (both.half < 0.0) continue;
      const Circle& p = fixed.circles()[a.circle];
      const Circle& q = moving.circles()[b.circle];
      const double half = std::min(pi, both.half + kAngleSlack);
      arcs.push_back({p.offset + q.offset, p.radius + q.radius + contact_gap, unit_at(both.middle),
                      std::cos(half)});
    }
  }
}

namespace {

// How far the circles overlap when the moving body is at p.
double depth_at(const MultiCircle& fixed, const MultiCircle& moving, const Vec2& p,
                const CirclePair& pair) {
  const Circle& a = fixed.circles()[pair.fixed];
  const Circle& b = moving.circles()[pair.moving];
  return a.radius + b.radius - norm(p + b.offset - a.offset);
}

struct PairStep {
  int fixed;
  int moving;
};

// The pair a step away; nothing beyond the ends of the rows.
std::optional<CirclePair> stepped(const MultiCircle& fixed, const MultiCircle& moving,
                                  const CirclePair& pair, const PairStep& step) {
  const CirclePair next{pair.fixed + static_cast<std::size_t>(step.fixed),
                        pair.moving + static_cast<std::size_t>(step.moving)};
  if (next.fixed >= fixed.circles().size() || next.moving >= moving.circles().size()) {
    return std::nullopt;
  }
  return next;
}

}  // namespace

CirclePair deepest_pair(const MultiCircle& fixed, const MultiCircle& moving, const Vec2& p,
                        CirclePair start) {
  constexpr PairStep steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  double depth = depth_at(fixed, moving, p, start);
  for (std::size_t k = 0, idle = 0; idle < std::size(steps);) {
    const auto next = stepped(fixed, moving, start, steps[k]);
    const double there = next ? depth_at(fixed, moving, p, *next) : depth;
    if (there > depth) {
      start = *next;
      depth = there;
      idle = 0;
    } else {
      k = (k + 1) % std::size(steps);
      ++idle;
    }
  }
  return start;
}

bool circles_overlap(const MultiCircle& a, const MultiCircle& b, const Vec2& r,
                     double contact_gap) {
  for (const Circle& q : b.circles()) {
    const Vec2 at = r + q.offset;
    for (const Circle& p : a.circles()) {
      const double least = p.radius + q.radius + kPartOfGap * contact_gap;
      if (norm_sq(at - p.offset) < least * least) return true;
    }
  }
  return false;
}

}  // namespace packstone::published_layer
