#pragma once

/// @file
/// Distance of r from M (minkowski_sum.hpp) by the algorithm of Gilbert, Johnson and Keerthi.
///
/// Points are kept as v - r with v in M. The point of their hull next to the origin is an upper
/// bound on the distance, the support plane across it a lower one:
///
///     -d.(v - r) over all v in M  >=  g(d),   d = -x / |x|                                 (1)
///
/// Reference: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, IEEE J. Robotics Automat. 4 (1988)
/// 193-203. Ours takes the direction from edge and plane normals, not from the closest point, so
/// that it stays accurate when the distance is small.

#include <limits>

#include "geometry/minkowski_sum.hpp"

namespace packstone {

/// Up to four points of M with the weights of the hull's point next to r.
struct Simplex {
  SumPoint corner[4];
  Vec3 offset[4];  ///< corner.sum - r
  double weight[4] = {};
  int count = 0;
};

/// The point of a hull next to the origin.
struct Nearest {
  Vec3 point;
  Vec3 direction;  ///< Along `point`, from edge or plane normals; not unit.
  double weight[4] = {};
  double distance_sq = std::numeric_limits<double>::infinity();
  bool holds_origin = false;
};

namespace detail {

inline Nearest nearest_on_vertex(const Simplex& s, int i) {
  Nearest best;
  best.point = best.direction = s.offset[i];
  best.weight[i] = 1.0;
  best.distance_sq = norm_sq(best.point);
  return best;
}

inline Nearest nearest_on_edge(const Simplex& s, int i, int j) {
  const Vec3& p = s.offset[i];
  const Vec3 edge = s.offset[j] - p;
  const double length_sq = norm_sq(edge);
  const double t = -dot(p, edge);
  if (!(t > 0.0)) return nearest_on_vertex(s, i);
  if (!(t < length_sq)) return nearest_on_vertex(s, j);
  Nearest best;
  best.weight[j] = t / length_sq;
  best.weight[i] = 1.0 - best.weight[j];
  best.point = p + best.weight[j] * edge;
  best.direction = best.point - (dot(best.point, edge) / length_sq) * edge;
  best.distance_sq = norm_sq(best.point);
  return best;
}

inline Nearest closer(const Nearest& a, const Nearest& b) {
  return b.distance_sq < a.distance_sq ? b : a;
}

inline Nearest nearest_on_triangle(const Simplex& s, int i, int j, int k) {
  // The two shorter edges meet in the base: slivers lose nothing.
  const double ij = norm_sq(s.offset[j] - s.offset[i]), jk = norm_sq(s.offset[k] - s.offset[j]);
  const double ki = norm_sq(s.offset[i] - s.offset[k]);
  const int base = jk >= ij && jk >= ki ? i : (ki >= ij ? j : k);
  const int next = base == i ? j : (base == j ? k : i);
  const int last = base == i ? k : (base == j ? i : j);
  const Vec3& a = s.offset[base];
  const Vec3 e = s.offset[next] - a, f = s.offset[last] - a;
  const Vec3 n = cross(e, f);
  const double n_sq = norm_sq(n);
  const double to_next = -dot(cross(a, f), n), to_last = -dot(cross(e, a), n);
  const bool flat = n_sq <= 1e-28 * norm_sq(e) * norm_sq(f);
  if (!flat && to_next >= 0.0 && to_last >= 0.0 && to_next + to_last <= n_sq) {
    Nearest best;
    best.weight[next] = to_next / n_sq;
    best.weight[last] = to_last / n_sq;
    best.weight[base] = std::fmax(1.0 - best.weight[next] - best.weight[last], 0.0);
    const double height = dot(n, a);
    best.point = (height / n_sq) * n;
    best.direction = height < 0.0 ? -n : n;
    best.distance_sq = norm_sq(best.point);
    return best;
  }
  return closer(closer(nearest_on_edge(s, i, j), nearest_on_edge(s, j, k)),
                nearest_on_edge(s, k, i));
}

inline Nearest nearest_on_tetrahedron(const Simplex& s) {
  static constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
  Nearest best;
  bool inside = true;
  for (const auto& f : kFaces) {
    const Vec3& a = s.offset[f[0]];
    const Vec3 n = cross(s.offset[f[1]] - a, s.offset[f[2]] - a);
    const Vec3 to_apex = s.offset[f[3]] - a;
    const double apex = dot(n, to_apex);
    const double origin = -dot(n, a);
    // A flat tetrahedron has no side worth trusting: look at the face.
    const bool flat = std::abs(apex) <= 64 * kUnitRoundoff * norm(n) * norm(to_apex);
    if (!flat && origin * apex > 0.0) continue;
    inside = false;
    best = closer(best, nearest_on_triangle(s, f[0], f[1], f[2]));
  }
  best.holds_origin = inside;
  return best;
}

}  // namespace detail

/// The point of the simplex next to the origin; keeps only the corners that carry it.
inline Nearest reduce(Simplex& s) {
  Nearest best;
  switch (s.count) {
    case 1:
      best = detail::nearest_on_vertex(s, 0);
      break;
    case 2:
      best = detail::nearest_on_edge(s, 0, 1);
      break;
    case 3:
      best = detail::nearest_on_triangle(s, 0, 1, 2);
      break;
    default:
      best = detail::nearest_on_tetrahedron(s);
      break;
  }
  if (best.holds_origin) return best;
  int kept = 0;
  for (int i = 0; i < s.count; ++i) {
    if (best.weight[i] <= 0.0) continue;
    s.corner[kept] = s.corner[i];
    s.offset[kept] = s.offset[i];
    s.weight[kept++] = best.weight[i];
  }
  s.count = kept;
  return best;
}

/// What a distance search has found.
struct Distance {
  double lower = 0.0;   ///< Best g(d) seen, as evaluated [L].
  double upper = 0.0;   ///< Distance of two points of the bodies [L].
  Vec3 direction;       ///< Unit, attains `lower`.
  Vec3 in_a;            ///< Point of a, relative to its center.
  Vec3 in_b;            ///< Point of b, relative to its center.
  bool inside = false;  ///< r seems to lie in M; not a proof.
};

inline constexpr int kGjkSteps = 128;

/// Searches until the bracket is within `tolerance` [L], starting along `start`.
template <class Sum>
Distance search_distance(const Sum& sum, const Vec3& r, Vec3 start, double tolerance, bool planar) {
  Distance found;
  found.lower = -std::numeric_limits<double>::infinity();
  found.upper = std::numeric_limits<double>::infinity();
  Simplex s;
  Vec3 d = start;
  for (int step = 0; step < kGjkSteps; ++step) {
    const SumPoint tip = sum.support(d);
    const Vec3 offset = tip.sum - r;
    const double lower = -dot(d, offset) / norm(d);
    if (lower > found.lower) found.lower = lower, found.direction = normalized(d);
    if (found.upper - found.lower <= tolerance) return found;
    for (int i = 0; i < s.count; ++i) {
      if (s.offset[i] == offset) return found;
    }
    s.corner[s.count] = tip;
    s.offset[s.count++] = offset;
    const Nearest nearest = reduce(s);
    found.inside = nearest.holds_origin;
    // A triangle of the plane that holds the origin has no direction within the plane.
    const Vec3& across = nearest.direction;
    const bool flat = planar && across.x == 0.0 && across.y == 0.0;
    if (found.inside || flat || !(norm_sq(nearest.direction) > 0.0)) {
      found.inside = true;
      return found;
    }
    Vec3 in_a, in_b, offset_sum;
    for (int i = 0; i < s.count; ++i) {
      in_a += s.weight[i] * s.corner[i].in_a;
      in_b -= s.weight[i] * s.corner[i].in_b;
      offset_sum += s.weight[i] * s.offset[i];
    }
    const double distance = norm(offset_sum);
    if (!(distance < found.upper)) return found;
    found.upper = distance;
    found.in_a = in_a;
    found.in_b = in_b;
    d = -nearest.direction;
  }
  return found;
}

}  // namespace packstone
