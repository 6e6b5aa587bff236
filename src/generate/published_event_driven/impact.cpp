#include <algorithm>
#include <cmath>
#include <numbers>

#include "packstone/core/mat.hpp"
#include "packstone/generate/published_event_driven.hpp"

namespace packstone {
namespace {

/// One of the two bodies at the point of contact.
struct Side {
  double mass;      // Equation (27a), at density 1
  Vec3 arm;         // From the center to the point
  Vec3 turn;        // H^-1 (arm x n): spin per unit of impulse along n, equations (27b), (28)
  double mobility;  // Speed of the point along n per unit of impulse along n
};

Side side(const MovingEllipsoid& body, const Vec3& arm, const Vec3& n) {
  const Vec3 e = body.semi_axes;
  const double mass = 4.0 / 3.0 * std::numbers::pi * e.x * e.y * e.z;
  const Vec3 e_sq = scale(e, e);
  const Vec3 inertia = mass / 5.0 * Vec3{e_sq.y + e_sq.z, e_sq.x + e_sq.z, e_sq.x + e_sq.y};
  const Mat3 rotation = to_matrix(body.orientation);
  const Vec3 moment = cross(arm, n);
  const Vec3 turn = rotation * unscale(mul_transposed(rotation, moment), inertia);
  return {mass, arm, turn, 1.0 / mass + dot(moment, turn)};
}

Vec3 velocity_at(const MovingEllipsoid& body, const Vec3& arm) {
  return body.velocity + cross(body.angular_velocity, arm);
}

double growth_speed_along(const MovingEllipsoid& body, const Vec3& n, PublishedForm form) {
  const Vec3 rate = body.growth, e = body.semi_axes;
  if (form == PublishedForm::printed) return std::max({rate.x, rate.y, rate.z});
  const Vec3 m = mul_transposed(to_matrix(body.orientation), n);
  return dot(scale(e, rate), scale(m, m)) / norm(scale(e, m));  // d/dt of the support function
}

MovingEllipsoid pushed(MovingEllipsoid body, const Side& side, const Vec3& n, double impulse) {
  body.velocity += impulse / side.mass * n;
  body.angular_velocity += impulse * side.turn;
  return body;
}

}  // namespace

std::pair<MovingEllipsoid, MovingEllipsoid> published_impact(const MovingEllipsoid& a,
                                                             const MovingEllipsoid& b,
                                                             PublishedForm growth_speed) noexcept {
  const Vec3 r_ab = b.center - a.center;
  const PublishedTouch touch = published_touch(body_of(a), body_of(b), r_ab);
  const Vec3 n = touch.normal;
  const Side side_a = side(a, touch.point, n), side_b = side(b, touch.point - r_ab, n);
  const double closing = dot(velocity_at(a, side_a.arm) - velocity_at(b, side_b.arm), n);
  const double growth =
      growth_speed_along(a, n, growth_speed) + growth_speed_along(b, n, growth_speed);
  // Equation (32a) with e = 1: the closing speed goes from v to -v - 2 growth.
  const double impulse = 2.0 * (closing + growth) / (side_a.mobility + side_b.mobility);
  return {pushed(a, side_a, n, -impulse), pushed(b, side_b, n, impulse)};
}

}  // namespace packstone
