// Constructive methods: time, density of the whole cell and of its interior, what is true of it.
//
//   bench_constructive drops [count] [seeds]                     disks, several k
//   bench_constructive drop dimension sigma ratio count k [periodic] [seeds]
//   bench_constructive layer-disks [sigma] [ratio] [count] [field=value ...]
//   bench_constructive layer-ellipses [aspect] [count] [field=value ...]
//
// Fields of the published layers: spacing, top_layer, periodic, seeds, area_ratio.
// Times are processor times of the call alone; all numbers are medians over the seeds.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "constructive_scenes.hpp"
#include "packstone/generate/drop_and_roll.hpp"
#include "packstone/generate/published_advancing_layer.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using benchmarks::median;
using benchmarks::processor_seconds;

// What is packed into what.
struct Scene {
  std::function<BodySource(std::uint64_t seed)> supply;
  std::int64_t count = 5220;
  double fraction = 0.82;
  bool periodic = false;
};

// Bodies drawn beforehand, so that their cost is not measured.
class Drawn {
 public:
  Drawn(const BodySource& supply, std::int64_t count) {
    for (std::int64_t k = 0; k < count; ++k) bodies_.push_back(supply(k));
  }
  [[nodiscard]] BodySource source() const {
    return [this](std::int64_t k) { return bodies_[static_cast<std::size_t>(k)]; };
  }
  // Half the longest one.
  [[nodiscard]] double largest() const {
    double largest = 0.0;
    for (const OrderedBody& ordered : bodies_) {
      largest = std::max(largest, circum_radius(ordered.body));
    }
    return largest;
  }

 private:
  std::vector<OrderedBody> bodies_;
};

// Seeds 1 to n of one scene.
struct Runs {
  std::vector<double> counts, seconds, whole, interior, pairs, deepest, mean;
  std::uint64_t hash = 0;
  int passed = 0;
};

// Measures `fill`(cell, source, largest, seed, runs) for each seed.
template <class Fill>
Runs run_seeds(const Scene& scene, int seeds, Fill&& fill) {
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const BodySource supply = scene.supply(key);
    const Cell cell = scenes::cell_for(supply, scene.count, scene.fraction, scene.periodic);
    const Drawn drawn(supply, 2 * scene.count + 1000);
    const double before = processor_seconds();
    ConstructiveResult result = fill(cell, drawn.source(), drawn.largest(), key, runs);
    runs.seconds.push_back(processor_seconds() - before);
    result.packing.groups = {"bodies"};
    runs.counts.push_back(static_cast<double>(result.packing.inclusions.size()));
    runs.whole.push_back(fraction(result.packing));
    runs.interior.push_back(scenes::interior_fraction(result.packing, 2.0 * drawn.largest()));
    runs.passed += check_packing(result.packing).passed() ? 1 : 0;
    runs.hash ^= scenes::state_hash(result.packing);
  }
  return runs;
}

void print_row(const std::string& what, const Runs& runs) {
  const std::string overlaps = runs.pairs.empty()
                                   ? ""
                                   : fmt::format(" {} | {:.3f} | {:.4f} |", median(runs.pairs),
                                                 median(runs.deepest), median(runs.mean));
  fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {}/{} |{} {:016x} |\n", what,
             median(runs.counts), median(runs.whole), median(runs.interior), median(runs.seconds),
             1e6 * median(runs.seconds) / median(runs.counts), runs.passed, runs.counts.size(),
             overlaps, runs.hash);
  std::fflush(stdout);
}

Scene balls(int dimension, double sigma, double ratio, std::int64_t count) {
  return {.supply =
              [=](std::uint64_t seed) {
                return scenes::lognormal_balls(dimension, sigma, ratio, seed);
              },
          .count = count,
          .fraction = dimension == 2 ? 0.82 : 0.58};
}

void run_drops(const std::string& what, const Scene& scene, int drops, int seeds) {
  const Runs runs =
      run_seeds(scene, seeds,
                [&](const Cell& cell, const BodySource& source, double, std::uint64_t seed, Runs&) {
                  return drop_and_roll_fill(cell, source, {.drops = drops, .seed = seed});
                });
  print_row(fmt::format("{}, k = {}", what, drops), runs);
}

struct LayerMode {
  PublishedLayerOptions options;
  int seeds = 3;
  double area_ratio = 10.0;
  bool periodic = false;
};

LayerMode layer_mode(int argc, char** argv, int first) {
  LayerMode mode;
  for (int k = first; k < argc; ++k) {
    const std::string text = argv[k];
    const std::size_t equals = std::min(text.find('='), text.size() - 1);
    const std::string field = text.substr(0, equals);
    const double value = std::atof(text.c_str() + equals + 1);
    if (field == "spacing") mode.options.spacing = value;
    if (field == "top_layer") mode.options.top_layer = value;
    if (field == "periodic") mode.periodic = value != 0.0;
    if (field == "seeds") mode.seeds = static_cast<int>(value);
    if (field == "area_ratio") mode.area_ratio = value;
  }
  return mode;
}

void run_layer(const std::string& what, Scene scene, LayerMode mode) {
  scene.periodic = mode.periodic;
  const Runs runs = run_seeds(
      scene, mode.seeds,
      [&](const Cell& cell, const BodySource& source, double largest, std::uint64_t, Runs& all) {
        mode.options.largest_semi_axis = largest;
        PublishedLayerResult result = published_advancing_layer_fill(cell, source, mode.options);
        all.pairs.push_back(static_cast<double>(result.overlaps.pairs));
        all.deepest.push_back(result.overlaps.deepest);
        all.mean.push_back(result.overlaps.mean);
        return result;
      });
  print_row(
      fmt::format("{}, x_1 = {} b, h_TL = {}", what, mode.options.spacing, mode.options.top_layer),
      runs);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "drops";
  const auto number = [&](int k, double fallback) {
    return argc > k ? std::atof(argv[k]) : fallback;
  };
  const bool layer = mode == "layer-disks" || mode == "layer-ellipses";
  fmt::print("| scene | bodies | density | interior | time, s | us/body | check |{} hash |\n",
             layer ? " pairs | deepest, b | mean, b |" : "");
  if (mode == "drops") {
    const auto count = static_cast<std::int64_t>(number(2, 5220));
    for (const int k : {1, 3, 4, 5, 10, 30}) {
      run_drops("disks", balls(2, 0.55, 48.0, count), k, static_cast<int>(number(3, 7)));
    }
  } else if (mode == "drop") {
    const int dimension = static_cast<int>(number(2, 2));
    Scene scene = balls(dimension, number(3, 0.55), number(4, 48.0),
                        static_cast<std::int64_t>(number(5, 5220)));
    scene.periodic = number(7, 0.0) != 0.0;
    run_drops(dimension == 2 ? "disks" : "spheres", scene, static_cast<int>(number(6, 4)),
              static_cast<int>(number(8, 1)));
  } else if (mode == "layer-disks") {
    run_layer(
        "disks",
        balls(2, number(2, 0.55), number(3, 48.0), static_cast<std::int64_t>(number(4, 5220))),
        layer_mode(argc, argv, 5));
  } else if (mode == "layer-ellipses") {
    const double aspect = number(2, 1.5);
    const LayerMode options = layer_mode(argc, argv, 4);
    const double ratio = options.area_ratio;
    run_layer(
        fmt::format("ellipses {}", aspect),
        {.supply =
             [=](std::uint64_t seed) { return scenes::uniform_ellipses(aspect, ratio, seed); },
         .count = static_cast<std::int64_t>(number(3, 1200)),
         .fraction = 0.80},
        options);
  } else {
    fmt::print("modes: drops, drop, layer-disks, layer-ellipses\n");
    return 2;
  }
  return 0;
}
