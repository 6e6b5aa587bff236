// Bodies that do not grow: collisions per second, the equation of state, energy; and the order of
// the orientations that growth leaves.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "event_driven/common.hpp"
#include "growth_scenes.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "scenes.hpp"

namespace packstone::benchmarks {
namespace {

struct FluidCase {
  const char* name;
  double fraction;
  std::vector<OrderedBody> bodies;
  double aim;  // Collisions per second; 0: none.
};

std::vector<FluidCase> rate_cases() {
  return {{"spheres", 0.50, scenes::equal_spheres(1000, 0.50), 1e6},
          {"aspect-2", 0.50, scenes::equal_ellipsoids(1000, 0.50, 2.0, 1), 4e5},
          {"aspect-40", 0.05, scenes::equal_ellipsoids(1000, 0.05, 40.0, 1), 1.2e5},
          {"mixture-3", 0.50, scenes::equal_volume_mixture(50, 0.50, 3.0, 1), 5e4}};
}

// N. F. Carnahan, K. E. Starling, J. Chem. Phys. 51 (1969) 635: p V / (N k T) of hard spheres.
double carnahan_starling(double eta) {
  return (1.0 + eta + eta * eta - eta * eta * eta) / std::pow(1.0 - eta, 3);
}

void print_pressures() {
  constexpr int count = 1000;
  for (const double fraction : {0.3, 0.5}) {
    const Fluid fluid = equilibrium({}, scenes::equal_spheres(count, fraction), 1000.0, 1);
    const double ours = fluid.result.report.reduced_pressure;
    const double theirs = carnahan_starling(fraction);
    fmt::print("physics pressure spheres {:5.2f} {:6} {:9.4f} {:9.4f} {:+8.3f}%\n", fraction, count,
               theirs, ours, 100.0 * (ours / theirs - 1.0));
    std::fflush(stdout);
  }
}

void print_energies() {
  constexpr int count = 1000;
  const FluidCase cases[] = {{"spheres", 0.5, scenes::equal_spheres(count, 0.5), 0},
                             {"aspect-2", 0.5, scenes::equal_ellipsoids(count, 0.5, 2.0, 1), 0},
                             {"aspect-0.5", 0.5, scenes::equal_ellipsoids(count, 0.5, 0.5, 1), 0}};
  for (const FluidCase& of : cases) {
    const EventDrivenReport report = equilibrium({}, of.bodies, 1000.0, 1).result.report;
    fmt::print("physics energy {:<10} {:5.2f} {:9} {:9.2e} {:9.2e}\n", of.name, of.fraction,
               report.collisions, report.energy_drift, report.most_negative_gap);
    std::fflush(stdout);
  }
}

struct Mean {
  double value = 0.0;
  double half_width = 0.0;  // Of the 95 % interval, by Student's t.
};

Mean mean_of(const std::vector<double>& values) {
  // Two-sided 95 % points of Student's t for 1 to 10 degrees of freedom, then nearly the normal's.
  constexpr double points[] = {12.706, 4.303, 3.182, 2.776, 2.571,
                               2.447,  2.365, 2.306, 2.262, 2.228};
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  if (values.size() < 2) return {sum / n, 0.0};
  const double t = values.size() <= 11 ? points[values.size() - 2] : 2.0;
  return {sum / n, t * std::sqrt(squares / (n - 1.0) / n)};
}

// What the paper measures the order of.
struct OrderCase {
  double aspect;
  double fraction;
};
constexpr OrderCase kOrderCases[] = {{2, 0.3}, {10, 0.1}};

double rho_of(const std::vector<Vec3>& axes) {
  return orientation_order(orientation_tensor(axes), 3).rho;
}
double rho_of(const Packing& packing) { return rho_of(symmetry_axes(packing, 0)); }

bool print_order(double aspect, double fraction, int count, int realizations) {
  std::vector<double> rho;
  GrowthStatistics of;
  for (int k = 1; k <= realizations; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    const auto scene = scenes::alike("prolate", count, fraction, aspect, aspect);
    const Growth growth = grow({}, scenes::ellipsoids(scene, seed), {.seed = seed});
    rho.push_back(rho_of(growth.result.packing));
    of.add(growth);
  }
  const Mean mean = mean_of(rho);
  const RandomValue random = random_order(count, 3).rho;
  fmt::print("physics rho {:4.0f} {:5.2f} {:4} {:8.4f} {:8.4f} {:8.4f} {:8.4f} {:>6} {:016x}\n",
             aspect, fraction, count, mean.value, mean.half_width, random.mean,
             random.standard_deviation, fmt::format("{}/{}", of.reached, realizations), of.hash);
  std::fflush(stdout);
  return of.reached == realizations;
}

// rho of one order in three states: axes as they are drawn, bodies as they are grown, and after 30
// collisions per body at those sizes.
bool print_alignment(double aspect, double fraction, int count, int realizations) {
  std::vector<double> drawn, grown, still;
  std::uint64_t hash = 0;
  int passed = 0;
  for (int k = 1; k <= realizations; ++k) {
    EventDrivenOptions options{.seed = static_cast<std::uint64_t>(k)};
    const auto scene = scenes::alike("prolate", count, fraction, aspect, aspect);
    const auto bodies = scenes::ellipsoids(scene, options.seed);
    std::vector<Vec3> axes;
    for (const OrderedBody& ordered : bodies) axes.push_back(*symmetry_axis(ordered.body));
    drawn.push_back(rho_of(axes));
    const Growth growth = grow({}, bodies, options);
    grown.push_back(rho_of(growth.result.packing));
    options.goal = EventDrivenGoal::equilibrium;
    options.collisions_per_body = 30.0;
    const Packing after = event_driven_continue(growth.result.state, options).packing;
    still.push_back(rho_of(after));
    hash ^= scenes::state_hash(after);
    passed += growth.passed && check_packing(after).passed() ? 1 : 0;
  }
  fmt::print("alignment {:4.0f} {:5.2f} {:4} {:8.4f}", aspect, fraction, count,
             random_order(count, 3).rho.mean);
  for (const auto& values : {drawn, grown, still}) {
    const Mean mean = mean_of(values);
    fmt::print(" {:8.4f} {:7.4f}", mean.value, mean.half_width);
  }
  fmt::print(" {:>8} {:016x}\n", fmt::format("{}/{}", passed, realizations), hash);
  std::fflush(stdout);
  return passed == realizations;
}

}  // namespace

bool run_rates(int seeds) {
  bool all_passed = true;
  fmt::print("# collisions per second without growth, {} seeds, median\n", seeds);
  fmt::print("#     case         V_f     N collisions     per-s     aim-s    drift passed hash\n");
  for (const FluidCase& of : rate_cases()) {
    std::vector<double> rates;
    EventDrivenReport report;
    std::uint64_t hash = 0;
    int passed = 0;
    for (int k = 1; k <= seeds; ++k) {
      const auto count = static_cast<double>(of.bodies.size());
      const Fluid fluid = equilibrium({}, of.bodies, 2e5 / count, static_cast<std::uint64_t>(k));
      report = fluid.result.report;
      rates.push_back(static_cast<double>(report.collisions) / fluid.seconds);
      hash ^= scenes::state_hash(fluid.result.packing);
      passed += check_packing(fluid.result.packing).passed() ? 1 : 0;
    }
    fmt::print("rates {:<10} {:5.2f} {:5} {:10} {:9.0f} {:9.0f} {:8.1e} {:>6} {:016x}\n", of.name,
               of.fraction, of.bodies.size(), report.collisions, median(rates), of.aim,
               report.energy_drift, fmt::format("{}/{}", passed, seeds), hash);
    std::fflush(stdout);
    all_passed = all_passed && passed == seeds;
  }
  return all_passed;
}

bool run_physics(int realizations) {
  fmt::print("# pressure: shape, V_f, N, Carnahan-Starling, ours, difference\n");
  print_pressures();
  fmt::print("# energy: shape, V_f, collisions, relative drift, most negative gap\n");
  print_energies();
  fmt::print("# rho: R_1, V_f, N, mean of {}, half of 95 % interval, of random axes: mean, ",
             realizations);
  fmt::print("standard deviation; passed, hash\n");
  bool all_passed = true;
  for (const auto& [aspect, fraction] : kOrderCases) {
    for (const int count : {10, 25, 50, 100, 200, 500}) {
      all_passed = print_order(aspect, fraction, count, realizations) && all_passed;
    }
  }
  return all_passed;
}

bool run_alignment(int realizations) {
  fmt::print("# {} realizations: R_1, V_f, N, rho of random axes; then means and halves of 95 % ",
             realizations);
  fmt::print("intervals: as drawn, as grown, at equilibrium; passed, hash\n");
  bool all_passed = true;
  for (const auto& [aspect, fraction] : kOrderCases) {
    all_passed = print_alignment(aspect, fraction, 500, realizations) && all_passed;
  }
  return all_passed;
}

}  // namespace packstone::benchmarks
