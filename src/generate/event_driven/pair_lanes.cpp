#include "generate/event_driven/pair_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generate/event_driven/contact_gap.hpp"
#include "generate/event_driven/lanes.hpp"
#include "generate/event_driven/revolution_pair.hpp"

namespace packstone::event_driven {

namespace {

// What is asked.
struct Question {
  const Bodies& bodies;
  Vec3 edges;
  double coordinate_gap;
  std::int32_t i;
  double t;
  double horizon;
  const double* times;
  std::span<Neighbor> neighbors;
};

// Up to eight neighbors, how they are placed and how they fly, seen from body i.
struct Group {
  std::int32_t body[8];
  Lanes3 r, velocity;
  Lanes after;    // Time since the clock of the neighbor.
  Lanes turn;     // Its angular speed.
  Lanes horizon;  // From now.
  unsigned present;
};

// Own images stand still against the body, and turn as it does; walls are left to others.
PACKSTONE_LANES Group group_of(const Question& q, std::size_t first) {
  Group g;
  double shift_x[8], shift_y[8], shift_z[8], events[8];
  unsigned present = 0;
  for (int l = 0; l < 8; ++l) {
    const std::size_t k = first + static_cast<std::size_t>(l);
    const bool there = k < q.neighbors.size() && q.neighbors[k].body >= 0;
    const Neighbor& neighbor = q.neighbors[there ? k : first];
    g.body[l] = there ? neighbor.body : q.i;
    present |= static_cast<unsigned>(there) << l;
    shift_x[l] = neighbor.image[0];
    shift_y[l] = neighbor.image[1];
    shift_z[l] = neighbor.image[2];
    events[l] = g.body[l] == q.i ? q.horizon : q.times[g.body[l]];
  }
  g.present = present;
  const Columns c = gathered(q.bodies.flight.data(), g.body);
  const Flight& own = q.bodies.flight[static_cast<std::size_t>(q.i)];
  g.after = q.t - c.c[6];
  g.turn = c.c[7];
  const Lanes3 velocity{c.c[3], c.c[4], c.c[5]};
  const Lanes3 images{q.edges.x * lanes_of(shift_x), q.edges.y * lanes_of(shift_y),
                      q.edges.z * lanes_of(shift_z)};
  const Lanes event = lanes_of(events);
  g.r = (Lanes3{c.c[0], c.c[1], c.c[2]} - all_lanes(own.center)) + images + g.after * velocity;
  g.velocity = velocity - all_lanes(own.velocity);
  const Lanes earlier = event < q.horizon ? event : Lanes{} + q.horizon;
  g.horizon = larger(earlier - q.t, Lanes{});
  return g;
}

// The times at which balls touch, in closed form.
PACKSTONE_LANES std::size_t look_at_balls(const Question& q, Suspect* suspects, double& least_gap) {
  const Bodies& bodies = q.bodies;
  const double size = bodies.size_at(q.t);
  const double own_radius = bodies.spin[static_cast<std::size_t>(q.i)].lateral;
  std::size_t count = 0;
  for (std::size_t first = 0; first < q.neighbors.size(); first += 8) {
    const Group g = group_of(q, first);
    Lanes radii;
    for (int l = 0; l < 8; ++l)
      radii[l] = own_radius + bodies.reach[static_cast<std::size_t>(g.body[l])];
    const Lanes touching = size * radii + bodies.min_gap;
    const Lanes contact_gap = larger(kSmoothContactGap * size * radii, Lanes{} + q.coordinate_gap);
    const Lanes range = touching + kAimedPart * contact_gap;
    const Lanes growth = bodies.growth * radii;
    const Lanes rr = dot(g.r, g.r);
    const Lanes a = dot(g.velocity, g.velocity) - growth * growth;
    const Lanes b = dot(g.r, g.velocity) - range * growth;
    const Lanes c = rr - range * range;
    const Lanes discriminant = b * b - a * c;
    const Lanes far = root(larger(discriminant, Lanes{}));
    const Lanes never = Lanes{} + std::numeric_limits<double>::infinity();
    const Lanes meeting = discriminant < 0.0 ? never : c / (far - b);
    const Lanes growing = a < 0.0 ? -(b + far) / a : never;
    const Lanes apart = b < 0.0 ? meeting : growing;
    const Lanes within = b < 0.0 ? Lanes{} : never;
    const Lanes time = c > 0.0 ? apart : within;
    const Lanes gap = (rr - touching * touching) / (touching + touching);
    unsigned hits = bits(time < g.horizon) & g.present;
    const unsigned overlaps = bits(gap < least_gap) & g.present;
    for (unsigned rest = overlaps; rest != 0; rest &= rest - 1) {
      least_gap = std::min(least_gap, gap[__builtin_ctz(rest)]);
    }
    for (; hits != 0; hits &= hits - 1) {
      const int l = __builtin_ctz(hits);
      suspects[count++] = {static_cast<std::int32_t>(first) + l, q.t + time[l], 0.0};
    }
  }
  return count;
}

using Side = Revolution<Lanes, Lanes3>;

PACKSTONE_LANES Side side_of(const Columns& c, const Lanes& after, const Lanes& turn) {
  Side side;
  side.angular = {c.c[3], c.c[4], c.c[5]};
  side.axis = turned_across(Lanes3{c.c[0], c.c[1], c.c[2]}, side.angular, turn, after);
  side.lateral = c.c[6] * c.c[6];
  side.extra = c.c[7] * c.c[7] - side.lateral;
  side.turn = turn;
  return side;
}

// What the support of a body is at most a time h from now: root(square) + remainder. Size factors s
// now and s_h then; q: n.Xn now.
struct Later {
  Lanes square, remainder;
};

PACKSTONE_LANES Later support_later(const Side& side, const Lanes3& n, const Lanes& along,
                                    const Lanes& q, double s, const Lanes& s_h, double growth,
                                    const Lanes& h, const Lanes& reach) {
  const Lanes3 k = cross(n, side.angular);
  const Lanes k_along = dot(k, side.axis);
  const Lanes n_k = side.extra * along * k_along;
  const Lanes k_k = side.lateral * dot(k, k) + side.extra * k_along * k_along;
  const Lanes sh = s * h;
  const Lanes square = s_h * s_h * q + sh * (2.0 * s_h * n_k + sh * k_k);
  // Equation (2) of plane_bound.hpp without a turning plane: R |k| h^2 (g + s_h |w| / 2), with the
  // sum of the components in place of the length.
  const Lanes length = magnitude(k.x) + magnitude(k.y) + magnitude(k.z);
  return {larger(square, Lanes{}), reach * length * (h * h) * (growth + 0.5 * s_h * side.turn)};
}

// reach > root(p) + root(q), with one root for two.
PACKSTONE_LANES Mask exceeds_roots(const Lanes& reach, const Lanes& p, const Lanes& q) {
  return (reach > 0.0) & (reach * reach > p + q + 2.0 * root(p * q));
}

// The neighbors' l; where none is known yet, what it is for balls.
PACKSTONE_LANES Lanes known_l(const Question& q, std::size_t first, double reach_a,
                              const std::int32_t (&body)[8]) {
  double l[8];
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t at = first + k;
    const double hint = at < q.neighbors.size() ? q.neighbors[at].hint[0] : 0.0;
    const double reach_b = q.bodies.reach[static_cast<std::size_t>(body[k])];
    l[k] = hint > 0.0 ? hint : reach_a / (reach_a + reach_b);
  }
  return lanes_of(l);
}

// How long the chord of a concave bound says that it stays positive.
double clear_time(double reach_now, double p, double q, double reach_later, double square_a,
                  double square_b, double horizon) {
  const double now = reach_now - std::sqrt(std::max(0.0, p)) - std::sqrt(std::max(0.0, q));
  const double later = reach_later - std::sqrt(square_a) - std::sqrt(square_b);
  const double time = horizon * now / (now - later);
  return now > 0.0 && time > 0.0 ? std::min(time, horizon) : 0.0;
}

PACKSTONE_LANES std::size_t look_at_revolution(const Question& q, Suspect* suspects) {
  const Bodies& bodies = q.bodies;
  const double s = bodies.size_at(q.t), growth = bodies.growth;
  const Flight& flight = bodies.flight[static_cast<std::size_t>(q.i)];
  Columns own_columns;
  {
    Lanes line;
    __builtin_memcpy(&line, bodies.spin.data() + q.i, sizeof(Lanes));
    for (int k = 0; k < 8; ++k) own_columns.c[k] = Lanes{} + line[k];
  }
  const Side a = side_of(own_columns, Lanes{} + (q.t - flight.clock), Lanes{} + flight.turn);
  const double reach_a = bodies.reach[static_cast<std::size_t>(q.i)];
  std::size_t count = 0;
  for (std::size_t first = 0; first < q.neighbors.size(); first += 8) {
    const Group g = group_of(q, first);
    const Columns columns = gathered(bodies.spin.data(), g.body);
    const Side b = side_of(columns, g.after, g.turn);
    const Lanes reach_b = larger(columns.c[6], columns.c[7]);
    const auto plane = plane_step(a, b, g.r, known_l(q, first, reach_a, g.body));
    const Lanes3& n = plane.normal;
    const Lanes nn = dot(n, n);
    const Lanes p_a = larger(a.lateral * nn + a.extra * plane.along_a * plane.along_a, Lanes{});
    const Lanes p_b = larger(b.lateral * nn + b.extra * plane.along_b * plane.along_b, Lanes{});
    const Lanes contact_gap =
        larger(kSmoothContactGap * s * (reach_a + reach_b), Lanes{} + q.coordinate_gap);
    const Lanes slack = contact_gap * (magnitude(n.x) + magnitude(n.y) + magnitude(n.z));
    const Lanes& h = g.horizon;
    const Lanes s_h = s + growth * h;
    const Lanes reach = dot(n, g.r) - slack;
    const Later of_a =
        support_later(a, n, plane.along_a, p_a, s, s_h, growth, h, Lanes{} + reach_a);
    const Later of_b = support_later(b, n, plane.along_b, p_b, s, s_h, growth, h, reach_b);
    const Lanes reach_later = reach + h * dot(n, g.velocity) - of_a.remainder - of_b.remainder;
    const Lanes q_a = s * s * p_a, q_b = s * s * p_b;
    // Whatever is not proven, also where it is no number, stays suspect.
    const Mask clear =
        exceeds_roots(reach, q_a, q_b) & exceeds_roots(reach_later, of_a.square, of_b.square);
    unsigned hits = ~bits(clear) & g.present;
    for (std::size_t k = 0; k < 8 && first + k < q.neighbors.size(); ++k) {
      q.neighbors[first + k].hint[0] = static_cast<float>(plane.l[k]);
    }
    for (; hits != 0; hits &= hits - 1) {
      const int k = __builtin_ctz(hits);
      suspects[count++] = {static_cast<std::int32_t>(first) + k,
                           clear_time(reach[k], q_a[k], q_b[k], reach_later[k], of_a.square[k],
                                      of_b.square[k], h[k]),
                           plane.l[k]};
    }
  }
  return count;
}

[[gnu::target("avx512f")]] std::size_t balls_by_eight(const Question& q, Suspect* suspects,
                                                      double& least_gap) {
  return look_at_balls(q, suspects, least_gap);
}
[[gnu::target("avx2")]] std::size_t balls_by_four(const Question& q, Suspect* suspects,
                                                  double& least_gap) {
  return look_at_balls(q, suspects, least_gap);
}
std::size_t balls_by_two(const Question& q, Suspect* suspects, double& least_gap) {
  return look_at_balls(q, suspects, least_gap);
}
[[gnu::target("avx512f")]] std::size_t revolution_by_eight(const Question& q, Suspect* suspects) {
  return look_at_revolution(q, suspects);
}
[[gnu::target("avx2")]] std::size_t revolution_by_four(const Question& q, Suspect* suspects) {
  return look_at_revolution(q, suspects);
}
std::size_t revolution_by_two(const Question& q, Suspect* suspects) {
  return look_at_revolution(q, suspects);
}

}  // namespace

PairLanes::Kind PairLanes::kind_of(const Bodies& bodies) {
  const auto is_ball = [](Form form) { return form == Form::ball; };
  if (std::all_of(bodies.form.begin(), bodies.form.end(), is_ball)) return Kind::balls;
  return are_revolution(bodies) && bodies.min_gap == 0.0 ? Kind::revolution : Kind::none;
}

PairLanes::PairLanes(const Bodies& bodies, const Cell& cell)
    : bodies_(bodies),
      edges_(cell.size),
      coordinate_gap_(kCoordinateGap * std::max({cell.size.x, cell.size.y, cell.size.z})),
      kind_(kind_of(bodies)),
      width_(lanes_width()) {}

std::size_t PairLanes::look(std::int32_t i, double t, double horizon, const double* times,
                            std::span<Neighbor> neighbors, Suspect* suspects,
                            double& least_gap) const {
  const Question question{bodies_, edges_, coordinate_gap_, i, t, horizon, times, neighbors};
  if (kind_ == Kind::balls) {
    if (width_ == 8) return balls_by_eight(question, suspects, least_gap);
    if (width_ == 4) return balls_by_four(question, suspects, least_gap);
    return balls_by_two(question, suspects, least_gap);
  }
  if (width_ == 8) return revolution_by_eight(question, suspects);
  if (width_ == 4) return revolution_by_four(question, suspects);
  return revolution_by_two(question, suspects);
}

}  // namespace packstone::event_driven
