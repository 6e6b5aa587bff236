#include "generate/event_driven/reference_lanes.hpp"

#include <algorithm>

#include "generate/event_driven/lanes.hpp"
#include "generate/event_driven/revolution_pair.hpp"

namespace packstone::event_driven {
namespace {

using Side = Revolution<Lanes, Lanes3>;

struct Question {
  const StandingLine& own;
  double own_margin;
  const StandingLine* lines;
  const double* margins;  // None: gaps are wanted as closely as can be.
  std::span<const Neighbor> others;
  Vec3 edges;
  double* gaps;
};

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

PACKSTONE_LANES Others others_of(const Question& q, std::size_t first) {
  std::int32_t body[8];
  double image_x[8], image_y[8], image_z[8], margins[8];
  Others others;
  for (std::size_t l = 0; l < 8; ++l) {
    const Neighbor& other = q.others[std::min(first + l, q.others.size() - 1)];
    body[l] = other.body;
    image_x[l] = other.image[0];
    image_y[l] = other.image[1];
    image_z[l] = other.image[2];
    margins[l] = q.margins != nullptr ? q.margins[body[l]] : 0.0;
  }
  others.margin = lanes_of(margins);
  others.columns = gathered(q.lines, body);
  const Lanes3 center{others.columns.c[0], others.columns.c[1], others.columns.c[2]};
  others.r = (center - all_lanes(q.own.center)) + Lanes3{q.edges.x * lanes_of(image_x),
                                                         q.edges.y * lanes_of(image_y),
                                                         q.edges.z * lanes_of(image_z)};
  return others;
}

PACKSTONE_LANES void bound_gaps_in(const Question& q) {
  Columns own;
  {
    Lanes line;
    __builtin_memcpy(&line, &q.own, sizeof(Lanes));
    for (int k = 0; k < 8; ++k) own.c[k] = Lanes{} + line[k];
  }
  const Side a = side_of(own);
  const Lanes half_a = larger(own.c[7] - own.c[6], Lanes{});
  const Lanes size_a = larger(own.c[6], own.c[7]);
  for (std::size_t first = 0; first < q.others.size(); first += 8) {
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
    for (std::size_t l = 0; l < 8 && first + l < q.others.size(); ++l) q.gaps[first + l] = gap[l];
  }
}

[[gnu::target("avx512f")]] void by_eight(const Question& q) { bound_gaps_in(q); }
[[gnu::target("avx2")]] void by_four(const Question& q) { bound_gaps_in(q); }
void by_two(const Question& q) { bound_gaps_in(q); }

void bound(const Question& question) {
  static const int width = lanes_width();
  if (width == 8) return by_eight(question);
  if (width == 4) return by_four(question);
  by_two(question);
}

}  // namespace

void bound_gaps(const StandingLine& own, const StandingLine* lines,
                std::span<const Neighbor> others, const Vec3& edges, double* gaps) {
  bound({own, 0.0, lines, nullptr, others, edges, gaps});
}

void bound_near_gaps(const StandingLine& own, double own_margin, const StandingLine* lines,
                     const double* margins, std::span<const Neighbor> others, const Vec3& edges,
                     double* gaps) {
  bound({own, own_margin, lines, margins, others, edges, gaps});
}

}  // namespace packstone::event_driven
