#include <string>
#include <utility>

#include "generate/rsa/equal_balls.hpp"
#include "packstone/core/error.hpp"
#include "packstone/generate/rsa.hpp"

namespace packstone {

RsaResult rsa_saturate(const Cell& cell, double radius, const RsaOptions& options, RunContext run) {
  if (options.max_trials < 1) {
    throw InvalidArgument("max_trials = " + std::to_string(options.max_trials) +
                          ", allowed is >= 1");
  }
  rsa::EqualBallsRun balls = rsa::rsa_equal_balls(
      {.cell = cell, .radius = radius, .min_gap = options.min_gap, .seed = options.seed},
      std::move(run));
  RsaResult result;
  result.stop = balls.stop;
  result.trials = balls.trials;
  result.packing.cell = cell;
  result.packing.groups = {cell.dimension == 2 ? "disks" : "spheres"};
  const Body body = cell.dimension == 2 ? Body(Disk{radius}) : Body(Sphere{radius});
  result.packing.inclusions.reserve(balls.centers.size());
  for (const Vec3& center : balls.centers) {
    result.packing.inclusions.push_back({.center = center, .body = body, .group = 0});
  }
  return result;
}

}  // namespace packstone
