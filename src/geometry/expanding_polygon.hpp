#pragma once

/// @file
/// The depth of r in M within a plane: expanding_polytope.hpp in two dimensions.
///
/// Serves the plane's own bodies, and bodies of revolution about parallel axes: their M is one of
/// revolution too, so that the depth is found in the plane of the axis and r.

#include <array>
#include <limits>

#include "geometry/expanding_polytope.hpp"

namespace packstone {

/// An orthonormal frame of the plane that holds r.
struct PlaneFrame {
  Vec3 x;
  Vec3 y;
};

/// As search_depth(), over the directions of one plane. `sum.support(d)` must lie in the plane.
template <class Sum>
Depth search_depth_in_plane(const Sum& sum, const Vec3& r, const PlaneFrame& frame,
                            double tolerance) {
  constexpr int kCorners = 512;
  std::array<SumPoint, kCorners> corner;
  std::array<int, kCorners> next;
  std::array<Vec3, kCorners> normal;   // of the edge from a corner to the next
  std::array<double, kCorners> inner;  // the edge's inner bound
  const auto left = [&](const Vec3& v) {
    return dot(v, frame.x) * frame.y - dot(v, frame.y) * frame.x;
  };
  const auto opposite = [](const SumPoint& p) { return SumPoint{-p.in_a, -p.in_b, -p.sum}; };
  const auto measure = [&](int i) {
    const Vec3 p = corner[i].sum - r, q = corner[next[i]].sum - r;
    const Vec3 n = -left(q - p);
    const double length = norm(n);
    normal[i] = length > 0.0 ? n / length : Vec3{};
    inner[i] = length > 0.0 ? std::fmin(dot(normal[i], p), dot(normal[i], q))
                            : std::numeric_limits<double>::infinity();
  };
  const auto locate = [&](int i, Depth& found) {
    const Vec3 p = corner[i].sum - r, e = corner[next[i]].sum - corner[i].sum;
    const double t = std::clamp(-dot(p, e) / norm_sq(e), 0.0, 1.0);
    const double miss = norm(p + t * e);
    if (!(miss < found.miss)) return;
    found.miss = miss;
    found.in_a = (1.0 - t) * corner[i].in_a + t * corner[next[i]].in_a;
  };
  corner[0] = sum.support(frame.x);
  corner[1] = sum.support(left(corner[0].sum));
  corner[2] = opposite(corner[0]);
  corner[3] = opposite(corner[1]);
  int count = 4;
  for (int i = 0; i < count; ++i) next[i] = (i + 1) % 4;
  for (int i = 0; i < count; ++i) measure(i);
  Depth depth;
  for (;;) {
    int edge = 0;
    for (int i = 1; i < count; ++i) {
      if (inner[i] < inner[edge]) edge = i;
    }
    depth.inner = inner[edge];
    if (!(norm_sq(normal[edge]) > 0.0)) return depth;
    const SumPoint tip = sum.support(normal[edge]);
    const double outer = dot(normal[edge], tip.sum - r);
    if (outer < depth.outer) depth.outer = outer, depth.normal = normal[edge];
    const bool closed = depth.outer - depth.inner <= tolerance || depth.outer <= 0.0;
    if (closed || outer <= depth.inner || count == kCorners) {
      // Flat parts of M are several edges of one bound: take the one that the perpendicular meets.
      for (int i = 0; i < count; ++i) {
        if (dot(normal[i], depth.normal) > 1.0 - 1e-9) locate(i, depth);
      }
      return depth;
    }
    corner[count] = tip;
    next[count] = next[edge];
    next[edge] = count;
    measure(edge);
    measure(count);
    ++count;
  }
}

}  // namespace packstone
