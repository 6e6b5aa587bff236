// The published method, built after its pseudo-code, beside the library's on the same machine.

#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <string>

#include "event_driven/common.hpp"
#include "growth_scenes.hpp"
#include "packstone/generate/published_event_driven.hpp"
#include "packstone/structure/check_packing.hpp"

namespace packstone::benchmarks {
namespace {

using scenes::EllipsoidScene;

// Small ones, in both forms.
std::vector<EllipsoidScene> small_cases() {
  return {scenes::alike("prolate-2", 12, 0.30, 2, 2), scenes::alike("prolate-5", 12, 0.20, 5, 5),
          scenes::alike("prolate-10", 12, 0.05, 10, 10),
          scenes::alike("oblate-10", 20, 0.15, 10, 1)};
}

// Rows of table 2 of few bodies. As printed the reference finishes none of them.
std::vector<EllipsoidScene> rows_of_table_2() {
  std::vector<EllipsoidScene> rows;
  for (const EllipsoidScene& scene : scenes::ghossein_table_2()) {
    if (scene.count <= 90 && scene.r_1[0] != 5) rows.push_back(scene);
  }
  return rows;
}

PublishedOptions options_of(PublishedForm form, std::uint64_t seed) {
  PublishedOptions options;
  options.table = options.growth_speed = options.skipped_pairs = options.parting_roots = form;
  options.max_events = 100'000'000;  // Time limits the runs, not their events.
  options.seed = seed;
  return options;
}

struct Published {
  std::vector<double> seconds, events;
  int reached = 0;  // The target, overlapping or not.
  int free = 0;     // Packings at the target that pass the check.
  std::int64_t missed = 0;
};

void add_run(const EllipsoidScene& scene, PublishedForm form, std::uint64_t seed, double limit_s,
             Published& of) {
  RunContext run;
  run.time_limit(limit_s);
  const auto bodies = scenes::ellipsoids(scene, seed);
  const double begin = processor_seconds();
  PublishedResult result = published_event_driven_pack({}, bodies, options_of(form, seed), run);
  of.seconds.push_back(processor_seconds() - begin);
  of.events.push_back(static_cast<double>(result.counts.collisions + result.counts.face_events));
  const bool reached = result.stop == PublishedStop::target_reached;
  of.reached += reached ? 1 : 0;
  result.packing.groups = {"ellipsoids"};
  of.free += reached && check_packing(result.packing).passed() ? 1 : 0;
  of.missed += result.counts.missed;
}

// As printed no packing comes out free of overlap, and there is nothing to compare times of. Where
// no run reached the target the ratio is a lower bound.
void print_form(const EllipsoidScene& scene, PublishedForm form, int seeds, double limit_s,
                double ours) {
  Published of;
  for (int k = 1; k <= seeds; ++k) add_run(scene, form, static_cast<std::uint64_t>(k), limit_s, of);
  const double seconds = median(of.seconds);
  const bool printed = form == PublishedForm::printed;
  fmt::print("reference {:<11} {:4} {:5.2f} {:<9} {:10.4f} {:10.5f} {} {:8.0f} {:>7} {:>6} {:7}\n",
             scene.name, scene.count, scene.fraction, printed ? "printed" : "corrected", seconds,
             ours, or_dash(printed ? 0.0 : seconds / ours, "8.0f", 8), median(of.events),
             fmt::format("{}/{}", of.reached, seeds), fmt::format("{}/{}", of.free, seeds),
             of.missed);
  std::fflush(stdout);
}

bool print_case(const EllipsoidScene& scene, const std::vector<PublishedForm>& forms, int seeds,
                double limit_s) {
  GrowthStatistics ours;
  for (int k = 1; k <= seeds; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    ours.add(grow({}, scenes::ellipsoids(scene, seed), {.seed = seed}));
  }
  for (const auto form : forms) {
    const double limit = form == PublishedForm::printed ? 0.1 * limit_s : limit_s;  // May not end.
    print_form(scene, form, seeds, limit, median(ours.seconds));
  }
  return ours.reached == seeds;
}

}  // namespace

bool run_reference(int seeds, double limit_s) {
  bool all_passed = true;
  fmt::print(
      "# {} seeds, at most {} s each, a tenth as printed; processor time of one thread, median\n",
      seeds, limit_s);
  fmt::print(
      "#         scene          N   V_f form      reference-s     ours-s    ratio   events ");
  fmt::print("reached   free  missed\n");
  const std::vector<PublishedForm> both = {PublishedForm::corrected, PublishedForm::printed};
  for (const EllipsoidScene& scene : small_cases()) {
    all_passed = print_case(scene, both, seeds, limit_s) && all_passed;
  }
  for (const EllipsoidScene& scene : rows_of_table_2()) {
    all_passed = print_case(scene, {PublishedForm::corrected}, seeds, limit_s) && all_passed;
  }
  return all_passed;
}

}  // namespace packstone::benchmarks
