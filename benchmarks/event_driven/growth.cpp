// Table 2, figures 2 to 5 and 7 to 9, and large numbers: growth to a given fraction.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include "event_driven/common.hpp"
#include "ghossein_2013.hpp"
#include "growth_scenes.hpp"
#include "scenes.hpp"

namespace packstone::benchmarks {
namespace {

using scenes::EllipsoidScene;

GrowthStatistics grow_scene(const EllipsoidScene& scene, int seeds) {
  GrowthStatistics statistics;
  for (int k = 1; k <= seeds; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    statistics.add(grow({}, scenes::ellipsoids(scene, seed), {.seed = seed}));
  }
  return statistics;
}

const PrintedGrowth* printed(const EllipsoidScene& scene) {
  const auto at = std::find_if(kGhosseinTable2.begin(), kGhosseinTable2.end(),
                               [&](const PrintedGrowth& row) { return row.scene == scene.name; });
  return at == kGhosseinTable2.end() ? nullptr : &*at;
}

void print_head(int seeds, const char* mode) {
  fmt::print("# {} seeds; processor time of one thread\n", seeds);
  fmt::print("# {:<7} {:<11} {:>5} {:>5} {:>8} {:>9} {:>9} {:>7} {:>6} {:>10} {:>7} {}\n", mode,
             "scene", "N", "V_f", "paper-s", "median-s", "max-s", "ratio", "aim-s", "collisions",
             "passed", "hash");
}

// Returns the median [s].
double print_scene(const char* mode, const EllipsoidScene& scene, double aim, int seeds,
                   bool& all_passed) {
  const GrowthStatistics of = grow_scene(scene, seeds);
  const PrintedGrowth* paper = printed(scene);
  const double seconds = median(of.seconds);
  const double paper_s = paper == nullptr ? 0.0 : paper->seconds;
  fmt::print("{:<9} {:<11} {:5} {:5.2f} {} {:9.4f} {:9.4f} {} {:6.2f} {:10.0f} {:>7} {:016x}\n",
             mode, scene.name, scene.count, scene.fraction, or_dash(paper_s, "8.1f", 8), seconds,
             of.slowest(), or_dash(paper_s / seconds, "7.0f", 7), aim, median(of.collisions),
             fmt::format("{}/{}", of.reached, seeds), of.hash);
  std::fflush(stdout);
  all_passed = all_passed && of.reached == seeds;
  return seconds;
}

// Time against one quantity.
bool print_curve(const char* figure, const std::vector<EllipsoidScene>& curve, int seeds) {
  bool all_passed = true;
  for (const EllipsoidScene& scene : curve) {
    const GrowthStatistics of = grow_scene(scene, seeds);
    const double mean = std::accumulate(of.seconds.begin(), of.seconds.end(), 0.0) / seeds;
    fmt::print("curve {} {:6} {:5.2f} {:5.1f} {:10.5f} {:10.5f} {:10.0f} {:>7} {:016x}\n", figure,
               scene.count, scene.fraction, scene.r_1[0], mean, median(of.seconds),
               median(of.collisions), fmt::format("{}/{}", of.reached, seeds), of.hash);
    std::fflush(stdout);
    all_passed = all_passed && of.reached == seeds;
  }
  return all_passed;
}

EllipsoidScene prolate(int count, double fraction, double aspect) {
  return scenes::alike("prolate", count, fraction, aspect, aspect);
}

struct CountAim {
  std::int64_t count;
  double fraction;
  double aim_s;  // 0: none.
};

// Returns the median [s].
double print_count(const CountAim& at, bool& all_passed) {
  const int seeds = at.count >= 100'000 ? 1 : at.count >= 10'000 ? 3 : 7;
  GrowthStatistics of;
  for (int k = 1; k <= seeds; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    const auto bodies = scenes::equal_ellipsoids(at.count, at.fraction, 2.0, seed);
    of.add(grow({}, bodies, {.seed = seed}));
  }
  const double seconds = median(of.seconds);
  fmt::print("scaling {:8} {:5.2f} {:10.4f} {:10.4f} {} {:9.2f} {:8} {:>6} {:016x}\n", at.count,
             at.fraction, seconds, of.slowest(), or_dash(at.aim_s, "7.2f", 7),
             1e6 * seconds / static_cast<double>(at.count), peak_megabytes(),
             fmt::format("{}/{}", of.reached, seeds), of.hash);
  std::fflush(stdout);
  all_passed = all_passed && of.reached == seeds;
  return seconds;
}

}  // namespace

bool run_table_2(int seeds) {
  constexpr double aim_each = 0.15, aim_sum = 0.4;
  bool all_passed = true;
  double sum = 0.0, paper_sum = 0.0;
  print_head(seeds, "table2");
  for (const EllipsoidScene& scene : scenes::ghossein_table_2()) {
    sum += print_scene("table2", scene, aim_each, seeds, all_passed);
  }
  for (const PrintedGrowth& row : kGhosseinTable2) paper_sum += row.seconds;
  fmt::print("table2    {:<11} {:5} {:>5} {:8.1f} {:9.4f} {:>9} {:7.0f} {:6.2f}\n", "sum", "-", "-",
             paper_sum, sum, "-", paper_sum / sum, aim_sum);
  return all_passed;
}

bool run_figures(int seeds) {
  constexpr double aim = 0.3;
  bool all_passed = true;
  print_head(seeds, "figures");
  for (const EllipsoidScene& scene : scenes::ghossein_figures()) {
    print_scene("figures", scene, aim, seeds, all_passed);
  }
  return all_passed;
}

bool run_curves(int seeds, int most) {
  bool all_passed = true;
  fmt::print("# {} seeds; processor time of one thread\n", seeds);
  fmt::print("# fig        N   V_f   R_1     mean-s   median-s collisions  passed hash\n");
  const double kinds[][2] = {{0.1, 2}, {0.3, 2}, {0.5, 2}, {0.1, 10}, {0.2, 10}};
  for (const auto& [fraction, aspect] : kinds) {
    std::vector<EllipsoidScene> curve;
    for (const int count : {10, 30, 100, 300, 1000, 3000, 10000}) {
      if (count <= most) curve.push_back(prolate(count, fraction, aspect));
    }
    all_passed = print_curve("fig-7", curve, seeds) && all_passed;
  }
  for (const int count : {50, 100, 200, 500}) {
    std::vector<EllipsoidScene> curve;
    for (int k = 1; k <= 6; ++k) curve.push_back(prolate(count, 0.1 * k, 2));
    all_passed = print_curve("fig-8", curve, seeds) && all_passed;
  }
  for (const int count : {100, 200, 500}) {
    std::vector<EllipsoidScene> curve;
    for (const int aspect : {1, 2, 3, 5, 7, 10, 15, 20, 30, 40}) {
      curve.push_back(prolate(count, 0.1, aspect));
    }
    all_passed = print_curve("fig-9", curve, seeds) && all_passed;
  }
  return all_passed;
}

bool run_scaling(std::int64_t largest) {
  bool all_passed = true;
  fmt::print("# ellipsoids of aspect 2; processor time of one thread, median\n");
  fmt::print("#           N   V_f   median-s      max-s   aim-s   us-each  peak-MB passed hash\n");
  std::vector<double> counts, seconds;
  const CountAim points[] = {
      {100, 0.5, 0}, {1000, 0.5, 0.08}, {10'000, 0.5, 0.9}, {100'000, 0.5, 12}};
  for (const CountAim& at : points) {
    if (at.count > largest) break;
    counts.push_back(static_cast<double>(at.count));
    seconds.push_back(print_count(at, all_passed));
  }
  fmt::print("scaling exponent {:.3f} aim {:.2f}\n", log_slope(counts, seconds), 1.1);
  if (largest >= 1'000'000) print_count({1'000'000, 0.3, 0}, all_passed);
  return all_passed;
}

}  // namespace packstone::benchmarks
