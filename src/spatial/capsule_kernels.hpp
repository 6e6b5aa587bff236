#pragma once

/// @file
/// Which capsules of a chunk meet another one, in lanes. Included by one source per
/// width of registers.

#include <cstdint>

#include "core/lanes.hpp"
#include "spatial/capsule_lanes.hpp"

namespace packstone {
namespace {

PACKSTONE_LANES Single single_of(const float (&numbers)[8]) {
  Single result;
  __builtin_memcpy(&result, numbers, sizeof result);
  return result;
}
PACKSTONE_LANES Single dot(const Single& ax, const Single& ay, const Single& az, const Single& bx,
                           const Single& by, const Single& bz) {
  return ax * bx + ay * by + az * bz;
}

// Bounding balls first; then the capsules, by the plane across the way between the points of their
// segments that come nearest. Those points need not be found exactly: any plane is a proof.
PACKSTONE_LANES unsigned capsules_that_meet(const CapsuleChunk& c, const SeenCapsule& s) {
  const Single x = single_of(c.x) - s.x, y = single_of(c.y) - s.y, z = single_of(c.z) - s.z;
  const Single half = single_of(c.half), radii = single_of(c.radius) + s.radius;
  const Single rr = dot(x, y, z, x, y, z), reach = half + radii + s.half;
  const unsigned present = (1U << static_cast<unsigned>(c.count)) - 1U;
  const unsigned near = bits(rr <= reach * reach) & present;
  if (near == 0) return 0;
  const Single ux = single_of(c.axis_x), uy = single_of(c.axis_y), uz = single_of(c.axis_z);
  const Single vx = Single{} + s.axis_x, vy = Single{} + s.axis_y, vz = Single{} + s.axis_z;
  const Single cosine = dot(ux, uy, uz, vx, vy, vz);
  const Single along_own = dot(x, y, z, vx, vy, vz), along = dot(x, y, z, ux, uy, uz);
  const Single sine_sq = 1.0F - cosine * cosine;
  const Single own_half = Single{} + s.half;
  const Single denominator = sine_sq > 1e-6F ? sine_sq : Single{} + 1e-6F;
  const Single first = within((along_own - cosine * along) / denominator, own_half);
  const Single there = within(cosine * first - along, half);
  const Single here = within(along_own + cosine * there, own_half);
  const Single dx = x + there * ux - here * vx, dy = y + there * uy - here * vy,
               dz = z + there * uz - here * vz;
  const Single apart = dot(dx, dy, dz, x, y, z) - half * magnitude(dot(dx, dy, dz, ux, uy, uz)) -
                       own_half * magnitude(dot(dx, dy, dz, vx, vy, vz));
  const Single dd = dot(dx, dy, dz, dx, dy, dz);
  return near & ~bits((apart > 0.0F) & (apart * apart > radii * radii * dd));
}

}  // namespace
}  // namespace packstone
