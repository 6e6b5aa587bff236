#include "generate/published_event_driven/contact_search.hpp"

#include <catch2/catch.hpp>

#include "moving_pairs.hpp"

namespace packstone {
namespace {

using namespace moving_pairs;
using published::Clock;
using published::collision_forecast;
using published::Forecast;

// Of pairs that collide soon: those whose neighborhoods the table calls separate.
double skipped_percent(const Vec3& shape, PublishedForm table, int pairs, std::uint64_t seed) {
  int skipped = 0;
  for (const MovingPair& touching : touching_pairs(shape, 0.5, pairs, seed)) {
    const MovingPair before = moved(touching, -1e-4);
    PublishedCounts counts;
    const Clock clock{.now = 1.0, .end = 2.0};
    const PublishedOptions options{.table = table, .skipped_pairs = kPrinted};
    const Forecast forecast =
        collision_forecast(before.first, before.second, clock, options, counts);
    skipped += !forecast.event && counts.skipped == 1;
  }
  return 100.0 * skipped / pairs;
}

TEST_CASE("the neighborhood test skips pairs of flat bodies about to collide") {
  CHECK(skipped_percent({2, 1, 1}, kPrinted, 100, 73) == 0.0);
  CHECK(skipped_percent({10, 10, 1}, kPrinted, 300, 74) > 2.0);
  CHECK(skipped_percent({40, 40, 1}, kPrinted, 300, 75) > 10.0);
  CHECK(skipped_percent({40, 40, 1}, PublishedForm::corrected, 300, 75) == 0.0);
}

TEST_CASE("a skipped pair is looked at again in time, as printed it never is") {
  // Spheres meet and neighborhoods are apart now; a collision near 0.6.
  const MovingEllipsoid a{.semi_axes = {1, 0.5, 0.5}};
  const MovingEllipsoid b{
      .center = {0.1, 1.7, 0}, .velocity = {0, -1, 0}, .semi_axes = {1, 0.6, 0.5}};
  PublishedCounts counts;
  const auto forecast = [&](PublishedForm form, double next) {
    const Clock clock{.now = 0.0, .next = next, .end = 10.0};
    return collision_forecast(a, b, clock, {.skipped_pairs = form}, counts);
  };
  CHECK(forecast(PublishedForm::corrected, 10.0).event);
  CHECK(forecast(PublishedForm::corrected, 10.0).time == Approx(0.6).margin(0.02));
  const Forecast set_aside = forecast(PublishedForm::corrected, 0.05);
  CHECK_FALSE(set_aside.event);
  CHECK(set_aside.time == 0.05);
  CHECK(needs_search(set_aside, 0.4, {}));
  const Forecast printed = forecast(kPrinted, 10.0);
  CHECK_FALSE(printed.event);
  CHECK_FALSE(needs_search(printed, 10.0, {.skipped_pairs = kPrinted}));
}

}  // namespace
}  // namespace packstone
