#include "generate/relaxation/bodies.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/geometry/bounds.hpp"

namespace packstone::relaxation {
namespace {

// Half of the thinnest slab that holds the body.
double least_half_width(const PosedBody& body) {
  double least = std::min(body.axial, body.lateral);
  if (body.form == Form::scalene) least = std::min(least, body.second);
  if (body.form == Form::spherocylinder) least = body.lateral;
  return least;
}

// Points of the surface farther out than the inscribed ball are those that a turn moves.
double greatest_slope(const PosedBody& body, double reach) {
  return body.form == Form::ball ? 0.0 : reach;
}

RelaxationTurn turn_of(const RelaxationOptions& options, int group) {
  if (options.turn.empty()) return RelaxationTurn::hold_tensor;
  return options.turn[static_cast<std::size_t>(group)];
}

}  // namespace

Bodies bodies_of(const Packing& packing, const RelaxationOptions& options) {
  Bodies bodies;
  bodies.min_gap = options.min_gap;
  const bool plane = packing.cell.dimension == 2;
  for (const Inclusion& inclusion : packing.inclusions) {
    const PosedBody posed = posed_body(inclusion.body, inclusion.center);
    const double reach = circum_radius(inclusion.body);
    bodies.posed.push_back(posed);
    bodies.reach.push_back(reach);
    bodies.slope.push_back(greatest_slope(posed, reach));
    bodies.shell.push_back(options.inflation * least_half_width(posed));
    Turning turning;
    const Vec3 inertia = specific_inertia(inclusion.body);
    const bool turns = turn_of(options, inclusion.group) != RelaxationTurn::locked;
    if (turns && posed.form != Form::ball) {
      turning.slot = bodies.turning_count++;
      turning.arm = std::sqrt(std::max(inertia.y, inertia.z));
      if (plane) turning.about = {0, 0, 1};
    }
    bodies.turning.push_back(turning);
  }
  return bodies;
}

void turn(PosedBody& body, const Vec3& rotation) {
  const double angle = norm(rotation);
  if (angle == 0.0) return;
  const Vec3 about = rotation / angle;
  const double sine = std::sin(angle), half = std::sin(0.5 * angle);
  const auto turned = [&](const Vec3& v) {
    const Vec3 side = cross(about, v);
    return v + sine * side + (2.0 * half * half) * cross(about, side);
  };
  body.pose.axis = normalized(turned(body.pose.axis));
  if (body.form != Form::scalene) return;
  const Vec3 second = turned(body.pose.second);
  body.pose.second = normalized(second - dot(second, body.pose.axis) * body.pose.axis);
}

void move(Bodies& bodies, const std::vector<PosedBody>& from, const Motion& motion, double length) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    PosedBody& body = bodies.posed[i];
    body.pose = from[i].pose;
    body.pose.center += length * vec_at(motion, 3 * i);
    const Turning& turning = bodies.turning[i];
    if (turning.slot < 0) continue;
    turn(body, (length / turning.arm) * vec_at(motion, bodies.turn_at(i)));
  }
}

double relative_step(const Bodies& bodies, const Motion& motion) {
  // Half the width of the body, and the more the longer it is: the ends of needles have far to go.
  constexpr double kWidths = 1.0, kReaches = 0.1;
  double greatest = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    double step = norm(vec_at(motion, 3 * i));
    const Turning& turning = bodies.turning[i];
    if (turning.slot >= 0) {
      step += bodies.slope[i] / turning.arm * norm(vec_at(motion, bodies.turn_at(i)));
    }
    const double most = kWidths * least_half_width(bodies.posed[i]) + kReaches * bodies.reach[i];
    greatest = std::max(greatest, step / most);
  }
  return greatest;
}

Packing packing_of(const Bodies& bodies, Packing shapes) {
  shapes.certificate.reset();
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    Inclusion& inclusion = shapes.inclusions[i];
    const Pose& pose = bodies.posed[i].pose;
    const Pose before = posed_body(inclusion.body).pose;
    inclusion.center = wrapped(shapes.cell, pose.center);
    // What has not turned keeps its orientation to the last bit.
    if (pose.axis == before.axis && pose.second == before.second) continue;
    inclusion.body = turned_body(inclusion.body, pose);
  }
  return shapes;
}

}  // namespace packstone::relaxation
