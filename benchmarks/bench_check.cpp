// check_packing() and separating_directions() on packings of 10^5 inclusions.

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"

namespace {

using namespace packstone;

double cpu_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Median processor and wall time of five runs.
template <class Work>
void time_it(const char* what, int threads, const Work& work) {
  std::vector<double> cpu, wall;
  for (int run = 0; run < 5; ++run) {
    const double cpu_start = cpu_seconds();
    const double wall_start = wall_seconds();
    work();
    cpu.push_back(cpu_seconds() - cpu_start);
    wall.push_back(wall_seconds() - wall_start);
  }
  std::sort(cpu.begin(), cpu.end());
  std::sort(wall.begin(), wall.end());
  std::printf("  %-22s %d thread%s  cpu %.3f s  wall %.3f s\n", what, threads,
              threads == 1 ? " " : "s", cpu[2], wall[2]);
}

void report(const char* name, const Packing& packing) {
  const Certificate verdict = check_packing(packing);
  std::printf("%s: %lld inclusions, fraction %.4f, state %016llx\n", name,
              static_cast<long long>(verdict.count), verdict.fraction,
              static_cast<unsigned long long>(scenes::state_hash(packing)));
  std::printf("  smallest gap %.6g +- %.1g, pairs checked %lld, %s\n", verdict.smallest_gap,
              verdict.smallest_gap_error, static_cast<long long>(verdict.pairs_checked),
              verdict.passed() ? "passed" : "NOT passed");
  for (const int threads : {1, 2}) {
    time_it("check_packing", threads,
            [&] { (void)check_packing(packing, {}, RunContext().threads(threads)); });
  }
  time_it("separating_directions", 2,
          [&] { (void)separating_directions(packing, {}, RunContext().threads(2)); });
}

}  // namespace

int main() {
  report("ellipsoids, aspect 2", scenes::jostled_ellipsoids(100'000, 0.5, 1));
  report("spheres, sizes 1 to 1000", scenes::polydisperse_spheres(100'000, 0.3, 1));
  report("needles, aspect 100", scenes::needles(20'000, 0.01, 1));
}
