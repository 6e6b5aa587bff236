// How dense bodies of each shape get in a given processor time, and how ordered.

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "event_driven/common.hpp"
#include "growth_scenes.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "scenes.hpp"

namespace packstone::benchmarks {
namespace {

struct DensestCase {
  std::string_view name;
  double slowest_growth;
  double aim;  // Fraction within 60 s.
};

constexpr DensestCase kCases[] = {
    {"spheres", 2e-3, 0.645},       {"prolate-1.5", 3e-4, 0.722},  {"scalene", 1.1e-3, 0.740},
    {"prolate-2", 4e-4, 0.709},     {"prolate-10", 6e-4, 0.500},   {"prolate-40", 6e-4, 0.200},
    {"mixture-3", 1.2e-4, 0.650},   {"mixture-5", 1.4e-4, 0.620},  {"cylinders-1", 1.5e-4, 0.730},
    {"cylinders-3", 1.5e-4, 0.640}, {"cylinders-5", 3e-4, 0.620},  {"cylinders-10", 4e-4, 0.470},
    {"disks", 1e-4, 0.840},         {"ellipses-1.4", 3e-4, 0.890},
};

// Sizes are open; those ordered only say in which proportion they are.
std::vector<OrderedBody> bodies_of(std::string_view name) {
  constexpr double ordered = 0.2;
  constexpr std::uint64_t seed = 1;
  if (name == "spheres") return scenes::equal_spheres(10'000, ordered);
  if (name == "scalene") {
    return scenes::ellipsoids(scenes::alike(name, 1000, ordered, 1.25, 1.25 / 0.8), seed);
  }
  if (name == "prolate-1.5") return scenes::equal_ellipsoids(1000, ordered, 1.5, seed);
  if (name == "prolate-2") return scenes::equal_ellipsoids(1000, ordered, 2.0, seed);
  if (name == "prolate-10") return scenes::equal_ellipsoids(310, 0.1, 10.0, seed);
  if (name == "prolate-40") return scenes::equal_ellipsoids(310, 0.05, 40.0, seed);
  if (name == "mixture-3") return scenes::equal_volume_mixture(50, ordered, 3.0, seed);
  if (name == "mixture-5") return scenes::equal_volume_mixture(50, ordered, 5.0, seed);
  if (name == "cylinders-1") return scenes::equal_cylinders(50, ordered, 1.0, seed);
  if (name == "cylinders-3") return scenes::equal_cylinders(50, ordered, 3.0, seed);
  if (name == "cylinders-5") return scenes::equal_cylinders(50, ordered, 5.0, seed);
  if (name == "cylinders-10") return scenes::equal_cylinders(100, ordered, 10.0, seed);
  if (name == "disks") return scenes::equal_disks(1000, ordered);
  return scenes::equal_ellipses(1000, ordered, 1.4, seed);
}

// "S of the packing, and of as many random axes the mean and the upper end of 95 %".
std::string order_text(const Packing& packing) {
  const auto axes = symmetry_axes(packing, 0);  // Of a mixture, the cylinders.
  if (axes.empty()) return fmt::format("{:>6} {:>6} {:>6}", "-", "-", "-");
  const int dimension = packing.cell.dimension;
  const RandomValue random =
      random_order(static_cast<std::int64_t>(axes.size()), dimension).nematic;
  return fmt::format("{:6.3f} {:6.3f} {:6.3f}",
                     orientation_order(orientation_tensor(axes), dimension).nematic, random.mean,
                     random.high);
}

bool print_case(const DensestCase& of, double seconds, std::uint64_t seed) {
  const bool plane = of.name == "disks" || of.name == "ellipses-1.4";
  const Cell cell = plane ? cell_2d(1.0, 1.0) : Cell{};
  const EventDrivenOptions options{
      .goal = EventDrivenGoal::densest, .slowest_growth = of.slowest_growth, .seed = seed};
  const Growth growth = grow(cell, bodies_of(of.name), options, seconds);
  const EventDrivenResult& result = growth.result;
  const bool jammed = result.stop == EventDrivenStop::jammed;
  fmt::print("densest {:<12} {:6} {:7.4f} {:6.3f} {} {:8.1e} {:11} {:9.2e} {:7.1f} {:>6} {:>6} ",
             of.name, result.packing.inclusions.size(), fraction(result.packing), of.aim,
             order_text(result.packing), result.report.growth_rate, result.report.collisions,
             result.report.reduced_pressure, growth.seconds, jammed ? "jammed" : "time",
             growth.passed ? "passed" : "FAILED");
  fmt::print("{:016x}\n", growth.hash);
  std::fflush(stdout);
  return growth.passed;
}

}  // namespace

bool run_densest(double seconds, const std::string& only, std::uint64_t seed) {
  bool all_passed = true, any = false;
  fmt::print("# {} s of processor time of one thread each; S-0, S-975: of random axes the mean, ",
             seconds);
  fmt::print("and what one sample in 40 exceeds\n");
  fmt::print("#       case              N     V_f    aim      S    S-0  S-975   growth  ");
  fmt::print("collisions  pressure       s   stop\n");
  for (const DensestCase& of : kCases) {
    if (!only.empty() && only != of.name) continue;
    any = true;
    all_passed = print_case(of, seconds, seed) && all_passed;
  }
  if (!any) fmt::print("# no case is called {}\n", only);
  return any && all_passed;
}

}  // namespace packstone::benchmarks
