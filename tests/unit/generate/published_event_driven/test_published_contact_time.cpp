#include "packstone/generate/published_event_driven.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "generate/published_event_driven/contact_search.hpp"
#include "generate/published_event_driven/root_search.hpp"
#include "moving_pairs.hpp"
#include "support/validation_seed.hpp"

namespace packstone {
namespace {

using namespace moving_pairs;

// The first time at which decide() does not find the pair apart, stepping through the horizon.
std::optional<double> scanned_contact_time(const MovingPair& pair, double horizon, int steps) {
  for (int k = 1; k <= steps; ++k) {
    if (apart(moved(pair, horizon * k / steps))) continue;
    double before = horizon * (k - 1) / steps, after = horizon * k / steps;
    while (after - before > 1e-14 * horizon) {
      const double middle = 0.5 * (before + after);
      if (middle <= before || middle >= after) break;
      (apart(moved(pair, middle)) ? before : after) = middle;
    }
    return before;
  }
  return std::nullopt;
}

struct Comparison {
  int hits = 0;     // Pairs that collide.
  int missed = 0;   // No collision found.
  int late = 0;     // A later one found.
  int phantom = 0;  // One found where the bodies do not touch from outside.

  double missed_percent() const { return 100.0 * missed / std::max(1, hits); }
  double late_percent() const { return 100.0 * late / std::max(1, hits); }
};

// published_contact_time() against the scan. A time before that of the scan is right if the bodies
// just touch then, which the scan has stepped over; to 1e-5, for next to spheres the root is not
// known better.
void compare(Comparison& comparison, const MovingPair& pair, const PublishedOptions& options,
             const std::optional<double>& truth) {
  const double horizon = passing_time(pair);
  const auto found = published_contact_time(pair.first, pair.second, horizon, options);
  const double slack = 1e-5 * horizon;
  const bool grazes = found && std::abs(gap(moved(pair, *found)).value) < 1e-5;
  comparison.hits += truth || grazes;
  comparison.missed += truth && !found;
  comparison.late += truth && found && *found > *truth + slack;
  comparison.phantom += found && !grazes;
}

template <class Draw>
std::vector<Comparison> compare_all(const Draw& draw, const std::vector<int>& samples, int pairs,
                                    std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  std::vector<Comparison> comparisons(samples.size());
  for (int i = 0; i < pairs; ++i) {
    const MovingPair pair = draw(random);
    const auto truth = scanned_contact_time(pair, passing_time(pair), 1000);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      compare(comparisons[k], pair, {.samples = samples[k]}, truth);
    }
  }
  return comparisons;
}

auto generic(const Vec3& shape, double spin) {
  return [shape, spin](RandomStream& random) { return approaching_pair(random, shape, spin); };
}

// Translating bodies with axes that make this angle.
auto aligned(const Vec3& shape, double tilt) {
  return [shape, tilt](RandomStream& random) { return approaching_pair(random, shape, 0.0, tilt); };
}

TEST_CASE("moving an ellipsoid twice is moving it once") {
  RandomStream random(61, StreamId::test);
  for (int i = 0; i < 100; ++i) {
    MovingEllipsoid start = approaching_pair(random, {3, 2, 1}, 4.0).second;
    start.velocity = random_direction(random);
    const MovingEllipsoid once = published_moved(start, 0.7);
    const MovingEllipsoid twice = published_moved(published_moved(start, 0.3), 0.4);
    CHECK(norm(once.center - twice.center) < 1e-14);
    CHECK(norm(once.semi_axes - twice.semi_axes) < 1e-14);
    CHECK(norm(rotate(once.orientation, {1, 2, 3}) - rotate(twice.orientation, {1, 2, 3})) < 1e-13);
    // A point fixed to the body moves as the angular velocity says.
    const Vec3 point = rotate(start.orientation, {0, 1, 0});
    const Vec3 after = rotate(published_moved(start, 1e-7).orientation, {0, 1, 0});
    CHECK(norm((after - point) / 1e-7 - cross(start.angular_velocity, point)) < 1e-5);
  }
  const MovingEllipsoid still{};
  CHECK(published_moved(still, 2.0) == still);
}

TEST_CASE("bounding spheres meet when equations 15 and 16 say, and part again") {
  RandomStream random(62, StreamId::test);
  int meeting = 0, parting = 0;
  for (int i = 0; i < 2000; ++i) {
    auto [a, b] = approaching_pair(random, {2, 1, 1}, 0.0);
    b.center = 4.0 * random_direction(random);
    b.velocity = 2.0 * random.uniform() * random_direction(random);
    b.growth = random.uniform() * Vec3{0.6, 0.3, 0.3};  // In proportion, as in runs.
    const auto contact = published::sphere_contact(a, b);
    const auto clearance = [&, first = a, second = b](double t) {
      const MovingPair later = moved({first, second}, t);
      return norm(separation(later)) - longest(later.first.semi_axes) -
             longest(later.second.semi_axes);
    };
    if (!contact) {
      for (int k = 0; k < 50; ++k) CHECK(clearance(k) > 0.0);
      continue;
    }
    ++meeting;
    CHECK(clearance(contact->from) == Approx(0.0).margin(1e-10 * (1.0 + contact->from)));
    CHECK(clearance(0.9 * contact->from) > 0.0);
    if (contact->to == published::kNever) continue;
    ++parting;
    CHECK(clearance(contact->to) == Approx(0.0).margin(1e-10 * (1.0 + contact->to)));
    CHECK(clearance(0.5 * (contact->from + contact->to)) < 0.0);
  }
  CHECK(meeting > 400);
  CHECK(parting > 100);
  CHECK(meeting - parting > 100);
  // Closing at just the speed of growth: the paper divides 0 by 0.
  const MovingEllipsoid a{.velocity = {1, 0, 0}, .growth = {0.5, 0.5, 0.5}};
  const MovingEllipsoid b{.center = {4, 0, 0}, .growth = {0.5, 0.5, 0.5}};
  REQUIRE(published::sphere_contact(a, b));
  CHECK(published::sphere_contact(a, b)->from == Approx(1.0));
}

TEST_CASE("generic pairs collide when a dense scan in time says") {
  for (const Vec3& shape : {Vec3{2, 1, 1}, Vec3{2, 2, 1}, Vec3{5, 2.5, 1}}) {
    const Comparison slow = compare_all(generic(shape, 0.5), {100}, 150, 63).front();
    CHECK(slow.hits > 50);
    CHECK(slow.missed == 0);
    CHECK(slow.late == 0);
    CHECK(slow.phantom == 0);
  }
}

TEST_CASE("few samples miss collisions of bodies that spin, more samples fewer") {
  const std::vector<Comparison> found = compare_all(generic({10, 10, 1}, 20.0), {10, 100}, 300, 64);
  CHECK(found[0].hits > 100);
  CHECK(found[0].missed_percent() + found[0].late_percent() > 5.0);
  CHECK(found[1].missed + found[1].late < (found[0].missed + found[0].late) / 2);
  CHECK(found[0].phantom + found[1].phantom == 0);
}

TEST_CASE("no number of samples finds collisions of spheres or of equal parallel bodies") {
  for (const auto& found : {compare_all(aligned({1, 1, 1}, 0.0), {30, 300}, 150, 65),
                            compare_all(aligned({5, 1, 1}, 0.0), {30, 300}, 150, 66)}) {
    for (const Comparison& comparison : found) {
      CHECK(comparison.hits > 50);
      CHECK(comparison.missed_percent() + comparison.late_percent() +
                100.0 * comparison.phantom / comparison.hits >
            20.0);
    }
  }
  // Axes apart by a tenth of a radian are enough.
  const Comparison tilted = compare_all(aligned({5, 1, 1}, 0.1), {300}, 150, 67).front();
  CHECK(tilted.missed + tilted.late + tilted.phantom == 0);
}

TEST_CASE("roots are looked for from where a touching pair has parted") {
  // Touches at 0 up to rounding, parts, and touches again well before the first sample at 0.1.
  const auto f = [](double t) { return t * (0.01 - t) - 1e-20; };
  const auto root = [&](PublishedForm form, double from, double to) {
    return published::first_root(f, {from, to, 10, form}, [](double) { return true; });
  };
  REQUIRE(root(PublishedForm::corrected, 0.0, 1.0));
  CHECK(*root(PublishedForm::corrected, 0.0, 1.0) == Approx(0.01));
  CHECK_FALSE(root(kPrinted, 0.0, 1.0));
  // Where samples see both, the rising root is one as printed only.
  REQUIRE(root(kPrinted, -0.001, 0.019));
  CHECK(*root(kPrinted, -0.001, 0.019) == Approx(0.0).margin(1e-15));
  CHECK(*root(PublishedForm::corrected, -0.001, 0.019) == Approx(0.01));
}

TEST_CASE("table of collisions that sampling misses", "[validation]") {
  const std::vector<int> samples{10, 30, 100};
  const auto row = [&](const char* label, const auto& draw) {
    std::printf("| %s |", label);
    int hits = 0;
    for (const Comparison& c : compare_all(draw, samples, 5000, validation_seed(68))) {
      std::printf(" %.2f / %.2f / %d |", c.missed_percent(), c.late_percent(), c.phantom);
      hits = c.hits;
    }
    std::printf(" %d\n", hits);
    CHECK(hits > 1000);
  };
  std::printf("| pairs | n = 10: missed %% / late %% / phantoms | n = 30 | n = 100 | collisions\n");
  for (const double spin : {0.5, 5.0, 20.0}) {
    std::printf("spin %g\n", spin);
    row("2 prolate", generic({2, 1, 1}, spin));
    row("10 prolate", generic({10, 1, 1}, spin));
    row("10 oblate", generic({10, 10, 1}, spin));
    row("40 oblate", generic({40, 40, 1}, spin));
    row("1 : 0.5 : 0.2", generic({5, 2.5, 1}, spin));
  }
  row("sphere", aligned({1, 1, 1}, 0.0));
  row("1 : 1.00001", aligned({1.00001, 1, 1}, 1.0));
  row("1 : 1.001", aligned({1.001, 1, 1}, 1.0));
  row("5 prolate, parallel", aligned({5, 1, 1}, 0.0));
  row("5 prolate, 1e-5 apart", aligned({5, 1, 1}, 1e-5));
  row("5 prolate, 0.1 apart", aligned({5, 1, 1}, 0.1));
}

}  // namespace
}  // namespace packstone
