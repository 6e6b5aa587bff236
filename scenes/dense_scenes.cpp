// Packings made without a generator of the library, so that they can serve to judge the check.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"
#include "packstone/spatial/separation.hpp"
#include "scenes.hpp"

namespace packstone::scenes {
namespace {

constexpr double kStretch = 2.0;  // Of the ellipsoids, and of the lattice along z.
constexpr int kSweeps = 10;
constexpr double kMaxDrift = 0.5;  // From the lattice site, in short semi-axes.

struct Lattice {
  int n[3] = {1, 1, 1};
  double nearest = 0.0;  // Distance of neighbors where the stretch along z is undone.
};

// Face-centered: nearest neighbors at half a face diagonal, or at an edge where cells are flat.
double nearest_neighbors(const int (&n)[3]) {
  const double e[3] = {1.0 / n[0], 1.0 / n[1], 1.0 / (kStretch * n[2])};
  return std::min({e[0], e[1], e[2], 0.5 * std::hypot(e[0], e[1]), 0.5 * std::hypot(e[0], e[2]),
                   0.5 * std::hypot(e[1], e[2])});
}

// The roomiest face-centered lattice of the unit cube with at least `count` sites.
Lattice roomiest_lattice(std::int64_t count) {
  Lattice best;
  const int most = 2 + static_cast<int>(1.3 * std::cbrt(static_cast<double>(count)));
  for (int x = 1; x <= most; ++x) {
    for (int y = x; y <= most; ++y) {
      const std::int64_t per_layer = std::int64_t{4} * x * y;
      Lattice lattice{{x, y, static_cast<int>((count + per_layer - 1) / per_layer)}, 0.0};
      lattice.nearest = nearest_neighbors(lattice.n);
      if (lattice.nearest > best.nearest) best = lattice;
    }
  }
  return best;
}

Vec3 site(const Lattice& lattice, std::int64_t k) {
  constexpr Vec3 basis[4] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  const Vec3 offset = basis[k % 4];
  const std::int64_t cell = k / 4;
  const double x = static_cast<double>(cell % lattice.n[0]);
  const double y = static_cast<double>(cell / lattice.n[0] % lattice.n[1]);
  const double z = static_cast<double>(cell / lattice.n[0] / lattice.n[1]);
  return unscale(Vec3{x, y, z} + offset,
                 {double(lattice.n[0]), double(lattice.n[1]), double(lattice.n[2])});
}

bool apart(const Cell& cell, const Inclusion& a, const Inclusion& b,
           const std::array<int, 3>& image) {
  const Separation at = separation(cell, a.center, b.center, image);
  return overlap(a.body, b.body, at.r_ab, at.error) == Verdict::separated;
}

// The nearest image of b; enough where bodies are small against the cell.
bool apart(const Cell& cell, const Inclusion& a, const Inclusion& b) {
  std::array<int, 3> image{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image[axis] = static_cast<int>(std::lround(a.center[axis] - b.center[axis]));
  }
  return apart(cell, a, b, image);
}

using NeighborLists = std::vector<std::vector<std::int32_t>>;

// Who may meet whom while all stay within their drift.
NeighborLists neighbor_lists(const Packing& packing, double reach) {
  HierarchicalGrid grid(packing.cell);
  const Vec3 half{reach, reach, reach};
  const auto& all = packing.inclusions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    grid.insert(static_cast<std::int32_t>(i), all[i].center, half);
  }
  NeighborLists lists(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    grid.query(all[i].center, half, 0.0, [&](std::int32_t j, const std::array<int, 3>& image) {
      const Vec3 r = separation(packing.cell, all[i].center, all[j].center, image).r_ab;
      if (static_cast<std::size_t>(j) != i && norm(r) <= 2.0 * reach) lists[i].push_back(j);
      return true;
    });
  }
  return lists;
}

Inclusion nudged(const Inclusion& inclusion, double step, RandomStream& random) {
  const auto& body = std::get<Ellipsoid>(inclusion.body);
  const Vec3 move{random.uniform(-step, step), random.uniform(-step, step),
                  random.uniform(-step, step)};
  const Quaternion turn = from_axis_angle(random_direction(random), random.uniform(0.0, 0.1));
  const Vec3 center = inclusion.center + move;
  return {wrapped(Cell{}, center), Ellipsoid{body.semi_axes, normalized(turn * body.orientation)},
          inclusion.group};
}

void shake(Packing& packing, double short_axis, std::uint64_t seed) {
  const std::vector<Inclusion> sites = packing.inclusions;
  const NeighborLists lists = neighbor_lists(packing, (kStretch + kMaxDrift) * short_axis);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      RandomStream random(seed, StreamId::benchmark, i, static_cast<std::uint64_t>(sweep));
      const Inclusion trial = nudged(packing.inclusions[i], 0.15 * short_axis, random);
      Vec3 drift = trial.center - sites[i].center;
      for (std::size_t axis = 0; axis < 3; ++axis) drift[axis] -= std::round(drift[axis]);
      const bool fits = norm(drift) <= kMaxDrift * short_axis &&
                        std::all_of(lists[i].begin(), lists[i].end(), [&](std::int32_t j) {
                          return apart(packing.cell, trial, packing.inclusions[j]);
                        });
      if (fits) packing.inclusions[i] = trial;
    }
  }
}

// Throws bodies into the unit cube until each stands where it meets nobody.
Packing thrown(const std::vector<Body>& bodies, const char* group, std::uint64_t seed) {
  Packing packing;
  packing.groups = {group};
  HierarchicalGrid grid(packing.cell);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec3 half = half_extents(bodies[i]);
    for (std::uint64_t trial = 0;; ++trial) {
      RandomStream random(seed, StreamId::benchmark, i, trial);
      const Inclusion next{{random.uniform(), random.uniform(), random.uniform()}, bodies[i], 0};
      const bool fits =
          grid.query(next.center, half, 0.0, [&](std::int32_t j, const std::array<int, 3>& image) {
            return apart(packing.cell, next, packing.inclusions[j], image);
          });
      if (!fits) continue;
      grid.insert(static_cast<std::int32_t>(i), next.center, half);
      packing.inclusions.push_back(next);
      break;
    }
  }
  return packing;
}

std::vector<Body> filling(std::vector<Body> bodies, double fraction) {
  double sum = 0.0;
  for (const Body& body : bodies) sum += volume(body);
  const double factor = std::cbrt(fraction / sum);
  for (Body& body : bodies) body = scaled(body, factor);
  return bodies;
}

}  // namespace

Packing jostled_ellipsoids(std::int64_t count, double fraction, std::uint64_t seed) {
  const double each = fraction / static_cast<double>(count);
  const double r = std::cbrt(each / (4.0 / 3.0 * std::numbers::pi * kStretch));
  const Lattice lattice = roomiest_lattice(count);
  if (!(2.0 * r < lattice.nearest)) {
    throw InvalidArgument("fraction = " + std::to_string(fraction) + " leaves a lattice of " +
                          std::to_string(count) + " ellipsoids no room");
  }
  Packing packing;
  packing.groups = {"ellipsoids"};
  const std::int64_t sites = std::int64_t{4} * lattice.n[0] * lattice.n[1] * lattice.n[2];
  for (std::int64_t k = 0; k < count; ++k) {
    const Ellipsoid body{{r, r, kStretch * r}, {}};
    packing.inclusions.push_back({site(lattice, k * sites / count), body, 0});
  }
  shake(packing, r, seed);
  return packing;
}

Packing polydisperse_spheres(std::int64_t count, double fraction, std::uint64_t seed) {
  std::vector<double> radii;
  for (std::int64_t i = 0; i < count; ++i) {
    // Quantiles of the density r^-3.5 between 1 and 1000.
    const double p = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    radii.push_back(std::pow(p + (1.0 - p) * std::pow(1000.0, -2.5), -0.4));
  }
  std::vector<Body> bodies;
  for (const double radius : radii) bodies.push_back(Sphere{radius});
  return thrown(filling(std::move(bodies), fraction), "spheres", seed);
}

Packing needles(std::int64_t count, double fraction, std::uint64_t seed) {
  std::vector<Body> bodies;
  for (std::int64_t i = 0; i < count; ++i) {
    RandomStream random(seed, StreamId::benchmark, static_cast<std::uint64_t>(i), ~0ULL);
    bodies.push_back(Spherocylinder{1.0, 100.0, random_direction(random)});
  }
  return thrown(filling(std::move(bodies), fraction), "needles", seed);
}

}  // namespace packstone::scenes
