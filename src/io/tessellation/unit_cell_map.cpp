#include "io/tessellation/unit_cell_map.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "io/tessellation/plane_loops.hpp"

namespace packstone {
namespace {

constexpr double kSnap = 1e-9;  // of the box
constexpr std::int32_t kUnknown = -2;

// A point of the plane: a point inside the box, 0 <= at < size along periodic axes, and the periods
// by which it is shifted.
struct Spot {
  std::size_t base = 0;
  std::array<int, 2> period{0, 0};

  friend bool operator==(const Spot&, const Spot&) = default;
};

// An edge with what lies to its sides: a cell, Facet::kWall for the outside, or kUnknown.
struct SidedEdge {
  MapEdge edge;
  std::int32_t left = Facet::kWall;
  std::int32_t right = Facet::kWall;
};

class Cutter {
 public:
  explicit Cutter(const Tessellation& t) : t_(t), size_{t.box.size.x, t.box.size.y} {}

  UnitCellMap make() {
    for (const Facet& facet : t_.facets) cut(facet);
    if (t_.box.periodic[0] && t_.box.periodic[1]) base_at({0.0, 0.0});
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (t_.box.periodic[axis]) add_faces_across(axis);
    }
    trace();
    for (const SidedEdge& sided : edges_) map_.edges.push_back(sided.edge);
    return std::move(map_);
  }

 private:
  using Point = std::array<double, 2>;

  [[nodiscard]] bool on_face(std::size_t base, std::size_t axis) const {
    return t_.box.periodic[axis] && bases_[base][axis] == 0.0;
  }

  std::size_t base_at(const Point& p) {
    const auto [entry, added] = base_numbers_.try_emplace(p, bases_.size());
    if (added) bases_.push_back(p);
    return entry->second;
  }

  // Where a point is, put on the faces of the box that are near.
  Spot spot_at(const Point& p) {
    Spot spot;
    Point inside = p;
    for (std::size_t a = 0; a < 2; ++a) {
      const double near = std::round(p[a] / size_[a]);
      const bool snaps = std::abs(p[a] - near * size_[a]) < kSnap * size_[a];
      if (!t_.box.periodic[a]) {
        if (snaps) inside[a] = near * size_[a];
        continue;
      }
      spot.period[a] = static_cast<int>(snaps ? near : std::floor(p[a] / size_[a]));
      inside[a] = snaps ? 0.0 : p[a] - spot.period[a] * size_[a];
    }
    spot.base = base_at(inside);
    return spot;
  }

  // A vertex is put inside the box once, so that all its images are the same base.
  Spot spot_of(const FacetCorner& corner) {
    const Vec3& at = t_.vertices[static_cast<std::size_t>(corner.vertex)];
    Spot spot = spot_at({at.x, at.y});
    for (std::size_t a = 0; a < 2; ++a) spot.period[a] += corner.image[a];
    return spot;
  }

  [[nodiscard]] double place(const Spot& spot, std::size_t axis) const {
    return bases_[spot.base][axis] + spot.period[axis] * size_[axis];
  }

  // Where the way from a to b passes faces of the box, with the share of the way.
  std::vector<std::pair<double, Spot>> crossings(const Spot& a, const Spot& b) {
    std::vector<std::pair<double, Spot>> found;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!t_.box.periodic[axis]) continue;
      const double from = place(a, axis), to = place(b, axis);
      // Whole periods strictly between: a point on a face has a base of exactly 0 there.
      const Spot &low = from < to ? a : b, &high = from < to ? b : a;
      const int last = high.period[axis] - (on_face(high.base, axis) ? 1 : 0);
      for (int k = low.period[axis] + 1; k <= last; ++k) {
        const double share = (k * size_[axis] - from) / (to - from);
        Point p{place(a, 0) + share * (place(b, 0) - place(a, 0)),
                place(a, 1) + share * (place(b, 1) - place(a, 1))};
        p[axis] = k * size_[axis];
        found.emplace_back(share, spot_at(p));
      }
    }
    std::sort(found.begin(), found.end(),
              [](const auto& p, const auto& q) { return p.first < q.first; });
    return found;
  }

  void cut(const Facet& facet) {
    const FacetCorner* corners = t_.corners.data() + facet.first_corner;
    const Spot last = spot_of(corners[1]);
    Spot from = spot_of(corners[0]);
    for (const auto& [share, to] : crossings(from, last)) {
      add_piece(from, to, facet);
      from = to;
    }
    add_piece(from, last, facet);
  }

  // A piece that lies in one image of the box, brought into the box itself. Pieces in a face are
  // made anew for both sides of the box.
  void add_piece(const Spot& from, const Spot& to, const Facet& facet) {
    if (from == to) return;
    std::array<int, 2> box{};
    for (std::size_t a = 0; a < 2; ++a) {
      if (!t_.box.periodic[a]) continue;
      const bool in_face = on_face(from.base, a) && on_face(to.base, a);
      if (in_face && from.period[a] == to.period[a]) return;
      box[a] = static_cast<int>(std::floor(0.5 * (place(from, a) + place(to, a)) / size_[a]));
    }
    edges_.push_back({{node(from, box), node(to, box)}, facet.inner, facet.outer});
  }

  std::size_t node(const Spot& spot, const std::array<int, 2>& box) {
    return node(spot.base, {spot.period[0] > box[0], spot.period[1] > box[1]});
  }

  // The node of a base at the low or the high faces.
  std::size_t node(std::size_t base, const std::array<bool, 2>& high) {
    const auto [entry, added] = node_numbers_.try_emplace({base, high}, map_.nodes.size());
    if (added) {
      const Point& p = bases_[base];
      map_.nodes.push_back({p[0] + high[0] * size_[0], p[1] + high[1] * size_[1], 0.0});
    }
    return entry->second;
  }

  // The edges of the two faces across a periodic axis, between all points in them.
  void add_faces_across(std::size_t axis) {
    const std::size_t along = 1 - axis;
    std::vector<std::tuple<double, std::size_t, bool>> points;
    for (std::size_t base = 0; base < bases_.size(); ++base) {
      if (!on_face(base, axis)) continue;
      points.emplace_back(bases_[base][along], base, false);
      if (on_face(base, along)) points.emplace_back(size_[along], base, true);
    }
    std::sort(points.begin(), points.end());
    for (std::size_t k = 1; k < points.size(); ++k) {
      const MapEdge low = face_edge(axis, points[k - 1], points[k], false);
      const MapEdge high = face_edge(axis, points[k - 1], points[k], true);
      map_.pairs[axis].push_back({edges_.size(), edges_.size() + 1});
      // On the way up along y the box lies to the right of its low x face; along x it is the left.
      SidedEdge sided_low{low}, sided_high{high};
      (axis == 0 ? sided_low.right : sided_low.left) = kUnknown;
      (axis == 0 ? sided_high.left : sided_high.right) = kUnknown;
      edges_.push_back(sided_low);
      edges_.push_back(sided_high);
    }
  }

  MapEdge face_edge(std::size_t axis, const std::tuple<double, std::size_t, bool>& from,
                    const std::tuple<double, std::size_t, bool>& to, bool high) {
    const auto at = [&](const std::tuple<double, std::size_t, bool>& point) {
      std::array<bool, 2> sides{};
      sides[axis] = high;
      sides[1 - axis] = std::get<2>(point);
      return node(std::get<1>(point), sides);
    };
    return {at(from), at(to)};
  }

  struct TracedLoop {
    std::int32_t cell = kUnknown;
    std::vector<MapStep> steps;
    std::vector<Vec3> points;
    double area = 0.0;
  };

  // Each edge is passed once for each side that is not outside.
  [[nodiscard]] std::vector<TracedLoop> traced_loops() const {
    std::vector<DirectedEdge> directed;
    std::vector<std::pair<MapStep, std::int32_t>> steps;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const SidedEdge& sided = edges_[e];
      const auto add = [&](bool backward, std::int32_t cell) {
        if (cell == Facet::kWall) return;
        directed.push_back(backward ? DirectedEdge{sided.edge.to, sided.edge.from}
                                    : DirectedEdge{sided.edge.from, sided.edge.to});
        steps.push_back({{e, backward}, cell});
      };
      add(false, sided.left);
      add(true, sided.right);
    }
    std::vector<TracedLoop> loops;
    for (const auto& numbers : plane_loops(directed, map_.nodes)) {
      TracedLoop loop;
      for (const std::size_t k : numbers) {
        loop.steps.push_back(steps[k].first);
        loop.points.push_back(map_.nodes[directed[k].from]);
        if (steps[k].second != kUnknown) loop.cell = steps[k].second;
      }
      loop.area = signed_area(loop.points);
      loops.push_back(std::move(loop));
    }
    return loops;
  }

  // Of the outline of the whole box, where no other edge meets it: the cell around the rest.
  [[nodiscard]] std::int32_t cell_at_faces(const std::vector<TracedLoop>& loops) const {
    const TracedLoop* outermost = nullptr;
    double least = size_[0];
    for (const TracedLoop& loop : loops) {
      if (loop.area > 0.0) continue;
      for (const Vec3& p : loop.points) {
        if (p.x < least) outermost = &loop;
        least = std::min(least, p.x);
      }
    }
    return outermost != nullptr ? outermost->cell : t_.facets[0].inner;
  }

  void trace() {
    const std::vector<TracedLoop> loops = traced_loops();
    std::vector<const TracedLoop*> outlines;
    for (const TracedLoop& loop : loops) {
      if (loop.area <= 0.0) continue;
      const std::int32_t cell = loop.cell != kUnknown ? loop.cell : cell_at_faces(loops);
      map_.faces.push_back({cell, loop.area, {loop.steps}});
      outlines.push_back(&loop);
    }
    for (const TracedLoop& hole : loops) {
      if (hole.area > 0.0) continue;
      std::size_t best = map_.faces.size();
      for (std::size_t f = 0; f < outlines.size(); ++f) {
        if (map_.faces[f].cell != hole.cell || !holds(outlines[f]->points, hole.points[0]))
          continue;
        if (best == map_.faces.size() || outlines[f]->area < outlines[best]->area) best = f;
      }
      if (best == map_.faces.size()) continue;
      map_.faces[best].area += hole.area;
      map_.faces[best].loops.push_back(hole.steps);
    }
  }

  const Tessellation& t_;
  std::array<double, 2> size_;
  std::vector<Point> bases_;
  std::map<Point, std::size_t> base_numbers_;
  std::map<std::pair<std::size_t, std::array<bool, 2>>, std::size_t> node_numbers_;
  std::vector<SidedEdge> edges_;
  UnitCellMap map_;
};

}  // namespace

UnitCellMap unit_cell_map(const Tessellation& tessellation) { return Cutter(tessellation).make(); }

}  // namespace packstone
