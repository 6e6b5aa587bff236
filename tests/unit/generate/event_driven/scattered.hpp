#pragma once

/// @file
/// Bodies scattered over a cell, overlapping or not: what lists of neighbors have to cope with.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "movers.hpp"

namespace packstone::movers {

/// How they are drawn.
struct Scattering {
  const char* label;
  Cell cell{};
  int count = 50;
  std::vector<ShapeKind> shapes;         ///< In turn.
  double smallest = 0.1, largest = 0.1;  ///< Circumscribed radius [L].
  double aspect = 0.0;                   ///< Of spheroids and rods; 0: as the zoo draws them.
  double growth = 0.0;
  double min_gap = 0.0;
};

inline Body shaped(ShapeKind shape, double aspect, zoo::Zoo& zoo) {
  if (aspect == 0.0) return zoo.body(shape, 1.0);
  switch (shape) {
    case ShapeKind::cylinder:
      return Cylinder{1.0, aspect, zoo.direction(3)};
    case ShapeKind::spherocylinder:
      return Spherocylinder{1.0, aspect, zoo.direction(3)};
    case ShapeKind::ellipse:
      return Ellipse{{aspect, 1.0}, zoo.uniform(-3, 3)};
    default:
      return spheroid(aspect, zoo.rotation());
  }
}

inline Body of_reach(const Body& body, double reach) {
  return scaled(body, reach / circum_radius(body));
}

inline Scene scattered(const Scattering& s, std::uint64_t seed) {
  zoo::Zoo zoo(seed);
  Scene scene;
  scene.cell = s.cell;
  scene.growth = s.growth;
  scene.min_gap = s.min_gap;
  for (int k = 0; k < s.count; ++k) {
    const ShapeKind shape = s.shapes[static_cast<std::size_t>(k) % s.shapes.size()];
    const double aspect = is_round(shape) ? 0.0 : s.aspect;
    Mover m;
    m.body = of_reach(shaped(shape, aspect, zoo), zoo.log_uniform(s.smallest, s.largest));
    for (std::size_t a = 0; a < static_cast<std::size_t>(s.cell.dimension); ++a) {
      // A few periods away from the cell: centers are not wrapped in a run.
      const double periods = s.cell.periodic[a] ? std::floor(zoo.uniform(-2, 3)) : 0.0;
      m.center[a] = s.cell.size[a] * (periods + zoo.uniform(0, 1));
    }
    m.velocity = zoo.uniform(0, 1) * zoo.direction(s.cell.dimension);
    m.angular = visible_turn(m.body, zoo.uniform(0, 2) * zoo.direction(3));
    scene.movers.push_back(m);
  }
  return scene;
}

/// Calls visit(image) for all images by which two come within `reach` of each other, r from center
/// to center without.
template <class Visit>
void for_images_within(const Cell& cell, const Vec3& r, double reach, const Visit& visit) {
  std::array<int, 3> first{}, last{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (!cell.periodic[a]) continue;
    first[a] = static_cast<int>(std::floor((-reach - r[a]) / cell.size[a]));
    last[a] = static_cast<int>(std::ceil((reach - r[a]) / cell.size[a]));
  }
  for (int x = first[0]; x <= last[0]; ++x) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int z = first[2]; z <= last[2]; ++z) visit(std::array<int, 3>{x, y, z});
    }
  }
}

}  // namespace packstone::movers
