// Constructive methods: time, density of the whole cell and of its interior, hash.
//
//   bench_constructive drops [count] [seeds]               disks, several k
//   bench_constructive drop dimension sigma ratio count k [periodic] [seeds]
//
// Times are processor times of the call alone; densities and times are medians over the seeds.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "constructive_scenes.hpp"
#include "packstone/generate/drop_and_roll.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using benchmarks::median;
using benchmarks::processor_seconds;

struct Scene {
  int dimension = 2;
  double sigma = 0.55;
  double ratio = 48.0;
  std::int64_t count = 5220;
  bool periodic = false;
};

double largest_radius(const Packing& packing) {
  double largest = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    largest = std::max(largest, circum_radius(inclusion.body));
  }
  return largest;
}

void run_drops(const Scene& scene, int drops, int seeds) {
  std::vector<double> seconds, whole, interior, counts;
  std::uint64_t hash = 0;
  bool passed = true;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const BodySource supply =
        scenes::lognormal_balls(scene.dimension, scene.sigma, scene.ratio, key);
    const Cell cell =
        scenes::cell_for(supply, scene.count, scene.dimension == 2 ? 0.82 : 0.58, scene.periodic);
    std::vector<OrderedBody> bodies;
    for (std::int64_t k = 0; k < 2 * scene.count; ++k) bodies.push_back(supply(k));
    const BodySource drawn = [&](std::int64_t k) { return bodies[static_cast<std::size_t>(k)]; };
    const double before = processor_seconds();
    ConstructiveResult result = drop_and_roll_fill(cell, drawn, {.drops = drops, .seed = key});
    seconds.push_back(processor_seconds() - before);
    result.packing.groups = {"balls"};
    whole.push_back(fraction(result.packing));
    interior.push_back(
        scenes::interior_fraction(result.packing, 2.0 * largest_radius(result.packing)));
    counts.push_back(static_cast<double>(result.packing.inclusions.size()));
    passed = passed && check_packing(result.packing).passed();
    hash ^= scenes::state_hash(result.packing);
  }
  fmt::print("| {} | {} | {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {} | {:016x} |\n",
             scene.dimension, scene.sigma, median(counts), drops, median(whole), median(interior),
             median(seconds), 1e6 * median(seconds) / median(counts), passed ? "passed" : "FAILED",
             hash);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "drops";
  const auto number = [&](int k, double fallback) {
    return argc > k ? std::atof(argv[k]) : fallback;
  };
  fmt::print(
      "| dimension | sigma | balls | k | density | interior | time, s | us/ball | check | hash "
      "|\n");
  if (mode == "drops") {
    Scene scene;
    scene.count = static_cast<std::int64_t>(number(2, 5220));
    for (const int k : {1, 3, 4, 5, 10, 30}) run_drops(scene, k, static_cast<int>(number(3, 7)));
    return 0;
  }
  if (mode == "drop") {
    const Scene scene{static_cast<int>(number(2, 2)), number(3, 0.55), number(4, 48.0),
                      static_cast<std::int64_t>(number(5, 5220)), number(7, 0.0) != 0.0};
    run_drops(scene, static_cast<int>(number(6, 4)), static_cast<int>(number(8, 1)));
    return 0;
  }
  fmt::print("modes: drops, drop\n");
  return 2;
}
