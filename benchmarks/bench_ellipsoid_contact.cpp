// Nanoseconds per call of the ellipsoid and ellipse kernels, per aspect ratio. "after broad phase":
// separation uniform in the ball in which the circumscribed balls overlap; "touching": common scale
// within 1 percent of 1. CPU time, median of nine runs.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/geometry/ellipse_contact.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"

namespace packstone {
namespace {

constexpr int kRuns = 9;

template <class A, class B>
struct Pair {
  A a;
  B b;
  Vec3 r;
};

// Also a hash of what the calls return, so that a faster answer that differs is seen.
struct Timing {
  double nanoseconds;
  double checksum;
};

template <class Pairs, class Call>
Timing measure(const Pairs& pairs, Call&& call) {
  std::array<double, kRuns> times{};
  double sum = 0.0;
  for (double& time : times) {
    sum = 0.0;
    const std::clock_t start = std::clock();
    for (const auto& pair : pairs) sum += call(pair);
    time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  std::sort(times.begin(), times.end());
  return {1e9 * times[kRuns / 2] / static_cast<double>(pairs.size()), sum};
}

template <class A, class B>
void place(Pair<A, B>& pair, double reach, bool touching, int dimension, RandomStream& random) {
  const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Vec3 d =
      dimension == 3 ? random_direction(random) : Vec3{std::cos(angle), std::sin(angle), 0.0};
  pair.r = reach * std::pow(random.uniform(), 1.0 / dimension) * d;
  if (touching) {
    pair.r = random.uniform(0.99, 1.01) / contact_scale(pair.a, pair.b, pair.r).upper * pair.r;
  }
}

template <class Pairs>
void report(const char* shapes, double aspect, const char* placing, const Pairs& pairs) {
  const Timing decided = measure(
      pairs, [](const auto& p) { return static_cast<double>(decide(p.a, p.b, p.r).verdict); });
  const Timing gaps = measure(pairs, [](const auto& p) { return gap(p.a, p.b, p.r).value; });
  const Timing scales =
      measure(pairs, [](const auto& p) { return contact_scale(p.a, p.b, p.r).lower; });
  std::printf("%-22s %6g %-18s decide %6.1f  gap %9.1f  scale %6.1f  [%.17g]\n", shapes, aspect,
              placing, decided.nanoseconds, gaps.nanoseconds, scales.nanoseconds,
              decided.checksum + gaps.checksum + scales.checksum);
}

void bench_ellipsoids(const char* shape, const Vec3& axes, double aspect, bool touching) {
  RandomStream random(1, StreamId::benchmark);
  std::vector<Pair<Ellipsoid, Ellipsoid>> pairs(4'000);
  for (auto& pair : pairs) {
    pair.a = {axes, random_rotation(random)};
    pair.b = {axes, random_rotation(random)};
    place(pair, 2.0 * aspect, touching, 3, random);
  }
  report(shape, aspect, touching ? "touching" : "after broad phase", pairs);
}

void bench_balls(double aspect, bool touching) {
  RandomStream random(2, StreamId::benchmark);
  std::vector<Pair<Sphere, Ellipsoid>> pairs(4'000);
  for (auto& pair : pairs) {
    pair.a = {1.0};
    pair.b = {{1, 1, aspect}, random_rotation(random)};
    place(pair, 1.0 + aspect, touching, 3, random);
  }
  report("sphere-ellipsoid", aspect, touching ? "touching" : "after broad phase", pairs);
}

void bench_ellipses(double aspect, bool touching) {
  RandomStream random(3, StreamId::benchmark);
  std::vector<Pair<Ellipse, Ellipse>> pairs(4'000);
  for (auto& pair : pairs) {
    pair.a = {{aspect, 1}, random.uniform(-std::numbers::pi, std::numbers::pi)};
    pair.b = {{aspect, 1}, random.uniform(-std::numbers::pi, std::numbers::pi)};
    place(pair, 2.0 * aspect, touching, 2, random);
  }
  report("ellipse-ellipse", aspect, touching ? "touching" : "after broad phase", pairs);
}

}  // namespace
}  // namespace packstone

int main() {
  using namespace packstone;
  std::printf("ns per call\n");
  for (const bool touching : {false, true}) {
    for (const double aspect : {1.2, 2.0, 5.0, 20.0, 100.0}) {
      bench_ellipsoids("ellipsoids, prolate", {1, 1, aspect}, aspect, touching);
      bench_ellipsoids("ellipsoids, oblate", {1, aspect, aspect}, aspect, touching);
      bench_ellipsoids("ellipsoids, scalene", {1, std::sqrt(aspect), aspect}, aspect, touching);
      bench_balls(aspect, touching);
      bench_ellipses(aspect, touching);
    }
  }
}
