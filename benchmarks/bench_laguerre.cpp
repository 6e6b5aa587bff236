// Laguerre tessellations: the published method, measures as ordered, shapes as ordered.
//
//   bench_laguerre plain    [grains] [threads]            ellipses of aspect 2.2, 11 circles each
//   bench_laguerre measures [grains] [aspect] [threads]
//   bench_laguerre shapes   [grains] [aspect] [fraction] [rounds] [connected 0|1] [threads]
//                           packed by advancing layers
//   bench_laguerre volumes  [spheres] [threads]           in space, log-normal diameters
//
// Areas are uniform over a range of 1 to 10, angles uniform, the box periodic. Times are those of
// the tessellation alone; errors as in LaguerreErrors, angles in degrees.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/advancing_layer.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/tessellate/laguerre.hpp"
#include "timing.hpp"

namespace {

using namespace packstone;
using std::numbers::pi;

std::vector<OrderedBody> ellipses(int count, double aspect, double fraction) {
  RandomStream random(1, StreamId::test, 0);
  std::vector<double> areas;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += areas.emplace_back(random.uniform(1.0, 10.0));
  std::vector<OrderedBody> bodies;
  for (const double area : areas) {
    const double b = std::sqrt(area / sum * fraction / (pi * aspect));
    bodies.push_back({Ellipse{{aspect * b, b}, random.uniform(-pi / 2, pi / 2)}, 0});
  }
  return bodies;
}

std::vector<OrderedBody> spheres(int count, double fraction) {
  RandomStream random(1, StreamId::test, 0);
  std::vector<double> radii;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double r = radii.emplace_back(std::exp(random.uniform(-0.7, 0.7)));
    sum += 4.0 / 3.0 * pi * r * r * r;
  }
  std::vector<OrderedBody> bodies;
  for (const double r : radii) bodies.push_back({Sphere{r * std::cbrt(fraction / sum)}, 0});
  return bodies;
}

Packing packed(const Cell& box, const std::vector<OrderedBody>& bodies) {
  RunContext run;
  run.time_limit(120.0);
  RelaxationResult result =
      relaxation_pack(box, bodies, {.turn = {RelaxationTurn::locked}, .seed = 1}, run);
  fmt::print("# packing: {} bodies, {:.3f}, {}\n", bodies.size(), fraction(result.packing),
             name(result.stop));
  return std::move(result.packing);
}

Packing layered(const Cell& box, const std::vector<OrderedBody>& bodies) {
  const double before = benchmarks::processor_seconds();
  ConstructiveResult result = advancing_layer_pack(box, bodies, {.seed = 1});
  result.packing.groups = {"grains"};
  fmt::print("# packing: {} bodies, {:.3f}, {}, {:.1f} s\n", result.packing.inclusions.size(),
             fraction(result.packing), name(result.stop), benchmarks::processor_seconds() - before);
  return std::move(result.packing);
}

std::uint64_t hash_of(const Tessellation& t) {
  std::uint64_t hash = 14695981039346656037U;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211U; };
  for (const Vec3& v : t.vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &v[a], sizeof bits);
      add(bits);
    }
  }
  for (const FacetCorner& c : t.corners) add(static_cast<std::uint64_t>(c.vertex));
  for (const Facet& f : t.facets) add(static_cast<std::uint64_t>(f.outer));
  return hash;
}

void print_errors(const char* of, const LaguerreErrors& e) {
  constexpr double kDegrees = 180.0 / pi;
  fmt::print(
      "{:10} spread {:.4f} largest {:.1e} aspect {:.4f} +- {:.4f} angle {:.2f}, 95 % {:.2f}, "
      "offset {:.2f}, largest {:.2f}, in parts {}, empty {}\n",
      of, e.measure_spread, e.largest_measure_error, e.aspect_mean, e.aspect_spread,
      kDegrees * e.angle_mean, kDegrees * e.angle_p95, e.offset_mean, e.largest_offset, e.in_parts,
      e.empty);
}

void run(const Packing& packing, const LaguerreOptions& options, int threads) {
  const double before = benchmarks::processor_seconds();
  const auto begin = RunContext::Clock::now();
  const LaguerreResult result =
      laguerre_tessellate(packing, options, RunContext{}.threads(threads));
  const std::chrono::duration<double> elapsed = RunContext::Clock::now() - begin;
  const double seconds = benchmarks::processor_seconds() - before;
  CompensatedSum sum;
  for (const CellShape& shape : result.shapes) sum.add(shape.measure);
  const LaguerreReport& report = result.report;
  fmt::print(
      "{:.3f} s by the clock, {:.3f} s of processors, {} sites, {} hidden, {} facets, {} Newton "
      "steps, {} diagrams, stop {}, "
      "sum - 1 {:.1e}, hash {:016x}\n",
      elapsed.count(), seconds, report.sites, report.hidden_sites,
      result.tessellation.facets.size(), report.newton_steps, report.diagrams,
      static_cast<int>(result.stop), sum.value() / volume(packing.cell) - 1.0,
      hash_of(result.tessellation));
  print_errors("published", report.published);
  print_errors("made", report.made);
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, double otherwise) {
    return argc > k ? std::stod(argv[k]) : otherwise;
  };
  const auto whole = [&](int k, int otherwise) { return static_cast<int>(number(k, otherwise)); };
  const std::string what = argc > 1 ? argv[1] : "plain";
  const Cell square = cell_2d(1, 1);
  if (what == "plain") {
    run(packed(square, ellipses(whole(2, 10000), 2.2, 0.75)), published_laguerre(), whole(3, 1));
  } else if (what == "measures") {
    run(packed(square, ellipses(whole(2, 10000), number(3, 2.0), 0.75)), {}, whole(4, 1));
  } else if (what == "shapes") {
    const Packing packing =
        layered(square, ellipses(whole(2, 5000), number(3, 2.0), number(4, 0.815)));
    run(packing, {.connected = whole(6, 1) != 0, .shape_rounds = whole(5, 12)}, whole(7, 1));
  } else if (what == "volumes") {
    run(packed(Cell{}, spheres(whole(2, 10000), 0.55)), {}, whole(3, 2));
  } else {
    fmt::print(stderr, "bench_laguerre plain|measures|shapes|volumes\n");
    return 2;
  }
  return 0;
}
