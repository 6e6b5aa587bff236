#pragma once

/// @file
/// Bodies in motion, and a slow judge of when they touch: poses by quaternions and gap() of
/// contact.hpp, none of which the engine uses between ellipsoids.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/contact_search.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "support/pair_zoo.hpp"

namespace packstone::movers {

using event_driven::Bodies;
using event_driven::Partner;

/// One body since time 0, at size factor 1.
struct Mover {
  Body body;
  Vec3 center, velocity;
  Vec3 angular;  ///< Across the axis of bodies of revolution.
  bool turns = true;
};

/// Some of them, and what they have in common.
struct Scene {
  std::vector<Mover> movers;
  double size = 1.0;
  double growth = 0.0;
  double min_gap = 0.0;
  Cell cell{};
};

/// How many of its semi-axes are different; of rods as if they were spheroids.
inline int unlike_semi_axes(const Body& body) {
  if (is_round(kind(body))) return 1;
  const auto* ellipsoid = std::get_if<Ellipsoid>(&body);
  if (ellipsoid == nullptr) return 2;
  const Vec3& s = ellipsoid->semi_axes;
  const int equal = (s.x == s.y) + (s.y == s.z) + (s.x == s.z);
  return equal == 3 ? 1 : 3 - equal;
}

/// The part of `angular` that shows: none of balls, and none about an axis of revolution.
inline Vec3 visible_turn(const Body& body, const Vec3& angular) {
  const int unlike = unlike_semi_axes(body);
  if (unlike == 1) return {};
  if (dimension(kind(body)) == 2) return {0, 0, angular.z};
  if (unlike == 3) return angular;
  const Vec3 axis = *symmetry_axis(body);
  return angular - dot(angular, axis) * axis;
}

inline Bodies bodies_of(const Scene& scene) {
  Bodies bodies;
  bodies.size = scene.size;
  bodies.growth = scene.growth;
  bodies.min_gap = scene.min_gap;
  for (const Mover& m : scene.movers) {
    add_body(bodies, m.body, m.center, m.turns);
    const std::size_t k = bodies.flight.size() - 1;
    bodies.flight[k].velocity = m.velocity;
    if (m.turns) bodies.set_angular(k, m.angular);
  }
  return bodies;
}

inline Vec3 center_at(const Mover& m, double t) { return m.center + t * m.velocity; }

inline Body body_at(const Scene& scene, std::size_t k, double t) {
  const Mover& m = scene.movers[k];
  const double speed = norm(m.angular);
  Body body = scaled(m.body, scene.size + scene.growth * t);
  if (speed > 0.0) body = rotated(body, from_axis_angle(m.angular / speed, speed * t));
  return body;
}

/// What is left above the least gap [L], and how well that is known.
struct Clearance {
  double value = 0.0;
  double error = 0.0;
};

inline Clearance clearance_to_wall(const Scene& scene, std::size_t k, std::int32_t body, double t) {
  const int number = -1 - body;
  const auto axis = static_cast<std::size_t>(number / 2);
  const double side = number % 2 == 1 ? 1.0 : -1.0;
  Vec3 out;
  out[axis] = side;
  const double at = center_at(scene.movers[k], t)[axis];
  const double from = side > 0.0 ? scene.cell.size[axis] - at : at;
  return {from - support(body_at(scene, k, t), out), 1e-15 * scene.cell.size[axis]};
}

inline Clearance clearance(const Scene& scene, std::size_t k, const Partner& partner, double t) {
  if (event_driven::is_wall(partner.body)) return clearance_to_wall(scene, k, partner.body, t);
  const auto j = static_cast<std::size_t>(partner.body);
  const Vec3 r = center_at(scene.movers[j], t) + partner.shift - center_at(scene.movers[k], t);
  const Gap g = gap(body_at(scene, k, t), body_at(scene, j, t), r);
  // Poses are rounded on top of what gap() knows of its own error.
  const double reach =
      std::max(circum_radius(scene.movers[k].body), circum_radius(scene.movers[j].body));
  return {g.value - scene.min_gap, g.error + 1e-14 * (reach + norm(r))};
}

/// The clearance changes by no more than this in a unit of time, up to `horizon`.
inline double greatest_rate(const Scene& scene, std::size_t k, const Partner& partner,
                            double horizon) {
  const double size = scene.size + std::max(0.0, scene.growth * horizon);
  const auto of = [&](const Mover& m) {
    const double reach = circum_radius(m.body);
    return reach * (size * norm(m.angular) + std::abs(scene.growth));
  };
  const Mover& a = scene.movers[k];
  if (event_driven::is_wall(partner.body)) return norm(a.velocity) + of(a);
  const Mover& b = scene.movers[static_cast<std::size_t>(partner.body)];
  return norm(a.velocity - b.velocity) + of(a) + of(b);
}

/// What going through time shows, in steps that no contact can hide in: each lasts as long as the
/// clearance, at its greatest rate, takes to close. Where less than `near` is left [L], as long as
/// `near` takes.
struct Watch {
  double least = std::numeric_limits<double>::infinity();  ///< Clearance plus its error.
  double least_at = 0.0;
};
inline Watch watch(const Scene& scene, std::size_t k, const Partner& partner, double from,
                   double until, double near) {
  Watch seen;
  const double rate = greatest_rate(scene, k, partner, until);
  for (double t = from;;) {
    const Clearance c = clearance(scene, k, partner, t);
    if (c.value + c.error < seen.least) {
      seen.least = c.value + c.error;
      seen.least_at = t;
    }
    if (t >= until || !(rate > 0.0)) return seen;
    t = std::min(until, t + std::max(c.value, near) / rate);
  }
}

/// How a random pair moves.
struct Motion {
  double spin = 1.0;    ///< Most that a body turns in a unit of time [1/T].
  double growth = 0.0;  ///< [1/T]
  double min_gap = 0.0;
};

/// `pair` flies together at a speed of about its size, more or less.
inline Scene approaching(const zoo::Pair& pair, const Motion& motion, zoo::Zoo& zoo) {
  const int dim = dimension(kind(pair.a));
  const double reach = zoo::size_of(pair);
  Scene scene;
  scene.growth = motion.growth;
  scene.min_gap = motion.min_gap;
  const Vec3 toward = norm_sq(pair.r) > 0.0 ? normalized(pair.r) : Vec3{1, 0, 0};
  const double speed = reach * zoo.log_uniform(0.03, 1.0);
  const auto spin = [&](const Body& body) {
    const Vec3 w = zoo.uniform(0.0, motion.spin) * zoo.direction(3);
    return visible_turn(body, w);
  };
  const Vec3 common = reach * zoo.uniform(0.0, 1.0) * zoo.direction(dim);
  scene.movers.push_back({pair.a, reach * zoo.direction(dim), common, spin(pair.a)});
  scene.movers.push_back({pair.b, scene.movers[0].center + pair.r,
                          common - speed * (toward + 0.7 * zoo.direction(dim)), spin(pair.b)});
  scene.cell.dimension = dim;
  scene.cell.size = {20 * reach, 20 * reach, dim == 3 ? 20 * reach : 0.0};
  if (dim == 2) scene.cell.periodic[2] = false;
  return scene;
}

/// Up to then no body turns by more than the engine lets it between two looks.
inline double longest_look(const Scene& scene) {
  double fastest = 1.0;
  for (const Mover& m : scene.movers) fastest = std::max(fastest, norm(m.angular));
  return event_driven::kMostTurn / fastest;
}

/// Ellipsoids of revolution (aspect, 1, 1) / max(aspect, 1).
inline Body spheroid(double aspect, const Quaternion& orientation) {
  const double longest = std::max(aspect, 1.0);
  return Ellipsoid{{aspect / longest, 1.0 / longest, 1.0 / longest}, orientation};
}

}  // namespace packstone::movers
