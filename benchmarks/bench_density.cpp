// measure_density() of bodies of every shape, thrown into a cell with walls across all axes, or
// with walls across the vertical one alone. They overlap, which costs nothing.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/measure/density.hpp"
#include "packstone/structure/standing.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using benchmarks::processor_seconds;

Body body_of(ShapeKind shape, RandomStream& random) {
  switch (shape) {
    case ShapeKind::sphere:
      return Sphere{1.0};
    case ShapeKind::ellipsoid:
      return Ellipsoid{{2.0, 1.0, 1.0}, random_rotation(random)};
    case ShapeKind::cylinder:
      return Cylinder{1.0, 5.0, random_direction(random)};
    case ShapeKind::spherocylinder:
      return Spherocylinder{1.0, 5.0, random_direction(random)};
    case ShapeKind::disk:
      return Disk{1.0};
    case ShapeKind::ellipse:
      break;
  }
  return Ellipse{{2.0, 1.0}, random.uniform(0.0, 6.0)};
}

// A square or cube that `count` of them fill to 0.8, or 0.6 in space.
Cell cell_for(ShapeKind shape, std::int64_t count, bool periodic) {
  RandomStream random(1, StreamId::benchmark);
  const double total = static_cast<double>(count) * volume(body_of(shape, random));
  if (dimension(shape) == 2) {
    const double edge = std::sqrt(total / 0.8);
    return cell_2d(edge, edge, periodic, false);
  }
  const double edge = std::cbrt(total / 0.6);
  return {3, {edge, edge, edge}, {periodic, periodic, false}};
}

Packing thrown(ShapeKind shape, std::int64_t count, bool periodic) {
  Packing packing{cell_for(shape, count, periodic), {"bodies"}, {}, {}, {}};
  RandomStream random(1, StreamId::benchmark);
  for (std::int64_t k = 0; k < count; ++k) {
    const Body body = body_of(shape, random);
    const CenterBox box = centers_inside_walls(packing.cell, half_extents(body));
    const Vec3 center{random.uniform(box.lo.x, box.hi.x), random.uniform(box.lo.y, box.hi.y),
                      random.uniform(box.lo.z, box.hi.z)};
    packing.inclusions.push_back({center, body, 0});
  }
  return packing;
}

void report(ShapeKind shape, std::int64_t count, bool periodic) {
  const Packing packing = thrown(shape, count, periodic);
  const double before = processor_seconds();
  const DensityReport measured = measure_density(packing);
  fmt::print("| {} | {} | {} | {:.2f} | {:.10f} | {:.1g} |\n", name(shape), count,
             periodic ? "one axis" : "all axes", processor_seconds() - before,
             measured.interior->fraction.value, measured.interior->fraction.error);
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t count = argc > 1 ? std::atoll(argv[1]) : 100'000;
  fmt::print("| shape | count | walls across | CPU s | interior | error |\n");
  for (const ShapeKind shape :
       {ShapeKind::disk, ShapeKind::ellipse, ShapeKind::sphere, ShapeKind::ellipsoid,
        ShapeKind::cylinder, ShapeKind::spherocylinder}) {
    for (const bool periodic : {true, false}) report(shape, count, periodic);
  }
}
