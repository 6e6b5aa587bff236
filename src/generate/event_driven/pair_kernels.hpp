#pragma once

/// @file
/// What pair_lanes.hpp does, in lanes. Included by the sources alone that are compiled for one
/// width of registers each: it calls no inline function that others share, lest the linker hand
/// theirs out the instructions of a wider processor.

#include <cstddef>
#include <cstdint>

#include "generate/event_driven/contact_gap.hpp"
#include "generate/event_driven/lane_kernels.hpp"
#include "generate/event_driven/lane_neighbors.hpp"

namespace packstone::event_driven {
namespace {

// Up to eight neighbors, how they are placed and how they fly, seen from body i.
struct Group {
  std::int32_t body[8];
  Lanes3 r, velocity;
  Lanes after;    // Time since the clock of the neighbor.
  Lanes turn;     // Its angular speed.
  Lanes horizon;  // From now.
  Lanes l;        // Of the last look.
  unsigned present;
};

// Own images stand still against the body, and turn as it does; walls are left to others.
PACKSTONE_LANES Group group_of(const PairQuestion& q, std::size_t first) {
  Group g;
  const Heads heads = heads_of(q.neighbors, q.count, first);
  g.l = heads.l;
  double events[8];
  unsigned present = 0;
  for (int l = 0; l < 8; ++l) {
    const std::int32_t body = heads.body[l];
    present |= static_cast<unsigned>(body >= 0) << l;
    g.body[l] = body >= 0 ? body : q.i;
    events[l] = q.times[g.body[l]];
  }
  const std::size_t left = q.count - first;
  g.present = left < 8 ? present & ((1U << left) - 1U) : present;
  const Columns c = gathered(q.flight, g.body);
  const Flight& own = q.flight[q.i];
  g.after = q.t - c.c[6];
  g.turn = c.c[7];
  const Lanes3 velocity{c.c[3], c.c[4], c.c[5]};
  const Lanes3 images{q.edges.x * heads.image.x, q.edges.y * heads.image.y,
                      q.edges.z * heads.image.z};
  const Lanes event = lanes_of(events);
  g.r = (Lanes3{c.c[0], c.c[1], c.c[2]} - all_lanes(own.center)) + images + g.after * velocity;
  g.velocity = velocity - all_lanes(own.velocity);
  const Lanes earlier = event < q.horizon ? event : Lanes{} + q.horizon;
  g.horizon = larger(earlier - q.t, Lanes{});
  return g;
}

// The times at which balls touch, in closed form.
PACKSTONE_LANES std::size_t look_at_balls(const PairQuestion& q, Suspect* suspects,
                                          double& least_gap) {
  const double own_radius = q.reach[q.i];
  std::size_t count = 0;
  for (std::size_t first = 0; first < q.count; first += 8) {
    const Group g = group_of(q, first);
    Lanes radii;
    for (int l = 0; l < 8; ++l) radii[l] = own_radius + q.reach[g.body[l]];
    const Lanes touching = q.size * radii + q.min_gap;
    const Lanes contact_gap =
        larger(kSmoothContactGap * q.size * radii, Lanes{} + q.coordinate_gap);
    const Lanes range = touching + kAimedPart * contact_gap;
    const Lanes growth = q.growth * radii;
    const Lanes rr = dot(g.r, g.r);
    const Lanes a = dot(g.velocity, g.velocity) - growth * growth;
    const Lanes b = dot(g.r, g.velocity) - range * growth;
    const Lanes c = rr - range * range;
    const Lanes discriminant = b * b - a * c;
    const Lanes far = root(larger(discriminant, Lanes{}));
    const Lanes never = Lanes{} + __builtin_inf();
    const Lanes meeting = discriminant < 0.0 ? never : c / (far - b);
    const Lanes growing = a < 0.0 ? -(b + far) / a : never;
    const Lanes apart = b < 0.0 ? meeting : growing;
    const Lanes within = b < 0.0 ? Lanes{} : never;
    const Lanes time = c > 0.0 ? apart : within;
    const Lanes gap = (rr - touching * touching) / (touching + touching);
    unsigned hits = bits(time < g.horizon) & g.present;
    const unsigned overlaps = bits(gap < least_gap) & g.present;
    for (unsigned rest = overlaps; rest != 0; rest &= rest - 1) {
      const double seen = gap[__builtin_ctz(rest)];
      least_gap = seen < least_gap ? seen : least_gap;
    }
    for (; hits != 0; hits &= hits - 1) {
      const int l = __builtin_ctz(hits);
      suspects[count++] = {static_cast<std::int32_t>(first) + l, q.t + time[l], 0.0};
    }
  }
  return count;
}

PACKSTONE_LANES Side side_of(const Columns& c, const Lanes& after, const Lanes& turn) {
  Side side;
  side.angular = {c.c[3], c.c[4], c.c[5]};
  side.axis = turned_across(Lanes3{c.c[0], c.c[1], c.c[2]}, side.angular, turn, after);
  side.lateral = c.c[6] * c.c[6];
  side.extra = c.c[7] * c.c[7] - side.lateral;
  side.turn = turn;
  return side;
}

// What the support of a body is at most a time h from now: root(square) + remainder.
struct Later {
  Lanes square, remainder;
};

// The support along a normal as time goes on, equation (2) of plane_bound.hpp without a turning
// plane: R |k| h^2 (g + s_h |w| / 2) is its remainder, with the sum of the components in place of
// the length.
struct Support {
  Lanes n_n, n_k, k_k;
  Lanes bend;
  Lanes turn;

  // Size factors s now and s_h then.
  [[gnu::always_inline]] Later at(const Lanes& h, double s, const Lanes& s_h, double growth) const {
    const Lanes sh = s * h;
    const Lanes square = s_h * s_h * n_n + sh * (2.0 * s_h * n_k + sh * k_k);
    return {larger(square, Lanes{}), bend * (h * h) * (growth + 0.5 * s_h * turn)};
  }
};

// See RevolutionBound for what is along the axis.
PACKSTONE_LANES Support support_of(const Side& side, const Lanes3& n, const Lanes& reach) {
  const Lanes3 k = cross(n, side.angular);
  const Lanes along = dot(n, side.axis), k_along = dot(k, side.axis);
  const Lanes length = magnitude(k.x) + magnitude(k.y) + magnitude(k.z);
  return {larger(side.lateral * dot(n, n) + side.extra * along * along, Lanes{}),
          side.extra * along * k_along, side.lateral * dot(k, k) + side.extra * k_along * k_along,
          reach * length, side.turn};
}

// reach > root(p) + root(q), with one root for two.
PACKSTONE_LANES Mask exceeds_roots(const Lanes& reach, const Lanes& p, const Lanes& q) {
  return (reach > 0.0) & (reach * reach > p + q + 2.0 * root(p * q));
}

// The bound of plane_bound.hpp for a plane that stands still.
struct Bound {
  Lanes reach, speed;  // n.r less what counts as contact, n.v
  Support a, b;
  double s, growth;

  // What is left for the roots, and these.
  struct Parts {
    Lanes reach, square_a, square_b;
    [[gnu::always_inline]] Mask positive() const {
      return exceeds_roots(reach, square_a, square_b);
    }
    [[gnu::always_inline]] Lanes value() const { return reach - root(square_a) - root(square_b); }
  };
  [[gnu::always_inline]] Parts at(const Lanes& h) const {
    const Lanes s_h = s + growth * h;
    const Later of_a = a.at(h, s, s_h, growth), of_b = b.at(h, s, s_h, growth);
    return {reach + h * speed - of_a.remainder - of_b.remainder, of_a.square, of_b.square};
  }
  [[gnu::always_inline]] Parts now() const { return {reach, s * s * a.n_n, s * s * b.n_n}; }

  // A time up to which it is positive, where it is so now and not at the horizon: it lies above its
  // chords.
  [[gnu::always_inline]] Lanes clear_time(const Lanes& horizon, const Parts& later) const {
    constexpr int kChords = 2;
    const Lanes end = later.value();
    Lanes time{}, left = now().value();
    for (int k = 0; k < kChords; ++k) {
      const Lanes next = time + (horizon - time) * (left / (left - end));
      const Mask gets_on = (left > 0.0) & (next > time) & (next <= horizon);
      time = gets_on ? next : time;
      if (k + 1 < kChords) left = gets_on ? at(time).value() : Lanes{};
    }
    return time;
  }
};

PACKSTONE_LANES std::size_t look_at_revolution(const PairQuestion& q, Suspect* suspects) {
  const double s = q.size, growth = q.growth;
  const Flight& flight = q.flight[q.i];
  const Side a =
      side_of(all_lanes_of(q.spin[q.i]), Lanes{} + (q.t - flight.clock), Lanes{} + flight.turn);
  const double reach_a = q.reach[q.i];
  std::size_t count = 0;
  for (std::size_t first = 0; first < q.count; first += 8) {
    const Group g = group_of(q, first);
    const Columns columns = gathered(q.spin, g.body);
    const Side b = side_of(columns, g.after, g.turn);
    const Lanes reach_b = larger(columns.c[6], columns.c[7]);
    const auto plane = plane_step(a, b, g.r, g.l);
    const Lanes3& n = plane.normal;
    const Lanes contact_gap =
        larger(kSmoothContactGap * s * (reach_a + reach_b), Lanes{} + q.coordinate_gap);
    const Lanes slack = contact_gap * (magnitude(n.x) + magnitude(n.y) + magnitude(n.z));
    const Bound bound{dot(n, g.r) - slack,
                      dot(n, g.velocity),
                      support_of(a, n, Lanes{} + reach_a),
                      support_of(b, n, reach_b),
                      s,
                      growth};
    const Bound::Parts later = bound.at(g.horizon);
    // Whatever is not proven, also where it is no number, stays suspect.
    unsigned hits = ~bits(bound.now().positive() & later.positive()) & g.present;
    const Single l = __builtin_convertvector(plane.l, Single);
    for (std::size_t k = 0; k < 8; ++k) {
      q.neighbors[first + k < q.count ? first + k : q.count - 1].hint[0] = l[k];
    }
    if (hits == 0) continue;
    const Lanes clear = bound.clear_time(g.horizon, later);
    for (; hits != 0; hits &= hits - 1) {
      const int k = __builtin_ctz(hits);
      suspects[count++] = {static_cast<std::int32_t>(first) + k, clear[k], plane.l[k]};
    }
  }
  return count;
}

}  // namespace
}  // namespace packstone::event_driven
