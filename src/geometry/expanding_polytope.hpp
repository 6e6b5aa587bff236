#pragma once

/// @file
/// How deep does r lie inside M (minkowski_sum.hpp)? Proven from inside and from outside.
///
/// A polytope with corners on M grows towards its support planes. With n_f the outward unit normal
/// of face f and v its corners,
///
///     min_f min_v n_f.(v - r)  <=  depth  <=  min over the normals tried of S_M(n) - n.r    (1)
///
/// The left side holds for any closed surface of outward facing triangles, convex or not: a point x
/// of a triangle has |x - r| >= n.(x - r) >= min_v n.(v - r), and when these are all positive the
/// surface winds around r, so the ball of that radius about r lies in the hull of the corners.
/// Rounding can therefore only widen the bracket.
///
/// Reference: G. van den Bergen, "Proximity queries and penetration depth computation on 3D game
/// objects", Game Developers Conference 2001. Ours differs in starting from the octahedron of three
/// support points and their opposites (M is symmetric), which holds the center for certain, and in
/// reporting both sides of (1).

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "geometry/gjk.hpp"
#include "geometry/minkowski_sum.hpp"

namespace packstone {

/// Bounds on the depth of r in M, with the face that carries the inner one.
struct Depth {
  double inner = 0.0;  ///< Lower bound, as evaluated [L]; <= 0: none.
  double outer = std::numeric_limits<double>::infinity();  ///< Upper bound, as evaluated [L].
  Vec3 normal;                                             ///< Unit, attains `outer`.
  Vec3 in_a;  ///< Point of a next to the surface, relative to its center [L].
  double miss = std::numeric_limits<double>::infinity();  ///< Distance of r from a point of M [L].
};

/// The growing polytope. Fixed storage: no allocation, bounded work.
class ExpandingPolytope {
 public:
  /// Corners at most; faces then number twice as many.
  static constexpr int kCorners = 640;

  ExpandingPolytope(const Vec3& r, double size) : r_(r), thin_(8 * kUnitRoundoff * size) {}

  /// Starts from the octahedron of three points of M and their opposites, det > 0.
  void start(const SumPoint& x, const SumPoint& y, const SumPoint& z) {
    for (const SumPoint& p : {x, y, z}) {
      add_corner(p);
      add_corner({-p.in_a, -p.in_b, -p.sum});
    }
    static constexpr int kOctahedron[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                              {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (const auto& f : kOctahedron) add_face(f[0], f[1], f[2]);
    for (int f = 0; f < 8; ++f) {
      for (int e = 0; e < 3; ++e)
        faces_[f].across[e] = face_with_edge(corner(f, e + 1), corner(f, e));
    }
  }

  /// The living face with the least inner bound; -1 when none is left.
  int nearest_face() {
    while (heap_size_ > 0) {
      if (!is_stale(heap_[0])) return heap_[0].face;
      std::pop_heap(heap_.begin(), heap_.begin() + heap_size_, Farther{});
      --heap_size_;
    }
    return -1;
  }

  const Vec3& normal(int face) const { return faces_[face].normal; }
  /// The inner bound of the whole surface when `face` is the nearest one.
  double inner(int face) const { return faces_[face].inner - (has_thin_ ? thin_ : 0.0); }

  /// Adds the corner `tip`, which lies beyond `face`. False when storage or rounding forbids it.
  bool expand(int face, const SumPoint& tip) {
    if (corner_count_ == kCorners) return false;
    const int w = add_corner(tip);
    horizon_size_ = 0;
    depth_ = 0;
    faces_[face].alive = false;
    dead_size_ = 0;
    dead_[dead_size_++] = face;
    bool whole = true;
    for (int e = 0; e < 3; ++e) whole = walk(faces_[face].across[e], face, tip.sum) && whole;
    if (!whole || !horizon_closed()) return false;
    if (heap_size_ + horizon_size_ > kHeap) drop_stale_entries();
    return cover(w);
  }

  /// The point of the face next to r: its part of a, and its distance from r.
  void locate(int face, Depth& depth) const {
    const Face& f = faces_[face];
    Simplex s;
    for (int i = 0; i < 3; ++i) {
      s.corner[i] = corners_[f.corner[i]];
      s.offset[i] = s.corner[i].sum - r_;
    }
    const Nearest nearest = detail::nearest_on_triangle(s, 0, 1, 2);
    depth.in_a = Vec3{};
    Vec3 offset;
    for (int i = 0; i < 3; ++i) {
      depth.in_a += nearest.weight[i] * s.corner[i].in_a;
      offset += nearest.weight[i] * s.offset[i];
    }
    depth.miss = norm(offset);
  }

  /// Of the faces towards `normal` with an inner bound of at most `limit`: one that the
  /// perpendicular from r meets. Flat parts of M are many faces with one bound. -1: none.
  int face_at_foot(const Vec3& direction, double limit) const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < face_count_; ++f) {
      if (!faces_[f].alive || !(faces_[f].inner <= limit)) continue;
      if (dot(faces_[f].normal, direction) < 1.0 - 1e-9) continue;
      const Vec3 p = nearest_point(f);
      if (norm_sq(p) < least) least = norm_sq(p), best = f;
    }
    return best;
  }

 private:
  static constexpr int kFaces = 2 * kCorners;
  static constexpr int kHeap = 8 * kCorners;
  static constexpr int kHorizon = 256;

  struct Face {
    int corner[3];
    int across[3];  // face over the edge corner[e], corner[e + 1]
    Vec3 normal;    // unit
    double inner;   // min over the corners of normal.(v - r)
    std::int32_t born;
    bool alive;
  };
  struct Entry {
    double inner;
    int face;
    std::int32_t born;
  };
  struct Farther {
    bool operator()(const Entry& a, const Entry& b) const { return a.inner > b.inner; }
  };
  struct Edge {
    int from, to, beyond;
  };

  int corner(int face, int e) const { return faces_[face].corner[e % 3]; }

  bool is_stale(const Entry& entry) const {
    return !faces_[entry.face].alive || faces_[entry.face].born != entry.born;
  }

  // Living faces are far fewer than the heap holds, so that afterwards there is room.
  void drop_stale_entries() {
    static_assert(kFaces + kHorizon <= kHeap);
    const auto end = std::remove_if(heap_.begin(), heap_.begin() + heap_size_,
                                    [&](const Entry& entry) { return is_stale(entry); });
    heap_size_ = static_cast<int>(end - heap_.begin());
    std::make_heap(heap_.begin(), end, Farther{});
  }

  int add_corner(const SumPoint& p) {
    corners_[corner_count_] = p;
    return corner_count_++;
  }

  int add_face(int a, int b, int c) {
    int f;
    if (free_size_ > 0) {
      f = free_[--free_size_];
    } else if (face_count_ < kFaces) {
      f = face_count_++;
    } else {
      return -1;
    }
    Face& face = faces_[f];
    face = {{a, b, c}, {-1, -1, -1}, {}, 0.0, births_++, true};
    measure(face);
    heap_[heap_size_++] = {face.inner, f, face.born};
    std::push_heap(heap_.begin(), heap_.begin() + heap_size_, Farther{});
    return f;
  }

  // Normal from the two shorter edges, which keeps slivers accurate. A face thinner than rounding
  // gets no bound: its points lie within thin_ of its longest edge, which the neighbor bounds.
  void measure(Face& face) {
    const Vec3 p[3] = {corners_[face.corner[0]].sum - r_, corners_[face.corner[1]].sum - r_,
                       corners_[face.corner[2]].sum - r_};
    const Vec3 e[3] = {p[1] - p[0], p[2] - p[1], p[0] - p[2]};
    const double l[3] = {norm_sq(e[0]), norm_sq(e[1]), norm_sq(e[2])};
    const int longest = l[0] > l[1] ? (l[0] > l[2] ? 0 : 2) : (l[1] > l[2] ? 1 : 2);
    const int first = (longest + 1) % 3, second = (longest + 2) % 3;
    const Vec3 n = cross(e[first], e[second]);
    const double n_sq = norm_sq(n);
    if (!(n_sq > thin_ * thin_ * l[longest])) {
      face.inner = std::numeric_limits<double>::infinity();
      has_thin_ = true;
      return;
    }
    face.normal = n / std::sqrt(n_sq);
    face.inner = std::min({dot(face.normal, p[0]), dot(face.normal, p[1]), dot(face.normal, p[2])});
  }

  Vec3 nearest_point(int face) const {
    Simplex s;
    for (int i = 0; i < 3; ++i) s.offset[i] = corners_[faces_[face].corner[i]].sum - r_;
    return detail::nearest_on_triangle(s, 0, 1, 2).point;
  }

  int face_with_edge(int from, int to) const {
    for (int f = 0; f < face_count_; ++f) {
      for (int e = 0; e < 3; ++e) {
        if (corner(f, e) == from && corner(f, e + 1) == to) return f;
      }
    }
    return -1;
  }

  int edge_towards(int face, int other_from, int other_to) const {
    for (int e = 0; e < 3; ++e) {
      if (corner(face, e) == other_to && corner(face, e + 1) == other_from) return e;
    }
    return -1;
  }

  bool sees(int face, const Vec3& w) const {
    const Face& f = faces_[face];
    if (!(f.inner < std::numeric_limits<double>::infinity())) return true;
    return dot(f.normal, w - corners_[f.corner[0]].sum) > 0.0;
  }

  // Kills the faces that see w, depth first, and lists the edges beyond which they do not, in turn.
  bool walk(int face, int from_face, const Vec3& w) {
    if (!faces_[face].alive) return true;
    int entry = -1;
    for (int e = 0; e < 3; ++e) {
      if (faces_[face].across[e] == from_face) entry = e;
    }
    if (entry < 0) return false;
    if (depth_ == kHorizon) return false;
    if (!sees(face, w)) {
      if (horizon_size_ == kHorizon) return false;
      horizon_[horizon_size_++] = {corner(face, entry + 1), corner(face, entry), face};
      return true;
    }
    faces_[face].alive = false;
    if (dead_size_ == kHorizon) return false;
    dead_[dead_size_++] = face;
    ++depth_;
    const bool first = walk(faces_[face].across[(entry + 1) % 3], face, w);
    const bool second = first && walk(faces_[face].across[(entry + 2) % 3], face, w);
    --depth_;
    return second;
  }

  bool horizon_closed() const {
    if (horizon_size_ < 3) return false;
    for (int i = 0; i < horizon_size_; ++i) {
      if (horizon_[i].to != horizon_[(i + 1) % horizon_size_].from) return false;
    }
    return true;
  }

  // The fan from w to the horizon.
  bool cover(int w) {
    for (int i = 0; i < dead_size_; ++i) free_[free_size_++] = dead_[i];
    int made[kHorizon];
    for (int i = 0; i < horizon_size_; ++i) {
      const Edge& edge = horizon_[i];
      made[i] = add_face(edge.from, edge.to, w);
      const int e = edge_towards(edge.beyond, edge.from, edge.to);
      if (made[i] < 0 || e < 0) return false;
      faces_[made[i]].across[0] = edge.beyond;
      faces_[edge.beyond].across[e] = made[i];
    }
    for (int i = 0; i < horizon_size_; ++i) {
      faces_[made[i]].across[1] = made[(i + 1) % horizon_size_];
      faces_[made[i]].across[2] = made[(i + horizon_size_ - 1) % horizon_size_];
    }
    return true;
  }

  Vec3 r_;
  double thin_;  // height below which a face counts as an edge [L]
  bool has_thin_ = false;
  std::array<SumPoint, kCorners> corners_;
  std::array<Face, kFaces> faces_;
  std::array<Entry, kHeap> heap_;
  std::array<int, kFaces> free_;
  std::array<Edge, kHorizon> horizon_;
  std::array<int, kHorizon> dead_;
  int corner_count_ = 0;
  int face_count_ = 0;
  int heap_size_ = 0;
  int free_size_ = 0;
  int horizon_size_ = 0;
  int dead_size_ = 0;
  int depth_ = 0;
  std::int32_t births_ = 0;
};

/// Brackets the depth of r in M until the bracket is within `tolerance` [L] or storage is used up.
/// Ends with outer <= 0 when r turns out to lie outside.
template <class Sum>
Depth search_depth(const Sum& sum, const Vec3& r, double tolerance) {
  const SumPoint x = sum.support(norm_sq(r) > 0.0 ? r : Vec3{1, 0, 0});
  const SumPoint y = sum.support(any_perpendicular(normalized(x.sum)));
  const SumPoint z = sum.support(cross(x.sum, y.sum));
  ExpandingPolytope polytope(r, norm(r) + sum.circum_radius());
  polytope.start(x, y, z);
  Depth depth;
  for (;;) {
    const int face = polytope.nearest_face();
    if (face < 0) return depth;
    const double inner = polytope.inner(face);
    const Vec3 normal = polytope.normal(face);
    const SumPoint tip = sum.support(normal);
    const double outer = dot(normal, tip.sum - r);
    if (outer < depth.outer) {
      depth.outer = outer;
      depth.normal = normal;
      polytope.locate(face, depth);
    }
    depth.inner = inner;
    const bool closed = depth.outer - inner <= tolerance || depth.outer <= 0.0;
    if (closed || outer <= inner) {
      const int foot = polytope.face_at_foot(depth.normal, depth.outer + tolerance);
      if (foot >= 0) polytope.locate(foot, depth);
      return depth;
    }
    if (!polytope.expand(face, tip)) return depth;
  }
}

}  // namespace packstone
