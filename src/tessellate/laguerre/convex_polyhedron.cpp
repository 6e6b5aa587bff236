#include "tessellate/laguerre/convex_polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace packstone::laguerre {

void ConvexPolyhedron::reset(const Vec3& low, const Vec3& high) {
  corners_.clear();
  planes_ = 6;
  for (int c = 0; c < 8; ++c) {
    const int x = c & 1, y = c >> 1 & 1, z = c >> 2;
    Corner corner{{x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z},
                  {x, 2 + y, 4 + z},
                  // Edge 0 between the planes of x and y runs along z, and so on.
                  {c ^ 4, c ^ 1, c ^ 2}};
    if ((x + y + z) % 2 == 0) {
      // An even number of high faces turns the order about.
      std::swap(corner.planes[1], corner.planes[2]);
      std::swap(corner.across[0], corner.across[2]);
    }
    corners_.push_back(corner);
  }
  measure_radius();
}

bool ConvexPolyhedron::cut(const Vec3& to, double half, std::int32_t plane) {
  const std::size_t n = corners_.size();
  beyond_.resize(n);
  double most = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    beyond_[k] = dot(corners_[k].at, to) - half;
    most = std::max(most, beyond_[k]);
  }
  if (n == 0 || most <= 0.0) return false;
  const double touching = kTouching * std::sqrt(radius_sq_ * norm_sq(to));
  if (most <= touching) return false;
  gone_.resize(n);
  std::size_t stay = 0;
  for (std::size_t k = 0; k < n; ++k) {
    gone_[k] = beyond_[k] > touching ? 1 : 0;
    stay += gone_[k] == 0 ? 1 : 0;
  }
  if (stay == 0) {
    corners_.clear();
    radius_sq_ = 0.0;
    return true;
  }
  if (!add_horizon(plane)) return false;
  link_horizon(n);
  drop_gone();
  measure_radius();
  return true;
}

// One corner on each edge from a corner that goes to one that stays. Returns false, and leaves the
// polyhedron as it was, when the edges close no cycle: rounding has taken corners of one place for
// corners of two.
bool ConvexPolyhedron::add_horizon(std::int32_t plane) {
  const std::size_t n = corners_.size();
  planes_ = std::max(planes_, plane + 1);
  from_.assign(static_cast<std::size_t>(planes_), -1);
  for (std::size_t k = 0; k < n; ++k) {
    if (gone_[k] == 0) continue;
    for (std::size_t e = 0; e < 3; ++e) {
      const Corner goes = corners_[k];
      const auto s = static_cast<std::size_t>(goes.across[e]);
      if (gone_[s] != 0) continue;
      const std::int32_t a = goes.planes[e], b = goes.planes[(e + 1) % 3];
      if (from_[static_cast<std::size_t>(a)] >= 0) {
        corners_.resize(n);
        return false;
      }
      from_[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(corners_.size());
      const double inside = std::max(0.0, -beyond_[s]);
      const Vec3& stays = corners_[s].at;
      const Vec3 at = stays + inside / (inside + beyond_[k]) * (goes.at - stays);
      corners_.push_back({at, {a, b, plane}, {static_cast<std::int32_t>(s), -1, -1}});
    }
  }
  // One cycle through all of them?
  std::size_t steps = 0;
  std::size_t at = n;
  do {
    const std::int32_t next = from_[static_cast<std::size_t>(corners_[at].planes[1])];
    if (next < 0) break;
    at = static_cast<std::size_t>(next);
    ++steps;
  } while (at != n && steps <= corners_.size());
  if (at == n && steps == corners_.size() - n) return true;
  corners_.resize(n);
  return false;
}

void ConvexPolyhedron::link_horizon(std::size_t first) {
  for (std::size_t k = first; k < corners_.size(); ++k) {
    Corner& corner = corners_[k];
    const auto self = static_cast<std::int32_t>(k);
    const std::int32_t next = from_[static_cast<std::size_t>(corner.planes[1])];
    corner.across[1] = next;
    corners_[static_cast<std::size_t>(next)].across[2] = self;
    // The corner that stays has the two planes the other way round.
    Corner& stays = corners_[static_cast<std::size_t>(corner.across[0])];
    stays.across[slot_of(stays.planes, corner.planes[1])] = self;
  }
}

void ConvexPolyhedron::drop_gone() {
  const std::size_t before = gone_.size();
  moved_to_.resize(corners_.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (k < before && gone_[k] != 0) continue;
    moved_to_[k] = static_cast<std::int32_t>(kept);
    if (kept != k) corners_[kept] = corners_[k];
    ++kept;
  }
  corners_.resize(kept);
  for (Corner& corner : corners_) {
    for (std::int32_t& k : corner.across) k = moved_to_[static_cast<std::size_t>(k)];
  }
}

void ConvexPolyhedron::measure_radius() {
  radius_sq_ = 0.0;
  for (const Corner& corner : corners_) radius_sq_ = std::max(radius_sq_, norm_sq(corner.at));
}

void ConvexPolyhedron::find_faces() const {
  corner_on_.assign(static_cast<std::size_t>(planes_), -1);
  for (std::size_t k = corners_.size(); k-- > 0;) {
    for (const std::int32_t p : corners_[k].planes) {
      corner_on_[static_cast<std::size_t>(p)] = static_cast<std::int32_t>(k);
    }
  }
}

bool ConvexPolyhedron::walk_face(std::int32_t plane, std::vector<FacetPoint>& points) const {
  points.clear();
  const std::int32_t begin = corner_on_[static_cast<std::size_t>(plane)];
  for (std::int32_t at = begin; at >= 0;) {
    const Corner& corner = corners_[static_cast<std::size_t>(at)];
    points.push_back({corner.at, corner.planes});
    // Counterclockwise about the face the way leads along the edge before it about the corner.
    at = corner.across[(slot_of(corner.planes, plane) + 2) % 3];
    if (at == begin) break;
  }
  return begin >= 0;
}

CellMoments ConvexPolyhedron::moments() const {
  CellMoments sum;
  for_facets([&](std::int32_t, std::span<const FacetPoint> points) {
    const Vec3& a = points[0].at;
    for (std::size_t k = 2; k < points.size(); ++k) {
      const Vec3 &b = points[k - 1].at, &c = points[k].at;
      const double volume = dot(a, cross(b, c)) / 6.0;
      sum.measure += volume;
      sum.first += volume / 4.0 * (a + b + c);
      sum.second = sum.second + volume / 20.0 * (dyad(a) + dyad(b) + dyad(c) + dyad(a + b + c));
    }
  });
  return sum;
}

}  // namespace packstone::laguerre
