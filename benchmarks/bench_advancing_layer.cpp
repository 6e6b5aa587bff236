// Advancing layer: time, density of the whole cell and of its interior, certificate, hash.
//
//   bench_advancing_layer LAW COUNT FRACTION [seeds] [key=value ...]
//
// LAW: lognormal:DIM:SIGMA:RATIO  normal:DIM:RATIO  bimodal:DIM:RATIO  equal:DIM
//      ellipses:ASPECT:AREA_RATIO[:STD_DEGREES]  ellipsoids:ASPECT[:SIGMA]
// FRACTION: the list of COUNT bodies fills the cell so far; with fill=F the cell has room for COUNT
//      bodies at F and is filled. Keys: held_back, candidates, top_layer, periodic, restarts, fill,
//      threads.
//
// Times are processor times of the call alone; densities and times are medians over the seeds.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "constructive_scenes.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/advancing_layer.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using benchmarks::median;
using benchmarks::processor_seconds;

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  return parts;
}

BodySource supply_of(const std::string& law, std::uint64_t seed) {
  const std::vector<std::string> parts = parts_of(law);
  const auto number = [&](std::size_t k, double fallback) {
    return k < parts.size() ? std::atof(parts[k].c_str()) : fallback;
  };
  const std::string& name = parts.front();
  if (name == "lognormal") {
    return scenes::lognormal_balls(static_cast<int>(number(1, 2)), number(2, 0.55), number(3, 48),
                                   seed);
  }
  if (name == "equal") return scenes::lognormal_balls(static_cast<int>(number(1, 2)), 0, 1, seed);
  if (name == "normal") {
    return scenes::normal_balls(static_cast<int>(number(1, 2)), number(2, 4), seed);
  }
  if (name == "bimodal") {
    return scenes::bimodal_balls(static_cast<int>(number(1, 2)), number(2, 4), seed);
  }
  if (name == "ellipses") {
    return number(3, 0) > 0.0
               ? scenes::aligned_ellipses(number(1, 2), number(2, 10), number(3, 0), seed)
               : scenes::uniform_ellipses(number(1, 2), number(2, 10), seed);
  }
  if (name == "ellipsoids") return scenes::prolate_ellipsoids(number(1, 2), number(2, 0), seed);
  fmt::print(stderr, "unknown law {}\n", law);
  std::exit(2);
}

double largest_half_width(const Packing& packing) {
  double largest = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    largest = std::max(largest, circum_radius(inclusion.body));
  }
  return largest;
}

// Area- or volume-weighted mean half width in the top tenth of the cell over that of all.
double top_sizes(const Packing& packing) {
  const auto up = static_cast<std::size_t>(packing.cell.dimension - 1);
  double all = 0.0, all_weight = 0.0, top = 0.0, top_weight = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    const double weight = volume(inclusion.body);
    const double width = circum_radius(inclusion.body);
    all += weight * width;
    all_weight += weight;
    if (inclusion.center[up] < 0.9 * packing.cell.size[up]) continue;
    top += weight * width;
    top_weight += weight;
  }
  return top_weight > 0.0 ? top / top_weight / (all / all_weight) : 0.0;
}

struct Table {
  std::vector<double> seconds, whole, interior, counts, top_sizes;
  std::uint64_t hash = 0;
  int reached = 0;
  int passed = 0;
  std::int64_t restarts = 0;
  double tests = 0.0;
};

void add(Table& table, ConstructiveResult& result, double seconds) {
  result.packing.groups = {"bodies"};
  table.seconds.push_back(seconds);
  table.whole.push_back(fraction(result.packing));
  table.interior.push_back(
      scenes::interior_fraction(result.packing, 2.0 * largest_half_width(result.packing)));
  table.top_sizes.push_back(top_sizes(result.packing));
  table.counts.push_back(static_cast<double>(result.packing.inclusions.size()));
  table.passed += check_packing(result.packing).passed() ? 1 : 0;
  table.reached += result.stop == ConstructiveStop::target_reached ? 1 : 0;
  table.restarts += result.restarts;
  table.tests = static_cast<double>(result.tested) / table.counts.back();
  table.hash ^= scenes::state_hash(result.packing);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::string law = argv[1];
  const auto count = static_cast<std::int64_t>(std::atof(argv[2]));
  const double fraction = std::atof(argv[3]);
  int seeds = 1;
  std::map<std::string, double> keys;
  for (int k = 4; k < argc; ++k) {
    const std::string text = argv[k];
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      seeds = std::atoi(argv[k]);
    } else {
      keys[text.substr(0, equals)] = std::atof(text.c_str() + equals + 1);
    }
  }
  AdvancingLayerOptions options;
  if (keys.count("held_back") != 0) options.held_back = keys["held_back"];
  if (keys.count("candidates") != 0) options.candidates = static_cast<int>(keys["candidates"]);
  if (keys.count("top_layer") != 0) options.top_layer = keys["top_layer"];
  if (keys.count("restarts") != 0) {
    options.max_restarts = static_cast<std::int64_t>(keys["restarts"]);
  }
  if (keys.count("close_top") != 0) options.close_top = keys["close_top"] != 0.0;
  const bool fill = keys["fill"] != 0.0;
  RunContext run;
  if (keys.count("threads") != 0) run.threads(static_cast<int>(keys["threads"]));
  Table table;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const BodySource supply = supply_of(law, key);
    Cell cell = scenes::cell_for(supply, count, fraction, keys["periodic"] != 0.0);
    if (keys["periodic"] == 2.0) cell.periodic[static_cast<std::size_t>(cell.dimension - 1)] = true;
    options.seed = key;
    std::vector<OrderedBody> bodies;
    for (std::int64_t k = 0; k < (fill ? 2 : 1) * count; ++k) bodies.push_back(supply(k));
    const double before = processor_seconds();
    ConstructiveResult result =
        fill ? advancing_layer_fill(
                   cell, [&](std::int64_t k) { return bodies[static_cast<std::size_t>(k)]; },
                   options, run)
             : advancing_layer_pack(cell, bodies, options, run);
    add(table, result, processor_seconds() - before);
  }
  const auto [least, most] = std::minmax_element(table.whole.begin(), table.whole.end());
  fmt::print(
      "| {} | {} | {:.4f} ({:.4f} to {:.4f}) | {:.4f} | {:.3f} s | {:.2f} us | all placed {}/{} | "
      "tests {:.1f} | top sizes {:.2f} | restarts {} | passed {}/{} | {:016x} |\n",
      law, median(table.counts), median(table.whole), *least, *most, median(table.interior),
      median(table.seconds), 1e6 * median(table.seconds) / median(table.counts), table.reached,
      seeds, table.tests, median(table.top_sizes), table.restarts, table.passed, seeds, table.hash);
  return 0;
}
