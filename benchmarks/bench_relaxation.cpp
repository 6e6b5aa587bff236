// Relaxation: the tables of Salnikov et al., long fibers of ordered tensors, and large numbers.
//
//   bench_relaxation tables [runs] [count_each, 0: all] [limit_s]
//   bench_relaxation blanks [runs] [limit_s]
//   bench_relaxation fibers [runs] [limit_s] [spherocylinder|cylinder] [name] [fraction]
//   bench_relaxation scaling [spheres|mixture|fibers] [largest count] [threads]
//
// Times are processor times, from the bodies drawn to the certificate.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/axis_segments.hpp"
#include "geometry/posed_body.hpp"
#include "growth_scenes.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "salnikov_2014.hpp"
#include "salnikov_cells.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using benchmarks::CellRuns;
using benchmarks::median;
using benchmarks::PrintedCell;
using benchmarks::processor_seconds;

struct Outcome {
  double seconds = 0.0;
  double elapsed = 0.0;  // By the clock [s].
  RelaxationReport report;
  Packing packing;
  bool passed = false;
};

struct Mode {
  double limit_s = 60.0;
  int threads = 1;
};

Outcome run_once(const std::vector<OrderedBody>& bodies, std::uint64_t seed, const Mode& mode) {
  RunContext run;
  run.threads(mode.threads);
  run.time_limit(mode.limit_s);
  const auto begin = RunContext::Clock::now();
  const double before = processor_seconds();
  RelaxationResult result = relaxation_pack({}, bodies, {.seed = seed}, run);
  const Certificate certificate =
      check_packing(result.packing, {}, RunContext{}.threads(mode.threads));
  const double seconds = processor_seconds() - before;
  const std::chrono::duration<double> elapsed = RunContext::Clock::now() - begin;
  return {seconds, elapsed.count(), result.report, std::move(result.packing), certificate.passed()};
}

void add(CellRuns& runs, const Outcome& outcome) {
  runs.add(outcome.seconds, outcome.report.restarts, outcome.passed,
           scenes::state_hash(outcome.packing));
}

void run_cell(const PrintedCell& cell, int runs, const Mode& mode) {
  CellRuns all;
  for (int seed = 1; seed <= runs; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const auto bodies = scenes::cylinders_and_spheres(cell.count_each, cell.sphere_fraction,
                                                      cell.cylinder_fraction, cell.aspect, key);
    add(all, run_once(bodies, key, mode));
  }
  benchmarks::print_cell(cell, all);
}

void print_heading(int runs) {
  fmt::print("# {} seeds\n", runs);
  benchmarks::print_cell_heading();
}

void run_tables(int runs, int count_each, const Mode& mode) {
  print_heading(runs);
  for (const auto& table : benchmarks::salnikov_dynamics_tables()) {
    if (count_each != 0 && table.count_each != count_each) continue;
    for (const auto& cell : table.times) {
      const double fs = cell.sphere_fraction, fc = cell.cylinder_fraction;
      run_cell({table.count_each, fs, fc, 3, cell.aspect_3}, runs, mode);
      run_cell({table.count_each, fs, fc, 5, cell.aspect_5}, runs, mode);
    }
  }
}

// What the paper leaves blank: a total of 0.55, in fifty and fifty.
void run_blanks(int runs, const Mode& mode) {
  print_heading(runs);
  for (int k = 1; k <= 10; ++k) {
    const double fc = 0.05 * k;
    for (const double aspect : {3.0, 5.0}) run_cell({50, 0.55 - fc, fc, aspect, -1}, runs, mode);
  }
}

struct FiberCase {
  const char* name;
  SymMat3 tensor;
  double aspect;
  double fraction;
  double edge;  // Of the cell, in lengths.
};

const std::vector<FiberCase>& fiber_cases() {
  constexpr double third = 1.0 / 3.0;
  constexpr SymMat3 iso{third, third, third, 0, 0, 0}, injected{0.7, 0.25, 0.05, 0, 0, 0},
      aligned{0.9, 0.05, 0.05, 0, 0, 0}, planar{0.5, 0.5, 0, 0, 0, 0};
  static const std::vector<FiberCase> cases = {{"iso-20", iso, 20, 0.20, 2},
                                               {"iso-50", iso, 50, 0.10, 2},
                                               {"iso-100", iso, 100, 0.05, 2},
                                               {"iso-200", iso, 200, 0.02, 2},
                                               {"most-iso-10", iso, 10, 0.456, 2},
                                               {"most-iso-20", iso, 20, 0.28, 2},
                                               {"most-iso-50", iso, 50, 0.112, 2},
                                               {"most-iso-100", iso, 100, 0.056, 2},
                                               {"most-iso-200", iso, 200, 0.028, 2},
                                               {"injected-10", injected, 10, 0.525, 2},
                                               {"injected-20", injected, 20, 0.33, 2},
                                               {"injected-50", injected, 50, 0.15, 2},
                                               {"injected-100", injected, 100, 0.074, 2},
                                               {"aligned-10", aligned, 10, 0.58, 2},
                                               {"aligned-20", aligned, 20, 0.48, 2},
                                               {"aligned-50", aligned, 50, 0.21, 2},
                                               {"planar-10", planar, 10, 0.50, 2},
                                               {"planar-20", planar, 20, 0.36, 2}};
  return cases;
}

Recipe recipe_of(const FiberCase& of, ShapeKind shape, std::uint64_t seed) {
  InclusionGroup group;
  group.name = "fibers";
  group.shape = shape;
  const double half = 0.5 / of.edge;
  group.dimensions = Vec3{half / of.aspect, half, 0};
  group.fraction = of.fraction;
  group.orientation = TensorOrientation{of.tensor};
  Recipe recipe;
  recipe.groups = {group};
  recipe.method = PackMethod::relaxation;
  recipe.seed = seed;
  return recipe;
}

// As the program does it.
Outcome run_recipe(const Recipe& recipe, const Mode& mode) {
  RunContext run;
  run.threads(mode.threads);
  run.time_limit(mode.limit_s);
  const auto begin = RunContext::Clock::now();
  const double before = processor_seconds();
  PackOutcome packed = pack(recipe, run);
  const double seconds = processor_seconds() - before;
  const std::chrono::duration<double> elapsed = RunContext::Clock::now() - begin;
  const bool passed = packed.target_reached && packed.packing.certificate->passed();
  return {seconds, elapsed.count(), packed.relaxation->report, std::move(packed.packing), passed};
}

double tensor_error(const Packing& packing, const SymMat3& wanted) {
  const SymMat3 d = orientation_tensor(symmetry_axes(packing, 0)) - wanted;
  return std::max({std::abs(d.xx), std::abs(d.yy), std::abs(d.zz), std::abs(d.yz), std::abs(d.xz),
                   std::abs(d.xy)});
}

// How far rods that are nearly in touch line up: the mean of P_2(cos gamma) over all pairs whose
// axes pass within 1.1 diameters. Random directions show -1/8 where all meet in their middles, each
// weighted by |sin gamma|, parallel ones 1.
double order_of_near_pairs(const Packing& packing) {
  std::vector<PosedBody> rods;
  for (const Inclusion& inclusion : packing.inclusions) {
    rods.push_back(posed_body(inclusion.body, inclusion.center));
  }
  double sum = 0.0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const Segment a{rods[i].axial, rods[i].pose.axis};
    for (std::size_t j = 0; j < i; ++j) {
      const Segment b{rods[j].axial, rods[j].pose.axis};
      Vec3 r = rods[j].pose.center - rods[i].pose.center;
      for (std::size_t k = 0; k < 3; ++k) {
        r[k] -= packing.cell.size[k] * std::round(r[k] / packing.cell.size[k]);
      }
      const double near = 1.1 * (rods[i].lateral + rods[j].lateral);
      const double reach = near + a.half_length + b.half_length;
      if (norm_sq(r) > reach * reach || norm(nearest_points(a, b, r).between) > near) continue;
      const double cosine = dot(a.axis, b.axis);
      sum += 1.5 * cosine * cosine - 0.5;
      ++count;
    }
  }
  return sum / static_cast<double>(std::max<std::int64_t>(1, count));
}

// Which of fiber_cases(), at their own fraction or at another.
struct FiberChoice {
  ShapeKind shape = ShapeKind::spherocylinder;
  std::string only;  // Empty: all.
  double fraction = 0.0;
};

void run_fibers(int runs, const Mode& mode, const FiberChoice& choice) {
  fmt::print(
      "# {} seeds, {}s, at most {} s\n# fibers             N aspect fraction  median-s     "
      "max-s passed relocated tensor-error near-P2 hash\n",
      runs, name(choice.shape), mode.limit_s);
  for (FiberCase of : fiber_cases()) {
    if (!choice.only.empty() && choice.only != of.name) continue;
    if (choice.fraction > 0.0) of.fraction = choice.fraction;
    CellRuns all;
    std::int64_t relocated = 0;
    double error = 0.0, near_order = 0.0;
    std::size_t count = 0;
    for (int seed = 1; seed <= runs; ++seed) {
      const auto key = static_cast<std::uint64_t>(seed);
      const Outcome outcome = run_recipe(recipe_of(of, choice.shape, key), mode);
      count = outcome.packing.inclusions.size();
      add(all, outcome);
      relocated = std::max(relocated, outcome.report.relocated);
      error = std::max(error, tensor_error(outcome.packing, of.tensor));
      near_order += order_of_near_pairs(outcome.packing) / runs;
    }
    fmt::print("{:<14} {:6} {:6} {:8.3f} {:9.3f} {:9.3f} {:4}/{} {:9} {:12.1e} {:7.3f} {:016x}\n",
               of.name, count, of.aspect, of.fraction, median(all.seconds),
               *std::max_element(all.seconds.begin(), all.seconds.end()), all.passed, runs,
               relocated, error, near_order, all.hash);
    std::fflush(stdout);
  }
}

Outcome run_many(const std::string& what, int n, const Mode& mode) {
  if (what == "spheres") return run_once(scenes::equal_spheres(n, 0.50), 1, mode);
  if (what == "mixture") {
    return run_once(scenes::cylinders_and_spheres(n / 2, 0.20, 0.20, 3, 1), 1, mode);
  }
  const double edge = std::cbrt(n / 0.20 * std::numbers::pi / 4 / 400);
  const FiberCase of{"", {1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0}, 20, 0.20, edge};
  return run_recipe(recipe_of(of, ShapeKind::spherocylinder, 1), mode);
}

void run_scaling(const std::string& what, int largest, int threads) {
  fmt::print("# {} threads\n# scaling {:>9} {:>10} {:>10} us/body steps passed hash\n", threads,
             "N", "s", "elapsed-s");
  for (int n = 1000; n <= largest; n *= 10) {
    const Outcome outcome = run_many(what, n, {.limit_s = 600, .threads = threads});
    const std::size_t count = outcome.packing.inclusions.size();
    fmt::print("{:<9} {:9} {:10.3f} {:10.3f} {:7.1f} {:5} {:6} {:016x}\n", what, count,
               outcome.seconds, outcome.elapsed, 1e6 * outcome.seconds / static_cast<double>(count),
               outcome.report.iterations, outcome.passed, scenes::state_hash(outcome.packing));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto word = [&](int k, const char* otherwise) {
    return std::string(argc > k ? argv[k] : otherwise);
  };
  const std::string what = word(1, "tables");
  Mode mode;
  if (what == "tables") {
    mode.limit_s = std::stod(word(4, "60"));
    run_tables(std::stoi(word(2, "20")), std::stoi(word(3, "0")), mode);
  } else if (what == "blanks") {
    mode.limit_s = std::stod(word(3, "60"));
    run_blanks(std::stoi(word(2, "20")), mode);
  } else if (what == "fibers") {
    mode.limit_s = std::stod(word(3, "30"));
    const bool flat = word(4, "spherocylinder") == "cylinder";
    run_fibers(std::stoi(word(2, "3")), mode,
               {.shape = flat ? ShapeKind::cylinder : ShapeKind::spherocylinder,
                .only = word(5, ""),
                .fraction = std::stod(word(6, "0"))});
  } else if (what == "scaling") {
    run_scaling(word(2, "spheres"), std::stoi(word(3, "100000")), std::stoi(word(4, "1")));
  } else {
    fmt::print(stderr, "bench_relaxation tables|blanks|fibers|scaling\n");
    return 2;
  }
  return 0;
}
