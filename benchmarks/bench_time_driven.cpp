// The published time-driven method: what it believes of the inclusions of Salnikov et al., half of
// the volume in spheres, half in cylinders, and what is true.
//
//   bench_time_driven table [runs] [limit_s]                   10+10 and 50+50, three forms
//   bench_time_driven vary runs count_each fraction aspect [field=value ...]
//   bench_time_driven energy [count_each] [fraction] [aspect]  energy beside overlap volume
//   bench_time_driven pairs [folder]                           figures 15 to 29
//
// Times are processor times of the call alone, check included; each line carries a hash of the
// packings made.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "packstone/generate/published_time_driven.hpp"
#include "scenes.hpp"
#include "time_driven/pairs.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using benchmarks::median;
using benchmarks::processor_seconds;

struct Scene {
  int count_each;
  double fraction;
  double aspect;
};

std::vector<OrderedBody> bodies_of(const Scene& scene, std::uint64_t seed) {
  const double half = 0.5 * scene.fraction;
  return scenes::cylinders_and_spheres(scene.count_each, half, half, scene.aspect, seed);
}

double radius_of_cylinders(const Scene& scene) {
  return std::get<Cylinder>(bodies_of(scene, 1).front().body).radius;
}

RunContext limited(double limit_s) { return RunContext().time_limit(limit_s); }

// Seeds 1 to `runs` of one scene.
struct Runs {
  std::vector<double> seconds, energy_ratios, overlaps, deepest;
  std::vector<std::int64_t> steps;
  int relaxed = 0, free = 0, reshuffles = 0;
  std::uint64_t hash = 0;
};

Runs run_seeds(const Scene& scene, TimeDrivenOptions options, int runs, double limit_s) {
  Runs total;
  for (int seed = 1; seed <= runs; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const std::vector<OrderedBody> bodies = bodies_of(scene, options.seed);
    const double before = processor_seconds();
    const TimeDrivenResult result =
        published_time_driven_pack({}, bodies, options, limited(limit_s));
    total.seconds.push_back(processor_seconds() - before);
    total.energy_ratios.push_back(
        result.start_energy > 0.0 ? result.potential_energy / result.start_energy : 0.0);
    total.overlaps.push_back(static_cast<double>(result.overlaps));
    total.deepest.push_back(result.deepest);
    total.steps.push_back(result.steps);
    total.relaxed += result.stop == TimeDrivenStop::relaxed;
    total.free += result.overlaps == 0;
    total.reshuffles += result.reshuffles;
    total.hash ^= scenes::state_hash(result.packing);
  }
  return total;
}

void print_head() {
  fmt::print(
      "| n | f | a | form | time, s | steps | E / E_0 | believes | reshuffles | overlaps, mean "
      "| deepest, r_c | free | hash |\n");
}

void print_row(const Scene& scene, std::string_view form, const Runs& total, int runs) {
  const double mean =
      std::accumulate(total.overlaps.begin(), total.overlaps.end(), 0.0) / std::max(1, runs);
  const double deepest = *std::max_element(total.deepest.begin(), total.deepest.end());
  fmt::print(
      "| {0}+{0} | {1} | {2} | {3} | {4:.2g} | {5} | {6:.1e} | {7}/{8} | {9} | {10:.1f} | "
      "{11:.2g} | {12}/{8} | {13:016x} |\n",
      scene.count_each, scene.fraction, scene.aspect, form, median(total.seconds),
      median(total.steps), median(total.energy_ratios), total.relaxed, runs, total.reshuffles, mean,
      deepest / radius_of_cylinders(scene), total.free, total.hash);
  std::fflush(stdout);
}

void run_table(int runs, double limit_s) {
  TimeDrivenOptions literal, repaired;
  literal.literal = true;
  repaired.rescale = 1.0;
  const std::vector<std::pair<std::string_view, TimeDrivenOptions>> forms{
      {"literal", literal}, {"repaired", repaired}, {"repaired, rescaled", {}}};
  print_head();
  for (const int n : {10, 50}) {
    for (const double aspect : {3.0, 5.0}) {
      for (const double fraction : {0.1, 0.3, 0.5}) {
        const Scene scene{n, fraction, aspect};
        for (const auto& [form, options] : forms) {
          print_row(scene, form, run_seeds(scene, options, runs, limit_s), runs);
        }
      }
    }
  }
}

// "damping=0.5" and the like.
void set_field(TimeDrivenOptions& o, const std::string& text) {
  const std::map<std::string, double*> reals{
      {"time_step", &o.time_step},
      {"damping", &o.damping},
      {"berendsen", &o.berendsen},
      {"berendsen_temperature", &o.berendsen_temperature},
      {"nose_hoover", &o.nose_hoover},
      {"nose_hoover_temperature", &o.nose_hoover_temperature},
      {"rescale", &o.rescale},
      {"rescale_limit", &o.rescale_limit},
      {"energy_threshold", &o.energy_threshold},
      {"stagnation_drop", &o.stagnation_drop}};
  const std::map<std::string, std::int64_t*> counts{{"stagnation_steps", &o.stagnation_steps},
                                                    {"reshuffle_steps", &o.reshuffle_steps},
                                                    {"max_steps", &o.max_steps}};
  const std::size_t equals = std::min(text.find('='), text.size() - 1);
  const std::string field = text.substr(0, equals);
  const double value = std::atof(text.c_str() + equals + 1);
  if (const auto found = reals.find(field); found != reals.end()) {
    *found->second = value;
  } else if (const auto count = counts.find(field); count != counts.end()) {
    *count->second = static_cast<std::int64_t>(value);
  } else if (field == "reshuffles") {
    o.reshuffles = static_cast<int>(value);
  } else if (field == "literal") {
    o.literal = value != 0.0;
  } else if (field == "leapfrog") {
    o.integrator = TimeDrivenIntegrator::leapfrog;
  } else {
    fmt::print("no field {}\n", field);
    std::exit(2);
  }
}

void run_energy(const Scene& scene) {
  TimeDrivenOptions options{.history_every = 5, .overlap_volume_every = 1, .overlap_points = 128};
  const auto run = published_time_driven_pack({}, bodies_of(scene, 1), options);
  fmt::print("| t | E / E_0 | force factor | overlap volume | error |\n");
  for (const TimeDrivenSample& s : run.history) {
    fmt::print("| {:.2f} | {:.3e} | {:g} | {:.4e} | {:.0e} |\n", s.time,
               s.potential_energy / run.start_energy, s.force_factor, s.overlap_volume.value,
               s.overlap_volume.error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "table";
  const auto number = [&](int k, double fallback) {
    return argc > k ? std::atof(argv[k]) : fallback;
  };
  if (mode == "table") {
    run_table(static_cast<int>(number(2, 10)), number(3, 60.0));
  } else if (mode == "vary") {
    const int runs = static_cast<int>(number(2, 10));
    const Scene scene{static_cast<int>(number(3, 10)), number(4, 0.5), number(5, 3)};
    TimeDrivenOptions options;
    for (int k = 6; k < argc; ++k) set_field(options, argv[k]);
    const std::string form =
        fmt::format("{}", fmt::join(argv + std::min(argc, 6), argv + argc, " "));
    print_row(scene, form, run_seeds(scene, options, runs, 60.0), runs);
  } else if (mode == "energy") {
    run_energy({static_cast<int>(number(2, 50)), number(3, 0.5), number(4, 3)});
  } else if (mode == "pairs") {
    benchmarks::show_pairs(argc > 2 ? argv[2] : "");
  } else {
    fmt::print("modes: table, vary, energy, pairs\n");
    return 2;
  }
}
