// Relaxation: the tables of Salnikov et al., long fibers of ordered tensors, and large numbers.
//
//   bench_relaxation tables [runs] [count_each, 0: all] [limit_s]
//   bench_relaxation blanks [runs] [limit_s]
//   bench_relaxation fibers [runs] [limit_s] [spherocylinder|cylinder] [name]
//   bench_relaxation scaling [spheres|mixture|fibers] [largest count] [threads]
//
// Times are processor times, from the bodies drawn to the certificate.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "growth_scenes.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/geometry/measures.hpp"
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
  double start = 0.0;  // Lengths at which random sequential adsorption places them first; 0: not.
};

std::vector<Vec3> centers_from_rsa(const std::vector<OrderedBody>& bodies, double factor,
                                   std::uint64_t seed) {
  std::vector<OrderedBody> smaller = bodies;
  for (OrderedBody& b : smaller) b.body = scaled(b.body, factor);
  std::vector<Vec3> centers;
  const RsaResult placed = rsa_pack({}, smaller, {.seed = seed});
  for (const Inclusion& inclusion : placed.packing.inclusions) centers.push_back(inclusion.center);
  centers.resize(bodies.size());
  return centers;
}

Outcome run_once(const std::vector<OrderedBody>& bodies, std::uint64_t seed, const Mode& mode) {
  RunContext run;
  run.threads(mode.threads);
  run.time_limit(mode.limit_s);
  RelaxationStart start;
  if (mode.start > 0.0) {
    start = [&](std::int64_t attempt) {
      return centers_from_rsa(bodies, mode.start, seed + static_cast<std::uint64_t>(attempt));
    };
  }
  const auto begin = RunContext::Clock::now();
  const double before = processor_seconds();
  RelaxationResult result = relaxation_pack({}, bodies, {.seed = seed}, run, start);
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
  double start;  // Fraction at which they are placed first.
  double edge;   // Of the cell, in lengths.
};

const std::vector<FiberCase>& fiber_cases() {
  constexpr double third = 1.0 / 3.0;
  constexpr SymMat3 iso{third, third, third, 0, 0, 0}, injected{0.7, 0.25, 0.05, 0, 0, 0},
      aligned{0.9, 0.05, 0.05, 0, 0, 0}, planar{0.5, 0.5, 0, 0, 0, 0};
  static const std::vector<FiberCase> cases = {{"iso-20", iso, 20, 0.20, 0.08, 2},
                                               {"iso-50", iso, 50, 0.10, 0.045, 2},
                                               {"iso-100", iso, 100, 0.05, 0.024, 2},
                                               {"iso-200", iso, 200, 0.02, 0.011, 2},
                                               {"most-iso-10", iso, 10, 0.456, 0.15, 2},
                                               {"most-iso-20", iso, 20, 0.28, 0.11, 2},
                                               {"most-iso-50", iso, 50, 0.112, 0.05, 2},
                                               {"most-iso-100", iso, 100, 0.056, 0.026, 2},
                                               {"most-iso-200", iso, 200, 0.028, 0.012, 2},
                                               {"injected-10", injected, 10, 0.525, 0.14, 2},
                                               {"injected-20", injected, 20, 0.33, 0.11, 2},
                                               {"injected-50", injected, 50, 0.15, 0.05, 2},
                                               {"injected-100", injected, 100, 0.074, 0.024, 2},
                                               {"aligned-10", aligned, 10, 0.58, 0.2, 2},
                                               {"aligned-20", aligned, 20, 0.48, 0.13, 2},
                                               {"aligned-50", aligned, 50, 0.21, 0.07, 2},
                                               {"planar-10", planar, 10, 0.50, 0.12, 2},
                                               {"planar-20", planar, 20, 0.36, 0.1, 2}};
  return cases;
}

std::vector<OrderedBody> fibers(const FiberCase& of, ShapeKind shape, std::uint64_t seed) {
  InclusionGroup group;
  group.name = "fibers";
  group.shape = shape;
  const double half = 0.5 / of.edge;
  group.dimensions = Vec3{half / of.aspect, half, 0};
  group.fraction = of.fraction;
  group.orientation = TensorOrientation{of.tensor};
  return draw_inclusions({}, {group}, seed).bodies;
}

double tensor_error(const Packing& packing, const SymMat3& wanted) {
  const SymMat3 d = orientation_tensor(symmetry_axes(packing, 0)) - wanted;
  return std::max({std::abs(d.xx), std::abs(d.yy), std::abs(d.zz), std::abs(d.yz), std::abs(d.xz),
                   std::abs(d.xy)});
}

void run_fibers(int runs, Mode mode, ShapeKind shape, const std::string& only) {
  fmt::print(
      "# {} seeds, {}s, at most {} s\n# fibers             N aspect fraction  median-s     "
      "max-s passed relocated tensor-error hash\n",
      runs, name(shape), mode.limit_s);
  for (const FiberCase& of : fiber_cases()) {
    if (!only.empty() && only != of.name) continue;
    CellRuns all;
    std::int64_t relocated = 0;
    double error = 0.0;
    std::size_t count = 0;
    for (int seed = 1; seed <= runs; ++seed) {
      const auto key = static_cast<std::uint64_t>(seed);
      const auto bodies = fibers(of, shape, key);
      count = bodies.size();
      mode.start = std::cbrt(of.start / of.fraction);
      const Outcome outcome = run_once(bodies, key, mode);
      add(all, outcome);
      relocated = std::max(relocated, outcome.report.relocated);
      error = std::max(error, tensor_error(outcome.packing, of.tensor));
    }
    fmt::print("{:<14} {:6} {:6} {:8.3f} {:9.3f} {:9.3f} {:4}/{} {:9} {:12.1e} {:016x}\n", of.name,
               count, of.aspect, of.fraction, median(all.seconds),
               *std::max_element(all.seconds.begin(), all.seconds.end()), all.passed, runs,
               relocated, error, all.hash);
    std::fflush(stdout);
  }
}

void run_scaling(const std::string& what, int largest, int threads) {
  fmt::print("# {} threads\n# scaling {:>9} {:>10} {:>10} us/body steps passed hash\n", threads,
             "N", "s", "elapsed-s");
  for (int n = 1000; n <= largest; n *= 10) {
    Mode mode{.limit_s = 600, .threads = threads};
    std::vector<OrderedBody> bodies;
    if (what == "spheres") {
      bodies = scenes::equal_spheres(n, 0.50);
    } else if (what == "mixture") {
      bodies = scenes::cylinders_and_spheres(n / 2, 0.20, 0.20, 3, 1);
    } else {
      const double edge = std::cbrt(n / 0.20 * 3.14159 / 4 / 400);
      const FiberCase of{"", {1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0}, 20, 0.20, 0.08, edge};
      bodies = fibers(of, ShapeKind::spherocylinder, 1);
      mode.start = std::cbrt(of.start / of.fraction);
    }
    const Outcome outcome = run_once(bodies, 1, mode);
    fmt::print("{:<9} {:9} {:10.3f} {:10.3f} {:7.1f} {:5} {:6} {:016x}\n", what, bodies.size(),
               outcome.seconds, outcome.elapsed,
               1e6 * outcome.seconds / static_cast<double>(bodies.size()),
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
               flat ? ShapeKind::cylinder : ShapeKind::spherocylinder, word(5, ""));
  } else if (what == "scaling") {
    run_scaling(word(2, "spheres"), std::stoi(word(3, "100000")), std::stoi(word(4, "1")));
  } else {
    fmt::print(stderr, "bench_relaxation tables|blanks|fibers|scaling\n");
    return 2;
  }
  return 0;
}
