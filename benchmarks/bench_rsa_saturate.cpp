// Random sequential adsorption of equal balls on one core: processor time, and a hash of the state.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <numbers>
#include <vector>

#include "generate/rsa/equal_balls.hpp"
#include "scenes.hpp"

using namespace packstone;

namespace {

struct Case {
  const char* name;
  int dimension;
  double count;     // Bodies expected.
  double fraction;  // Sets the radius.
  bool saturate;
  double bar;  // Seconds allowed.
};

double radius_of(const Case& c) {
  const double one = c.fraction / c.count;
  return c.dimension == 2 ? std::sqrt(one / std::numbers::pi)
                          : std::cbrt(0.75 * one / std::numbers::pi);
}

Packing packing_of(const rsa::EqualBallsOrder& order, const std::vector<Vec3>& centers) {
  Packing packing;
  packing.cell = order.cell;
  packing.groups = {"balls"};
  const Body body =
      order.cell.dimension == 2 ? Body(Disk{order.radius}) : Body(Sphere{order.radius});
  for (const Vec3& center : centers) packing.inclusions.push_back({center, body, 0});
  return packing;
}

void measure(const Case& c, int runs) {
  std::vector<double> seconds;
  rsa::EqualBallsOrder order;
  order.cell = c.dimension == 2 ? cell_2d(1, 1) : Cell{};
  order.radius = radius_of(c);
  if (!c.saturate) order.target = static_cast<std::int64_t>(c.count);
  rsa::EqualBallsRun last;
  for (int k = 0; k < runs; ++k) {
    const std::clock_t start = std::clock();
    last = rsa::rsa_equal_balls(order, RunContext().threads(1));
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  const Packing packing = packing_of(order, last.centers);
  std::printf(
      "%-28s %8zu placed  fraction %.5f  %9lld trials  %6.3f s  bar %4.1f s  ratio %4.1f  "
      "hash %016llx\n",
      c.name, last.centers.size(), fraction(packing), static_cast<long long>(last.trials), median,
      c.bar, c.bar / median, static_cast<unsigned long long>(scenes::state_hash(packing)));
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  measure({"disks 10^6 saturated", 2, 1e6, 0.547067, true, 8.0}, runs);
  measure({"spheres 10^5 saturated", 3, 1e5, 0.38413, true, 4.0}, runs);
  measure({"spheres 10^5 at 0.30", 3, 1e5, 0.30, false, 1.0}, runs);
  measure({"disks 10^4 saturated", 2, 1e4, 0.547067, true, 0.08}, runs);
  measure({"spheres 10^4 saturated", 3, 1e4, 0.38413, true, 0.4}, runs);
}
