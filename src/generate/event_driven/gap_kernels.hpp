#pragma once

/// @file
/// What reference_lanes.hpp does, in lanes. Included as pair_kernels.hpp is.

#include <cstddef>
#include <cstdint>

#include "generate/event_driven/lane_kernels.hpp"
#include "generate/event_driven/lane_neighbors.hpp"

namespace packstone::event_driven {
namespace {

PACKSTONE_LANES Side side_of(const Columns& c) {
  Side side{};
  side.axis = {c.c[3], c.c[4], c.c[5]};
  side.lateral = c.c[6] * c.c[6];
  side.extra = c.c[7] * c.c[7] - side.lateral;
  return side;
}

PACKSTONE_LANES Lanes gap_along(const Side& a, const Side& b, const Lanes3& r, const Lanes3& n) {
  const Lanes nn = dot(n, n), u = dot(n, a.axis), v = dot(n, b.axis);
  const Lanes p = larger(a.lateral * nn + a.extra * u * u, Lanes{});
  const Lanes q = larger(b.lateral * nn + b.extra * v * v, Lanes{});
  return (dot(n, r) - root(p) - root(q)) / root(nn);
}

// Of the capsules that hold both: the distance of two segments less the radii. From the points that
// seem to come nearest, by the plane across the way between them.
PACKSTONE_LANES Lanes capsule_gap(const Side& a, const Side& b, const Lanes3& r,
                                  const Lanes& half_a, const Lanes& half_b, const Lanes& radii) {
  constexpr double kParallel = 1e-12;
  const Lanes c = dot(a.axis, b.axis), ar = dot(a.axis, r), br = dot(b.axis, r);
  const Lanes sine_sq = larger(1.0 - c * c, Lanes{} + kParallel);
  const Lanes first = within((ar - c * br) / sine_sq, half_a);
  const Lanes there = within(c * first - br, half_b);
  const Lanes here = within(ar + c * there, half_a);
  const Lanes3 d = r + there * b.axis - here * a.axis;
  const Lanes apart =
      dot(d, r) - half_a * magnitude(dot(d, a.axis)) - half_b * magnitude(dot(d, b.axis));
  return apart / root(dot(d, d)) - radii;
}

// The neighbors from `first` on: their columns and where they are.
struct Others {
  Columns columns;
  Lanes3 r;
  Lanes margin;
};

PACKSTONE_LANES Others others_of(const GapQuestion& q, std::size_t first) {
  const Heads heads = heads_of(q.others, q.count, first);
  std::int32_t body[8];
  double margins[8];
  Others others;
  for (int l = 0; l < 8; ++l) {
    body[l] = heads.body[l];
    margins[l] = q.margins != nullptr ? q.margins[body[l]] : 0.0;
  }
  others.margin = lanes_of(margins);
  others.columns = gathered(q.lines, body);
  const Lanes3 center{others.columns.c[0], others.columns.c[1], others.columns.c[2]};
  others.r =
      (center - all_lanes(q.own.center)) +
      Lanes3{q.edges.x * heads.image.x, q.edges.y * heads.image.y, q.edges.z * heads.image.z};
  return others;
}

PACKSTONE_LANES void bound_gaps_in(const GapQuestion& q) {
  const Columns own = all_lanes_of(q.own);
  const Side a = side_of(own);
  const Lanes half_a = larger(own.c[7] - own.c[6], Lanes{});
  const Lanes size_a = larger(own.c[6], own.c[7]);
  for (std::size_t first = 0; first < q.count; first += 8) {
    const Others o = others_of(q, first);
    const Side b = side_of(o.columns);
    const Lanes half_b = larger(o.columns.c[7] - o.columns.c[6], Lanes{});
    Lanes gap = capsule_gap(a, b, o.r, half_a, half_b, own.c[6] + o.columns.c[6]);
    const bool close = q.margins == nullptr || bits(gap > q.own_margin + o.margin) != 0xFFU;
    if (close) {
      const Lanes size_b = larger(o.columns.c[6], o.columns.c[7]);
      const auto once = plane_step(a, b, o.r, size_a / (size_a + size_b));
      gap = larger(gap, gap_along(a, b, o.r, once.normal));
      if (q.margins == nullptr) {
        const auto twice = plane_step(a, b, o.r, once.l);
        gap = larger(gap, gap_along(a, b, o.r, twice.normal));
      }
    }
    for (std::size_t l = 0; l < 8 && first + l < q.count; ++l) q.gaps[first + l] = gap[l];
  }
}

}  // namespace
}  // namespace packstone::event_driven
