// Random sequential adsorption: the tables of Salnikov et al., large numbers of ellipsoids, and of
// equal spheres.
//
//   bench_rsa tables [fixed|redraw] [runs] [count_each] [limit_s] [first_seed]
//   bench_rsa blanks [fixed|redraw] [runs] [count_each] [limit_s] [first_seed]
//   bench_rsa scaling [largest count] [ellipsoids|cylinders|spheres|ellipses] [threads]
//   bench_rsa spheres [count]
//
// Times are processor times of the call of rsa_pack alone; the check comes after it.

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
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
  std::int64_t restarts = 0;
  bool passed = false;  // All placed, and no overlap in the check.
  std::uint64_t hash = 0;
  double elapsed = 0.0;  // By the clock [s].
};

bool free_of_overlap(Packing packing) {
  packing.groups = {"first", "second"};
  return check_packing(packing).passed();
}

Outcome run_once(const std::vector<OrderedBody>& bodies, const RsaOptions& options, double limit_s,
                 const Cell& cell = {}, int threads = 1) {
  RunContext run;
  run.threads(threads);
  run.time_limit(limit_s);
  const auto begin = RunContext::Clock::now();
  const double before = processor_seconds();
  const RsaResult result = rsa_pack(cell, bodies, options, run);
  const double seconds = processor_seconds() - before;
  const std::chrono::duration<double> elapsed = RunContext::Clock::now() - begin;
  const bool passed = result.stop == RsaStop::target_reached && free_of_overlap(result.packing);
  return {seconds, result.restarts, passed, scenes::state_hash(result.packing), elapsed.count()};
}

// Short runs are repeated, since what else runs on the machine would be measured with them: the
// median of five.
Outcome run_often(const std::vector<OrderedBody>& bodies, const RsaOptions& options,
                  double limit_s) {
  constexpr double short_run_s = 0.005;
  Outcome outcome = run_once(bodies, options, limit_s);
  if (outcome.seconds > short_run_s) return outcome;
  std::vector<double> seconds{outcome.seconds};
  while (seconds.size() < 5) seconds.push_back(run_once(bodies, options, limit_s).seconds);
  outcome.seconds = median(seconds);
  return outcome;
}

struct Mode {
  bool redraw;
  int runs;
  double limit_s;
  int first_seed;
};

void run_cell(const PrintedCell& cell, const Mode& mode) {
  CellRuns runs;
  for (int seed = mode.first_seed; seed < mode.first_seed + mode.runs; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    RsaOptions options;
    options.order = RsaOrder::as_given;
    options.seed = key;
    if (mode.redraw) options.redraw_orientation = {true, false};
    const auto bodies = scenes::cylinders_and_spheres(cell.count_each, cell.sphere_fraction,
                                                      cell.cylinder_fraction, cell.aspect, key);
    const Outcome outcome = run_often(bodies, options, mode.limit_s);
    runs.add(outcome.seconds, outcome.restarts, outcome.passed, outcome.hash);
  }
  const bool missed = cell.printed_s > 0 && runs.ratio(cell) < 20.0;
  benchmarks::print_cell(cell, runs, missed ? "  < 20" : "");
}

// The blank cells next to filled ones: the next cylinder fraction of each row.
std::vector<benchmarks::PrintedTime> with_blanks(const benchmarks::PrintedTable& table) {
  std::vector<benchmarks::PrintedTime> cells = table.times;
  for (const auto& cell : table.times) {
    const auto in_table = [&](double fs, double fc) {
      return std::any_of(cells.begin(), cells.end(), [&](const auto& other) {
        return std::abs(other.sphere_fraction - fs) < 1e-9 &&
               std::abs(other.cylinder_fraction - fc) < 1e-9;
      });
    };
    const double next_fc = cell.cylinder_fraction + 0.05;
    if (next_fc < 0.301 && !in_table(cell.sphere_fraction, next_fc)) {
      cells.push_back({cell.sphere_fraction, next_fc, -1, -1});
    }
    const double next_fs = cell.sphere_fraction + 0.05;
    if (next_fs < 0.301 && !in_table(next_fs, cell.cylinder_fraction)) {
      cells.push_back({next_fs, cell.cylinder_fraction, -1, -1});
    }
  }
  return cells;
}

void run_tables(const Mode& mode, int only_count, bool blanks) {
  fmt::print("# {} seeds, orientations {}, limit {} s\n", mode.runs,
             mode.redraw ? "redrawn" : "fixed", mode.limit_s);
  benchmarks::print_cell_heading();
  for (const auto& table : benchmarks::salnikov_tables()) {
    if (only_count != 0 && table.count_each != only_count) continue;
    for (const auto& cell : with_blanks(table)) {
      for (const double aspect : {3.0, 5.0}) {
        const double printed = aspect == 3.0 ? cell.aspect_3 : cell.aspect_5;
        if ((printed < 0) != blanks) continue;
        run_cell({table.count_each, cell.sphere_fraction, cell.cylinder_fraction, aspect, printed},
                 mode);
      }
    }
  }
}

struct Many {
  std::string name;
  Cell cell;
  double fraction;
};

// `count` bodies that fill the part many.fraction of many.cell.
std::vector<OrderedBody> many_bodies(const Many& many, std::int64_t count) {
  if (many.name == "ellipsoids") return scenes::equal_ellipsoids(count, many.fraction, 2.0, 1);
  const auto draw = [&](double size) {
    std::vector<OrderedBody> bodies;
    for (std::int64_t i = 0; i < count; ++i) {
      RandomStream random(1, StreamId::test, static_cast<std::uint64_t>(i));
      const Vec3 axis = random_direction(random);
      const double u = random.uniform();
      if (many.name == "cylinders") {
        bodies.push_back({Cylinder{size, 3.0 * size, axis}, 0});
      } else if (many.name == "spheres") {
        bodies.push_back({Sphere{size * std::pow(4.0, u)}, 0});
      } else {
        bodies.push_back({Ellipse{{2.0 * size, size}, std::numbers::pi * u}, 0});
      }
    }
    return bodies;
  };
  double total = 0.0;
  for (const OrderedBody& ordered : draw(1.0)) total += volume(ordered.body);
  return draw(std::pow(many.fraction / total, 1.0 / many.cell.dimension));
}

void run_scaling(std::int64_t largest, const Many& many, int threads) {
  fmt::print("{}, fraction {}, {} threads; processor time, median\n", many.name, many.fraction,
             threads);
  fmt::print("   count     seconds   us each  elapsed s  peak MB  hash\n");
  for (std::int64_t count = 1000; count <= largest; count *= 10) {
    const int runs = count >= 1'000'000 ? 1 : count >= 100'000 ? 3 : 7;
    std::vector<double> seconds, elapsed;
    std::uint64_t hash = 0;
    const auto bodies = many_bodies(many, count);
    for (int k = 0; k < runs; ++k) {
      RsaOptions options;
      options.seed = 1;
      const Outcome outcome = run_once(bodies, options, 600.0, many.cell, threads);
      seconds.push_back(outcome.seconds);
      elapsed.push_back(outcome.elapsed);
      hash = outcome.hash;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double s = median(seconds);
    fmt::print("{:8} {:11.4f} {:9.2f} {:10.4f} {:8} {:016x}\n", count, s,
               1e6 * s / static_cast<double>(count), median(elapsed), usage.ru_maxrss / 1024, hash);
    std::fflush(stdout);
  }
}

void run_spheres(std::int64_t count) {
  const double radius =
      std::cbrt(0.30 * 3.0 / (4.0 * std::numbers::pi * static_cast<double>(count)));
  const std::vector<OrderedBody> bodies(static_cast<std::size_t>(count),
                                        OrderedBody{Sphere{radius}, 0});
  std::vector<double> seconds;
  Outcome outcome;
  for (int k = 0; k < 5; ++k) {
    RsaOptions options;
    options.seed = 1;
    outcome = run_once(bodies, options, 600.0);
    seconds.push_back(outcome.seconds);
  }
  fmt::print("{} equal spheres, fraction 0.30: {:.4f} s, median of 5; restarts {}; {:016x}\n",
             count, median(seconds), outcome.restarts, outcome.hash);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "tables";
  if (what == "scaling") {
    const std::string name = argc > 3 ? argv[3] : "ellipsoids";
    const Many all[] = {{"ellipsoids", {}, 0.25},
                        {"cylinders", {}, 0.20},
                        {"spheres", {}, 0.30},
                        {"ellipses", cell_2d(1.0, 1.0), 0.40}};
    const auto* many =
        std::find_if(std::begin(all), std::end(all), [&](const Many& m) { return m.name == name; });
    if (many == std::end(all)) return 2;
    run_scaling(argc > 2 ? std::atoll(argv[2]) : 100'000, *many, argc > 4 ? std::atoi(argv[4]) : 1);
    return 0;
  }
  if (what == "spheres") {
    run_spheres(argc > 2 ? std::atoll(argv[2]) : 100'000);
    return 0;
  }
  Mode mode{argc > 2 && std::string(argv[2]) == "redraw", argc > 3 ? std::atoi(argv[3]) : 7,
            argc > 5 ? std::atof(argv[5]) : 50.0, argc > 6 ? std::atoi(argv[6]) : 1};
  run_tables(mode, argc > 4 ? std::atoi(argv[4]) : 0, what == "blanks");
}
