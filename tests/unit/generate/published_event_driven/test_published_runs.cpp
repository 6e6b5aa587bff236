#include "packstone/generate/published_event_driven.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "generate/published_event_driven/audit.hpp"
#include "moving_pairs.hpp"
#include "packstone/core/error.hpp"
#include "packstone/structure/check_packing.hpp"
#include "support/validation_seed.hpp"

namespace packstone {
namespace {

using namespace moving_pairs;

// N equal ellipsoids a : a / r_1 : a / r_2 of this volume fraction.
std::vector<OrderedBody> ordered(std::size_t count, double r_1, double r_2, double fraction,
                                 std::uint64_t seed) {
  const double a_cubed =
      fraction * 3.0 * r_1 * r_2 / (4.0 * std::numbers::pi * static_cast<double>(count));
  const Vec3 semi_axes = std::cbrt(a_cubed) * Vec3{1.0, 1.0 / r_1, 1.0 / r_2};
  RandomStream random(seed, StreamId::test);
  std::vector<OrderedBody> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    bodies.push_back({Ellipsoid{semi_axes, random_rotation(random)}, 0});
  }
  return bodies;
}

Certificate check(PublishedResult result) {
  result.packing.groups = {"all"};
  return check_packing(result.packing);
}

struct Scene {
  const char* name;
  std::size_t count;
  double r_1, r_2, fraction;
};

struct Total {
  int reached = 0, passed = 0;
  double overlaps = 0.0;
  double log_heating = 0.0;  // Mean; single runs vary by a factor of 50.
  PublishedCounts counts;
};

Total run_seeds(const Scene& scene, PublishedOptions options, std::uint64_t seeds) {
  Total total;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    options.seed = validation_seed(seed);
    const PublishedResult result = published_event_driven_pack(
        kUnitCube, ordered(scene.count, scene.r_1, scene.r_2, scene.fraction, options.seed),
        options);
    const Certificate certificate = check(result);
    total.reached += result.stop == PublishedStop::target_reached;
    total.passed += certificate.passed();
    total.overlaps += static_cast<double>(certificate.overlaps);
    total.log_heating += std::log(result.heating) / static_cast<double>(seeds);
    total.counts.collisions += result.counts.collisions;
    total.counts.missed += result.counts.missed;
  }
  return total;
}

TEST_CASE("with everything corrected the method packs ellipsoids of aspect 2") {
  for (const std::uint64_t seed : {1U, 2U}) {
    const std::vector<OrderedBody> bodies = ordered(15, 2, 2, 0.25, seed);
    const PublishedOptions options{.samples = 60, .seed = seed};
    const PublishedResult result = published_event_driven_pack(kUnitCube, bodies, options);
    CHECK(result.stop == PublishedStop::target_reached);
    CHECK(result.size_factor == 1.0);
    CHECK(result.counts.collisions > 50);
    CHECK(result.counts.face_events > 50);
    CHECK(result.counts.missed == 0);
    CHECK(check(result).passed());
    CHECK(fraction(result.packing) == Approx(0.25));
    const PublishedResult again = published_event_driven_pack(kUnitCube, bodies, options);
    CHECK(again.packing.inclusions == result.packing.inclusions);
  }
}

TEST_CASE("to the letter pairs are never looked at again, and bodies grow into each other") {
  for (const std::uint64_t seed : {1U, 2U}) {
    const PublishedOptions options{.skipped_pairs = kPrinted, .seed = seed};
    const PublishedResult result =
        published_event_driven_pack(kUnitCube, ordered(15, 2, 2, 0.25, seed), options);
    CHECK(result.stop == PublishedStop::target_reached);
    CHECK(result.counts.collisions < 20);
    CHECK(result.counts.missed > 20);
    CHECK(check(result).overlaps > 5);
  }
}

TEST_CASE("bodies that collide again where they part pass through each other") {
  std::int64_t missed = 0;
  int passed = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const PublishedOptions options{.parting_roots = kPrinted, .max_events = 1000, .seed = seed};
    const PublishedResult result =
        published_event_driven_pack(kUnitCube, ordered(15, 2, 2, 0.25, seed), options);
    missed += result.counts.missed;
    passed += check(result).passed();
  }
  CHECK(missed > 20);
  CHECK(passed < 3);
}

TEST_CASE("equation 32a overheats long bodies") {
  double printed = 0.0, corrected = 0.0;
  for (const std::uint64_t seed : {1U, 2U}) {
    const std::vector<OrderedBody> bodies = ordered(10, 5, 5, 0.1, seed);
    corrected += published_event_driven_pack(kUnitCube, bodies, {.seed = seed}).heating;
    printed +=
        published_event_driven_pack(kUnitCube, bodies, {.growth_speed = kPrinted, .seed = seed})
            .heating;
  }
  CHECK(corrected > 2.0);
  CHECK(printed > 2.0 * corrected);
}

TEST_CASE("the audit sees overlaps in any image, each once") {
  // Needles in line with the next but one image of each other, clear of the nearest.
  const Vec3 r{0.4, 0.3, 0.0};
  const Quaternion along = from_axis_angle({0, 0, 1}, std::atan2(0.3, -0.6));
  const MovingEllipsoid a{.orientation = along, .semi_axes = {0.4, 0.02, 0.02}};
  MovingEllipsoid b = a;
  b.center = r;
  published::Audit audit;
  CHECK(apart({a, b}));
  CHECK(audit.new_overlaps(kUnitCube, {a, b}) == 1);
  CHECK(audit.new_overlaps(kUnitCube, {a, b}) == 0);
  b.center.z = 0.5;
  CHECK(audit.new_overlaps(kUnitCube, {a, b}) == 0);
  b.center.z = 3.0;
  CHECK(audit.new_overlaps(kUnitCube, {a, b}) == 1);
}

TEST_CASE("bad orders and options are refused before any work") {
  const std::vector<OrderedBody> bodies = ordered(5, 2, 2, 0.1, 1);
  const auto refuses = [](const Cell& cell, const std::vector<OrderedBody>& order,
                          const PublishedOptions& options, const char* words) {
    CHECK_THROWS_WITH(published_event_driven_pack(cell, order, options), Catch::Contains(words));
    CHECK_THROWS_AS(published_event_driven_pack(cell, order, options), InvalidArgument);
  };
  refuses(kUnitCube, bodies, {.samples = 0}, "samples is 0");
  refuses(kUnitCube, bodies, {.neighborhood = 0.9}, "neighborhood is 0.9");
  refuses(kUnitCube, bodies, {.growth_rate = std::nan("")}, "growth_rate is nan");
  refuses(kUnitCube, bodies, {.start_size = 1.0}, "start_size is 1");
  refuses(kUnitCube, bodies, {.max_events = -1}, "max_events is -1");
  refuses({3, {1, 1, 1}, {true, true, false}}, bodies, {}, "periodic");
  refuses(cell_2d(1, 1), bodies, {}, "3 dimensions");
  refuses(kUnitCube, {}, {}, "0 bodies");
  refuses(kUnitCube, ordered(501, 2, 2, 0.1, 1), {}, "501 bodies");
  refuses(kUnitCube, {{Cylinder{0.1, 0.1, {0, 0, 1}}, 0}}, {}, "body 0 is a cylinder");
  refuses(kUnitCube, {{Sphere{0.5}, 0}}, {}, "body 0 is 1 long");
  refuses(kUnitCube, {{Sphere{0.2}, -1}}, {}, "group is -1");
  refuses(kUnitCube, {{Sphere{-0.2}, 0}}, {}, "body 0: ");
  refuses({3, {1, 1, 1}}, std::vector<OrderedBody>(3, {Sphere{0.45}, 0}), {}, "fill");
}

TEST_CASE("a run stops when asked, with the bodies at the size reached") {
  const std::vector<OrderedBody> bodies = ordered(10, 2, 2, 0.2, 1);
  const PublishedResult few = published_event_driven_pack(kUnitCube, bodies, {.max_events = 10});
  CHECK(few.stop == PublishedStop::most_events);
  CHECK(few.counts.collisions + few.counts.face_events == 10);
  CHECK(few.size_factor < 1.0);
  CHECK(fraction(few.packing) == Approx(0.2 * std::pow(few.size_factor, 3)));
  std::atomic<bool> cancel = true;
  CHECK(
      published_event_driven_pack(kUnitCube, bodies, {}, RunContext().cancel_flag(&cancel)).stop ==
      PublishedStop::cancelled);
  const RunContext late = RunContext().deadline(RunContext::Clock::now());
  CHECK(published_event_driven_pack(kUnitCube, bodies, {}, late).stop ==
        PublishedStop::out_of_time);
  CHECK(name(PublishedStop::most_events) == "most_events");
}

TEST_CASE("table of published runs, slip by slip", "[validation]") {
  constexpr Scene scenes[] = {
      {"12, 2 prolate, 0.3", 12, 2, 2, 0.3},      {"12, 5 prolate, 0.2", 12, 5, 5, 0.2},
      {"12, 10 prolate, 0.05", 12, 10, 10, 0.05}, {"20, 2 oblate, 0.3", 20, 2, 1, 0.3},
      {"20, 10 oblate, 0.15", 20, 10, 1, 0.15},   {"20, 40 oblate, 0.05", 20, 40, 1, 0.05}};
  const std::pair<const char*, PublishedOptions> forms[] = {
      {"corrected, n = 10", {.samples = 10}},
      {"corrected, n = 30", {}},
      {"corrected, n = 100", {.samples = 100}},
      {"table printed", {.table = kPrinted}},
      {"growth speed printed", {.growth_speed = kPrinted}},
      {"skipped pairs printed", {.skipped_pairs = kPrinted}},
      {"parting roots printed", {.parting_roots = kPrinted, .max_events = 5000}}};
  std::printf(
      "| bodies, fraction | form | reached | collisions | missed | overlaps | free | heat |\n");
  for (const Scene& scene : scenes) {
    for (const auto& [label, options] : forms) {
      const Total total = run_seeds(scene, options, 4);
      std::printf("| %s | %s | %d | %lld | %lld | %g | %d | %.3g |\n", scene.name, label,
                  total.reached, static_cast<long long>(total.counts.collisions),
                  static_cast<long long>(total.counts.missed), total.overlaps, total.passed,
                  std::exp(total.log_heating));
      if (options.skipped_pairs == kPrinted) CHECK(total.passed == 0);
      if (options.parting_roots == kPrinted) CHECK(total.counts.missed > 50);
      if (options.samples == 100) CHECK(total.counts.missed * 100 < total.counts.collisions);
    }
  }
}

}  // namespace
}  // namespace packstone
