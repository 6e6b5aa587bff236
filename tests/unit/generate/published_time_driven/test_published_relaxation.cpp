#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "support/brute_force_check.hpp"

namespace packstone {
namespace {

// As many cylinders as spheres, each half of the fraction; aspect: length over diameter.
std::vector<OrderedBody> mixture(int count_each, double fraction, double aspect,
                                 std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  const double each = 0.5 * fraction / count_each;
  std::vector<OrderedBody> bodies;
  for (int k = 0; k < 2 * count_each; ++k) {
    Body body = Sphere{1.0};
    if (k < count_each) body = Cylinder{1.0, aspect, random_direction(random)};
    bodies.push_back({scaled(body, std::cbrt(each / volume(body))), k < count_each ? 0 : 1});
  }
  return bodies;
}

TEST_CASE("ten cylinders and ten spheres at a tenth of the volume relax") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto bodies = mixture(10, 0.1, 3, seed);
    const TimeDrivenResult result =
        published_time_driven_pack({}, bodies, {.reshuffles = 0, .seed = seed});
    CHECK(result.stop == TimeDrivenStop::relaxed);
    CHECK(result.steps < 1000);
    CHECK(result.potential_energy <= 1e-6 * result.start_energy);
    CHECK(fraction(result.packing) == Approx(0.1));
    CHECK(result.packing.groups.size() == 2);
    REQUIRE(result.packing.certificate);
    CHECK(result.overlaps == result.packing.certificate->overlaps);
    CHECK(result.overlaps == test::brute_force_check(result.packing, 0.0).overlaps);
    CHECK(result.overlaps <= 3);
  }
}

TEST_CASE("spheres, whose overlap the method sees as it is, end apart") {
  for (const std::uint64_t seed : {1U, 2U}) {
    std::vector<OrderedBody> bodies(40, {Sphere{0.13}, 0});
    const TimeDrivenResult result =
        published_time_driven_pack({}, bodies, {.energy_threshold = 0.0, .seed = seed});
    CHECK(result.stop == TimeDrivenStop::relaxed);
    CHECK(result.potential_energy == 0.0);
    CHECK(result.overlaps == 0);
    CHECK(result.deepest == 0.0);
  }
}

// Pairs deeper than `depth` [L], and of these the ones that are no cylinders or that feel a force.
struct Leftovers {
  int deep = 0, other = 0;
};

Leftovers leftovers(const Packing& packing, double depth) {
  Leftovers left;
  for (const PairWitness& pair : separating_directions(packing)) {
    const Inclusion& a = packing.inclusions[static_cast<std::size_t>(pair.a)];
    const Inclusion& b = packing.inclusions[static_cast<std::size_t>(pair.b)];
    const Vec3 r = b.center - a.center + image_shift(packing.cell, pair.image);
    if (pair.gap > 0.0 || gap(a.body, b.body, r).value > -depth) continue;
    ++left.deep;
    const bool cylinders = kind(a.body) == ShapeKind::cylinder && kind(a.body) == kind(b.body);
    bool feels = false;
    const PublishedForces forces = published_forces(a.body, b.body, r);
    for (const auto& force : forces) feels = feels || norm(force.on_a) > depth;
    left.other += !cylinders || feels;
  }
  return left;
}

TEST_CASE("at half of the volume the method is content while cylinders stand in each other") {
  int relaxed = 0, overlapping = 0;
  double deepest = 0.0;
  Leftovers left;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const auto bodies = mixture(20, 0.5, 3, seed);
    const TimeDrivenResult result = published_time_driven_pack({}, bodies, {.seed = seed});
    relaxed += result.stop == TimeDrivenStop::relaxed;
    overlapping += result.overlaps > 0;
    const double radius = std::get<Cylinder>(bodies[0].body).radius;
    deepest = std::max(deepest, result.deepest / radius);
    const Leftovers here = leftovers(result.packing, 1e-3 * radius);
    left.deep += here.deep;
    left.other += here.other;
    CHECK(result.potential_energy < 1e-9 * result.start_energy);
  }
  CHECK(relaxed >= 3);
  CHECK(overlapping >= 3);
  CHECK(deepest > 0.05);
  // All that is left is what the tests of cylinders do not see.
  CHECK(left.deep > 5);
  CHECK(left.other == 0);
}

TEST_CASE("to the letter the energy does not go away, since spheres and cylinders attract") {
  const auto bodies = mixture(10, 0.3, 3, 1);
  const TimeDrivenResult result = published_time_driven_pack(
      {}, bodies, {.literal = true, .reshuffles = 0, .max_steps = 3000, .seed = 1});
  CHECK(result.stop != TimeDrivenStop::relaxed);
  CHECK(result.potential_energy > 0.1 * result.start_energy);
  CHECK(result.overlaps > 3);
}

TEST_CASE("with damping the energy decays, and the factor on forces grows with it") {
  const TimeDrivenResult result =
      published_time_driven_pack({}, mixture(10, 0.4, 3, 5), {.history_every = 5, .seed = 5});
  REQUIRE(result.history.size() > 5);
  double least = std::numeric_limits<double>::infinity();
  int rises = 0;
  for (std::size_t k = 0; k < result.history.size(); ++k) {
    const TimeDrivenSample& sample = result.history[k];
    rises += sample.potential_energy > 1.5 * least && sample.potential_energy > 1e-6 * least;
    least = std::min(least, sample.potential_energy);
    CHECK_FALSE(sample.overlap_measured);
    if (k > 0) CHECK(sample.force_factor >= result.history[k - 1].force_factor);
    if (k > 0) CHECK(sample.time > result.history[k - 1].time);
  }
  CHECK(result.history[0].potential_energy == result.start_energy);
  CHECK(result.history[3].potential_energy < 0.5 * result.start_energy);
  CHECK(result.history.back().force_factor == 8.0);
  CHECK(3 * rises <= static_cast<int>(result.history.size()));
}

TEST_CASE("without rescaling the last overlaps take longer") {
  std::int64_t plain = 0, rescaled = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto bodies = mixture(10, 0.5, 3, seed);
    plain += published_time_driven_pack({}, bodies, {.rescale = 1.0, .seed = seed}).steps;
    rescaled += published_time_driven_pack({}, bodies, {.seed = seed}).steps;
  }
  CHECK(plain > 2 * rescaled);
}

TEST_CASE("the overlap volume goes down with the energy, but not to zero where overlaps remain") {
  const TimeDrivenResult result = published_time_driven_pack(
      {}, mixture(10, 0.4, 3, 2), {.history_every = 5, .overlap_volume_every = 2, .seed = 2});
  const TimeDrivenSample& first = result.history.front();
  CHECK(first.overlap_measured);
  CHECK(first.overlap_volume.value > 0.02);
  CHECK(first.overlap_volume.error < 0.1 * first.overlap_volume.value);
  CHECK_FALSE(result.history[1].overlap_measured);
  CHECK(result.history[4].overlap_volume.value < 0.5 * first.overlap_volume.value);
}

// Far more than fits: nothing to gain by shaking.
TEST_CASE("a run without hope stagnates after the reshuffles it was given") {
  const std::vector<OrderedBody> bodies(30, {Sphere{0.2}, 0});
  const TimeDrivenOptions options{.stagnation_steps = 100, .reshuffles = 2, .reshuffle_steps = 50};
  const TimeDrivenResult result = published_time_driven_pack({}, bodies, options);
  CHECK(result.stop == TimeDrivenStop::stagnated);
  CHECK(result.reshuffles == 2);
  CHECK(result.steps >= 400);
  CHECK(result.potential_energy > 0.0);
  CHECK(result.overlaps > 10);
  double hottest = 0.0;
  for (const auto& sample : result.history) hottest = std::max(hottest, -sample.friction);
  CHECK(hottest > 0.0);
}

TEST_CASE("between walls bodies end inside") {
  const Cell cell{3, {1, 1, 1}, {true, false, false}};
  const TimeDrivenResult result =
      published_time_driven_pack(cell, mixture(8, 0.2, 2, 3), {.seed = 3});
  CHECK(result.stop == TimeDrivenStop::relaxed);
  for (const WallCrossing& crossing : wall_crossings(result.packing)) CHECK(crossing.depth < 1e-5);
}

TEST_CASE("the same seed gives the same bits, another one other bits") {
  const auto bodies = mixture(10, 0.4, 3, 1);
  const auto first = published_time_driven_pack({}, bodies, {.seed = 1});
  const auto again = published_time_driven_pack({}, bodies, {.seed = 1}, RunContext().threads(3));
  CHECK(first.packing.inclusions == again.packing.inclusions);
  CHECK(first.potential_energy == again.potential_energy);
  const auto other = published_time_driven_pack({}, bodies, {.seed = 2});
  CHECK(first.packing.inclusions != other.packing.inclusions);
}

TEST_CASE("a relaxed packing stays as it is when relaxed again, orientations and groups too") {
  auto once = published_time_driven_pack({}, mixture(5, 0.1, 3, 1), {.energy_threshold = 0.0});
  once.packing.groups = {"rods", "balls"};
  const auto twice = published_time_driven_relax(once.packing, {.energy_threshold = 0.0});
  CHECK(twice.steps == 0);
  CHECK(twice.packing.inclusions == once.packing.inclusions);
  CHECK(twice.packing.groups == once.packing.groups);
}

TEST_CASE("a run stops when asked, and says so") {
  const auto bodies = mixture(10, 0.5, 3, 1);
  const auto few = published_time_driven_pack({}, bodies, {.max_steps = 3});
  CHECK(few.stop == TimeDrivenStop::steps_used_up);
  CHECK(few.steps == 3);
  CHECK(few.history.size() == 2);
  std::atomic<bool> cancel = true;
  CHECK(published_time_driven_pack({}, bodies, {}, RunContext().cancel_flag(&cancel)).stop ==
        TimeDrivenStop::cancelled);
  const RunContext late = RunContext().deadline(RunContext::Clock::now());
  CHECK(published_time_driven_pack({}, bodies, {}, late).stop == TimeDrivenStop::out_of_time);
  int reports = 0;
  RunContext listening;
  listening.on_progress([&](const Progress& progress) {
    ++reports;
    CHECK(progress.fraction == Approx(0.5));
  });
  CHECK(published_time_driven_pack({}, bodies, {}, listening).steps > 0);
  CHECK(reports >= 1);
  CHECK(name(TimeDrivenStop::steps_used_up) == "steps_used_up");
}

void refuses(const TimeDrivenOptions& options, const char* words) {
  const auto bodies = mixture(2, 0.1, 3, 1);
  CHECK_THROWS_WITH(published_time_driven_pack({}, bodies, options), Catch::Contains(words));
  CHECK_THROWS_AS(published_time_driven_pack({}, bodies, options), InvalidArgument);
}

TEST_CASE("options out of range are refused, with name, value and range") {
  refuses({.time_step = 0.0}, "TimeDrivenOptions::time_step is 0; it must be in (0, 1]");
  refuses({.damping = -1.0}, "damping is -1; it must be a number >= 0");
  refuses({.berendsen = std::nan("")}, "berendsen is nan");
  refuses({.berendsen_temperature = -1.0}, "berendsen_temperature is -1");
  refuses({.nose_hoover = -2.0}, "nose_hoover is -2");
  refuses({.nose_hoover_temperature = -0.5}, "nose_hoover_temperature is -0.5");
  refuses({.stagnation_steps = 0}, "stagnation_steps is 0; it must be >= 1");
  refuses({.stagnation_drop = 1.0}, "stagnation_drop is 1; it must be in (0, 1)");
  refuses({.reshuffles = -1}, "reshuffles is -1; it must be >= 0");
  refuses({.reshuffle_steps = 0}, "reshuffle_steps is 0");
  refuses({.rescale = 0.5}, "rescale is 0.5; it must be a number >= 1");
  refuses({.rescale_limit = 0.0}, "rescale_limit is 0; it must be in [1, 1e4]");
  refuses({.rescale_limit = 200.0}, "rescale_limit is 200; it must be below 1 / time_step^2");
  refuses({.energy_threshold = -1.0}, "energy_threshold is -1");
  refuses({.max_steps = -1}, "max_steps is -1");
  refuses({.history_every = 0}, "history_every is 0");
  refuses({.overlap_volume_every = -1}, "overlap_volume_every is -1");
  refuses({.overlap_points = 5}, "overlap_points is 5; it must be even, in [2, 512]");
}

TEST_CASE("orders that the method cannot treat are refused before any work") {
  const auto refused = [](const Cell& cell, const std::vector<OrderedBody>& bodies,
                          const char* words) {
    CHECK_THROWS_WITH(published_time_driven_pack(cell, bodies), Catch::Contains(words));
  };
  refused({}, {}, "0 bodies");
  refused({}, std::vector<OrderedBody>(2001, {Sphere{0.01}, 0}), "2001 bodies");
  refused(cell_2d(1, 1), {{Disk{0.1}, 0}}, "dimension is 2");
  refused({}, {{Ellipsoid{{0.1, 0.1, 0.2}, {}}, 0}}, "body 0 is a ellipsoid");
  refused({}, {{Sphere{0.6}, 0}}, "body 0");
  refused({}, {{Sphere{0.1}, -1}}, "group is -1");
  Packing packing;
  packing.inclusions = {{{0.5, 0.5, 0.5}, Sphere{0.1}}};
  CHECK_THROWS_AS(published_time_driven_relax(packing), InvalidArgument);
  CHECK_THROWS_WITH(overlap_volume(packing, 7), Catch::Contains("points is 7"));
}

}  // namespace
}  // namespace packstone
