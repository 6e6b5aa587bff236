/// Time of the pair kernels after the broad phase: ns per call on one core, median of five runs.
///
///     bench_contact [pairs per class]
///
/// random: bounding spheres overlap, offset uniform. touching: gap within 1 % of the smaller
/// radius.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

using namespace packstone;

namespace {

struct Pair {
  Body a;
  Body b;
  Vec3 r;
};

class Draw {
 public:
  double uniform(double low, double high) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * (static_cast<double>(state_ >> 11) * 0x1p-53);
  }
  Vec3 direction(int dimension) {
    const double phi = uniform(0, 2 * std::numbers::pi);
    const double z = dimension == 2 ? 0.0 : uniform(-1, 1);
    const double rho = std::sqrt(1 - z * z);
    return {rho * std::cos(phi), rho * std::sin(phi), z};
  }
  Quaternion rotation() {
    for (;;) {
      const Quaternion q{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (norm(q) < 1) return normalized(q);
    }
  }

 private:
  std::uint64_t state_ = 12345;
};

Body make_body(ShapeKind kind, double aspect, Draw& draw) {
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{1};
    case ShapeKind::ellipsoid:
      return Ellipsoid{{1, std::sqrt(aspect), aspect}, draw.rotation()};
    case ShapeKind::cylinder:
      return Cylinder{1, aspect, draw.direction(3)};
    case ShapeKind::spherocylinder:
      return Spherocylinder{1, aspect, draw.direction(3)};
    case ShapeKind::disk:
      return Disk{1};
    default:
      return Ellipse{{1, aspect}, draw.uniform(0, 3)};
  }
}

std::vector<Pair> make_pairs(ShapeKind kind_a, ShapeKind kind_b, double aspect, bool touching,
                             int count) {
  Draw draw;
  std::vector<Pair> pairs(count);
  const int dim = dimension(kind_a);
  for (Pair& p : pairs) {
    p = {make_body(kind_a, aspect, draw), make_body(kind_b, aspect, draw), {}};
    const double reach = circum_radius(p.a) + circum_radius(p.b);
    p.r = reach * std::pow(draw.uniform(0, 1), 1.0 / dim) * draw.direction(dim);
    if (!touching) continue;
    p.r = p.r / contact_scale(p.a, p.b, p.r).lower;
    const Gap contact = gap(p.a, p.b, p.r);
    p.r += draw.uniform(-0.01, 0.01) * std::min(in_radius(p.a), in_radius(p.b)) * contact.normal;
  }
  return pairs;
}

template <class Kernel>
double median_ns(const std::vector<Pair>& pairs, Kernel&& kernel) {
  std::array<double, 5> runs{};
  for (double& run : runs) {
    const std::clock_t start = std::clock();
    for (const Pair& p : pairs) kernel(p);
    run = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC /
          static_cast<double>(pairs.size());
  }
  std::sort(runs.begin(), runs.end());
  return runs[2];
}

struct Count {
  long separated = 0;
  long undecided = 0;
};

void report(ShapeKind a, ShapeKind b, double aspect, bool touching, int count) {
  const std::vector<Pair> pairs = make_pairs(a, b, aspect, touching, count);
  Count seen;
  const double decide_ns = median_ns(pairs, [&](const Pair& p) {
    const Verdict verdict = overlap(p.a, p.b, p.r);
    seen.separated += verdict == Verdict::separated;
    seen.undecided += verdict == Verdict::undecided;
  });
  double sum = 0.0;
  const double quick_ns =
      median_ns(pairs, [&](const Pair& p) { sum += quick_gap_bound(p.a, p.b, p.r); });
  const std::vector<Pair> few(pairs.begin(), pairs.begin() + count / 20);
  const double gap_ns = median_ns(few, [&](const Pair& p) { sum += gap(p.a, p.b, p.r).value; });
  const double scale_ns =
      median_ns(few, [&](const Pair& p) { sum += contact_scale(p.a, p.b, p.r).lower; });
  std::printf("%-15s %-15s %6g %-9s %8.1f %8.1f %9.0f %9.0f %9.1f %6ld %12.5g\n",
              std::string(name(a)).c_str(), std::string(name(b)).c_str(), aspect,
              touching ? "touching" : "random", decide_ns, quick_ns, gap_ns, scale_ns,
              100.0 * static_cast<double>(seen.separated) / (5.0 * count), seen.undecided / 5, sum);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 20000;
  std::printf("%-15s %-15s %6s %-9s %8s %8s %9s %9s %9s %6s %12s\n", "a", "b", "aspect", "class",
              "decide", "quick", "gap", "scale", "% apart", "open", "sum");
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) {
      const auto kind_a = static_cast<ShapeKind>(a), kind_b = static_cast<ShapeKind>(b);
      if (dimension(kind_a) != dimension(kind_b)) continue;
      const bool round = kind_b == ShapeKind::sphere || kind_b == ShapeKind::disk;
      for (const double aspect : {0.5, 1.0, 3.0, 5.0, 25.0}) {
        if (round && aspect != 1.0) continue;
        for (const bool touching : {false, true}) report(kind_a, kind_b, aspect, touching, count);
      }
    }
  }
}
