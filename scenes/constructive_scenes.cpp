#include "constructive_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"
#include "packstone/structure/distribution.hpp"

namespace packstone::scenes {
namespace {

double lognormal_radius(double sigma, double ratio, std::uint64_t seed, std::int64_t k) {
  if (sigma == 0.0) return 1.0;
  const Distribution law{LognormalLaw{
      .mu = 0.0, .sigma = sigma, .min = 1.0 / std::sqrt(ratio), .max = std::sqrt(ratio)}};
  return draw(law, 1, seed, StreamId::sizes, 0, 3, k).front();
}

OrderedBody ball(int dimension, double radius) {
  return dimension == 2 ? OrderedBody{Disk{radius}, 0} : OrderedBody{Sphere{radius}, 0};
}

// Where the window ends: below `top` of what stands.
double highest_top(const Packing& packing, std::size_t up) {
  double top = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    top = std::max(top, inclusion.center[up] + half_extents(inclusion.body)[up]);
  }
  return top;
}

// Does a body hold the point?
bool is_covered(const Packing& packing, const HierarchicalGrid& grid, const Vec3& point) {
  const double tiny = 1e-9 * packing.cell.size.x;
  const Body dot = packing.cell.dimension == 2 ? Body{Disk{tiny}} : Body{Sphere{tiny}};
  return !grid.query(point, {}, 0.0, [&](std::int32_t id, const auto& image) {
    const Inclusion& body = packing.inclusions[id];
    const Vec3 r = body.center + image_shift(packing.cell, image) - point;
    return overlap(dot, body.body, r) == Verdict::separated;
  });
}

}  // namespace

BodySource lognormal_balls(int dimension, double sigma, double ratio, std::uint64_t seed) {
  return [=](std::int64_t k) { return ball(dimension, lognormal_radius(sigma, ratio, seed, k)); };
}

BodySource normal_balls(int dimension, double ratio, std::uint64_t seed) {
  const Distribution law{
      NormalLaw{.mean = 0.5 * (1.0 + ratio), .std = (ratio - 1.0) / 6.0, .min = 1.0, .max = ratio}};
  return [=](std::int64_t k) {
    return ball(dimension, draw(law, 1, seed, StreamId::sizes, 0, 3, k).front());
  };
}

BodySource bimodal_balls(int dimension, double ratio, std::uint64_t seed) {
  const auto mode = [&](double part) {
    return Distribution{NormalLaw{
        .mean = 1.0 + part * (ratio - 1.0), .std = 0.08 * (ratio - 1.0), .min = 1.0, .max = ratio}};
  };
  const Distribution law{MixtureLaw{.parts = {mode(0.25), mode(0.75)}, .weights = {1.0, 1.0}}};
  return [=](std::int64_t k) {
    return ball(dimension, draw(law, 1, seed, StreamId::sizes, 0, 3, k).front());
  };
}

BodySource uniform_ellipses(double aspect, double area_ratio, std::uint64_t seed) {
  return [=](std::int64_t k) {
    RandomStream random(seed, StreamId::sizes, static_cast<std::uint64_t>(k));
    const double area = random.uniform(1.0, area_ratio);
    const double b = std::sqrt(area / (std::numbers::pi * aspect));
    return OrderedBody{Ellipse{{aspect * b, b}, random.uniform(0.0, std::numbers::pi)}, 0};
  };
}

BodySource aligned_ellipses(double aspect, double area_ratio, double deviation,
                            std::uint64_t seed) {
  constexpr double kPi = std::numbers::pi;
  const Distribution law{
      NormalLaw{.mean = 0.0, .std = deviation * kPi / 180.0, .min = -0.5 * kPi, .max = 0.5 * kPi}};
  const BodySource uniform = uniform_ellipses(aspect, area_ratio, seed);
  return [=](std::int64_t k) {
    OrderedBody ordered = uniform(k);
    const double angle = draw(law, 1, seed, StreamId::orientations, 0, 1, k).front();
    std::get<Ellipse>(ordered.body).angle = angle < 0.0 ? angle + kPi : angle;
    return ordered;
  };
}

BodySource prolate_ellipsoids(double aspect, double sigma, std::uint64_t seed) {
  return [=](std::int64_t k) {
    RandomStream random(seed, StreamId::orientations, static_cast<std::uint64_t>(k));
    const double size = sigma == 0.0 ? 1.0 : lognormal_radius(sigma, std::exp(6 * sigma), seed, k);
    return OrderedBody{Ellipsoid{{aspect * size, size, size}, random_rotation(random)}, 0};
  };
}

Cell cell_for(const BodySource& supply, std::int64_t count, double fraction, bool periodic) {
  double total = 0.0;
  for (std::int64_t k = 0; k < count; ++k) total += volume(supply(k).body);
  const int dimension = packstone::dimension(kind(supply(0).body));
  if (dimension == 2) {
    const double edge = std::sqrt(total / fraction);
    return cell_2d(edge, edge, periodic, false);
  }
  const double edge = std::cbrt(total / fraction);
  return {3, {edge, edge, edge}, {periodic, periodic, false}};
}

double interior_fraction(const Packing& packing, double margin) {
  const Cell& cell = packing.cell;
  const auto up = static_cast<std::size_t>(cell.dimension - 1);
  HierarchicalGrid grid(cell);
  grid.reserve(static_cast<std::int64_t>(packing.inclusions.size()));
  for (std::size_t k = 0; k < packing.inclusions.size(); ++k) {
    grid.insert(static_cast<std::int32_t>(k), packing.inclusions[k].center,
                half_extents(packing.inclusions[k].body));
  }
  Vec3 lo, hi;
  for (std::size_t a = 0; a <= up; ++a) {
    const bool walls = !cell.periodic[a];
    lo[a] = walls ? margin : 0.0;
    hi[a] = a == up ? highest_top(packing, up) - 2.0 * margin : cell.size[a] - lo[a];
  }
  constexpr std::int64_t kPoints = 1 << 18;
  RandomStream random(1, StreamId::benchmark);
  std::int64_t covered = 0;
  for (std::int64_t k = 0; k < kPoints; ++k) {
    Vec3 point;
    for (std::size_t a = 0; a <= up; ++a) point[a] = random.uniform(lo[a], hi[a]);
    covered += is_covered(packing, grid, point) ? 1 : 0;
  }
  return static_cast<double>(covered) / static_cast<double>(kPoints);
}

}  // namespace packstone::scenes
