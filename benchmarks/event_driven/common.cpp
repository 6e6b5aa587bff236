#include "event_driven/common.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <utility>

#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"

namespace packstone::benchmarks {

// getrusage() would also count the program that started this one.
long peak_megabytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  long kilobytes = 0;
  while (status >> word) {
    if (word == "VmHWM:") status >> kilobytes;
  }
  return kilobytes / 1024;
}

double log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = std::log(x[k]), v = std::log(y[k]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return x.size() < 2 ? 0.0 : (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

std::string or_dash(double value, const char* specification, int width) {
  if (!(value > 0.0)) return fmt::format("{:>{}}", "-", width);
  return fmt::format(fmt::runtime(fmt::format("{{:{}}}", specification)), value);
}

// The clock of a shared machine also counts what others do; so the limit is one of processor time.
Growth grow(const Cell& cell, const std::vector<OrderedBody>& bodies,
            const EventDrivenOptions& options, double limit_s) {
  std::atomic<bool> over = false;
  const double begin = processor_seconds();
  RunContext run;
  run.threads(1).cancel_flag(&over).on_progress(
      [&](const Progress&) { over = processor_seconds() - begin > limit_s; });
  Growth growth;
  growth.result = event_driven_pack(cell, bodies, options, run);
  growth.seconds = processor_seconds() - begin;
  growth.passed = check_packing(growth.result.packing, {.min_gap = options.min_gap}).passed();
  growth.hash = scenes::state_hash(growth.result.packing);
  return growth;
}

void GrowthStatistics::add(const Growth& growth) {
  seconds.push_back(growth.seconds);
  collisions.push_back(static_cast<double>(growth.result.report.collisions));
  const bool done = growth.result.stop == EventDrivenStop::target_reached;
  reached += growth.passed && done ? 1 : 0;
  hash ^= growth.hash;
}

double GrowthStatistics::slowest() const {
  return *std::max_element(seconds.begin(), seconds.end());
}

Fluid equilibrium(const Cell& cell, const std::vector<OrderedBody>& bodies,
                  double collisions_per_body, std::uint64_t seed) {
  EventDrivenOptions options{.goal = EventDrivenGoal::equilibrium, .seed = seed};
  options.collisions_per_body = 50.0;
  MovingPacking state = event_driven_pack(cell, bodies, options).state;
  state.numbers.clear();  // Pressure and energy are counted anew.
  options.collisions_per_body = collisions_per_body;
  Fluid fluid;
  const double begin = processor_seconds();
  fluid.result = event_driven_continue(std::move(state), options);
  fluid.seconds = processor_seconds() - begin;
  return fluid;
}

}  // namespace packstone::benchmarks
