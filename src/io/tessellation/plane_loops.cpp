#include "io/tessellation/plane_loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace packstone {
namespace {

// Twice the area of the triangle (a, b, c), > 0 counterclockwise.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class LoopTracer {
 public:
  LoopTracer(const std::vector<DirectedEdge>& edges, const std::vector<Vec3>& points)
      : edges_(edges), points_(points), by_start_(edges.size()), used_(edges.size(), 0) {
    std::iota(by_start_.begin(), by_start_.end(), std::size_t{0});
    std::stable_sort(by_start_.begin(), by_start_.end(),
                     [&](std::size_t a, std::size_t b) { return edges_[a].from < edges_[b].from; });
  }

  std::vector<std::vector<std::size_t>> loops() {
    std::vector<std::vector<std::size_t>> all;
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (used_[first] != 0) continue;
      std::vector<std::size_t> loop;
      for (std::size_t edge = first; loop.empty() || edge != first; edge = next(edge, first)) {
        used_[edge] = 1;
        loop.push_back(edge);
      }
      all.push_back(std::move(loop));
    }
    return all;
  }

 private:
  // Angle by which the way turns to the left from one edge to the next, in [-pi, pi). To turn back
  // is to turn to the right about the end of a line.
  [[nodiscard]] double left_turn(std::size_t edge, std::size_t then) const {
    if (edges_[then].to == edges_[edge].from) return -std::numbers::pi;
    const Vec3 in = points_[edges_[edge].to] - points_[edges_[edge].from];
    const Vec3 out = points_[edges_[then].to] - points_[edges_[then].from];
    return std::atan2(in.x * out.y - in.y * out.x, dot(in, out));
  }

  // Among the edges that begin where this one ends; `first` closes the loop.
  [[nodiscard]] std::size_t next(std::size_t edge, std::size_t first) const {
    const std::size_t at = edges_[edge].to;
    auto candidate =
        std::lower_bound(by_start_.begin(), by_start_.end(), at,
                         [&](std::size_t e, std::size_t point) { return edges_[e].from < point; });
    std::size_t best = first;
    double sharpest = -std::numeric_limits<double>::infinity();
    for (; candidate != by_start_.end() && edges_[*candidate].from == at; ++candidate) {
      if (used_[*candidate] != 0 && *candidate != first) continue;
      const double angle = left_turn(edge, *candidate);
      if (angle <= sharpest) continue;
      sharpest = angle;
      best = *candidate;
    }
    return best;
  }

  const std::vector<DirectedEdge>& edges_;
  const std::vector<Vec3>& points_;
  std::vector<std::size_t> by_start_;
  std::vector<char> used_;
};

}  // namespace

std::vector<std::vector<std::size_t>> plane_loops(const std::vector<DirectedEdge>& edges,
                                                  const std::vector<Vec3>& points) {
  return LoopTracer(edges, points).loops();
}

double signed_area(const std::vector<Vec3>& polygon) {
  double twice = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    twice += turn(polygon[0], polygon[k - 1], polygon[k]);
  }
  return 0.5 * twice;
}

bool holds(const std::vector<Vec3>& polygon, const Vec3& p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const double x = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x > p.x) inside = !inside;
  }
  return inside;
}

bool cross_each_other(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

}  // namespace packstone
