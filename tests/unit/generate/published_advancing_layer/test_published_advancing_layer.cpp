#include "packstone/generate/published_advancing_layer.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "constructive_scenes.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/check_packing.hpp"
#include "printed_oracle.hpp"
#include "scenes.hpp"
#include "unit/generate/constructive/resting.hpp"

namespace packstone {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Certificate certificate_of(const ConstructiveResult& result) {
  Packing packing = result.packing;
  packing.groups = {"bodies"};
  return check_packing(packing);
}

std::vector<OrderedBody> first_of(const BodySource& supply, std::int64_t count) {
  std::vector<OrderedBody> bodies;
  for (std::int64_t k = 0; k < count; ++k) bodies.push_back(supply(k));
  return bodies;
}

// More bodies than a square for `count` holds, so that a_max is that of all.
PublishedLayerResult fill_square(const BodySource& supply, std::int64_t count, double fraction,
                                 const PublishedLayerOptions& options, bool periodic = false) {
  return published_advancing_layer_pack(scenes::cell_for(supply, count, fraction, periodic),
                                        first_of(supply, 2 * count), options);
}

std::string message_of(const Cell& cell, const std::vector<OrderedBody>& bodies,
                       const PublishedLayerOptions& options = {}) {
  try {
    static_cast<void>(published_advancing_layer_pack(cell, bodies, options));
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

// How far the packing is from what the plainest form of the algorithm places.
double distance_from_oracle(const PublishedLayerResult& result, const Cell& cell,
                            const std::vector<OrderedBody>& bodies,
                            const PublishedLayerOptions& options) {
  double largest = 0.0;
  for (const OrderedBody& ordered : bodies) {
    largest = std::max(largest, circum_radius(ordered.body));
  }
  printed_oracle::Printed oracle(cell, options.spacing, options.top_layer, largest);
  double farthest = 0.0;
  for (const Inclusion& inclusion : result.packing.inclusions) {
    const auto center = oracle.place(inclusion.body);
    if (!center) return kInfinity;
    farthest = std::max(farthest, norm(flatten(inclusion.center) - *center));
  }
  const std::size_t count = result.packing.inclusions.size();
  if (count < bodies.size() && oracle.place(bodies[count].body)) return kInfinity;
  return farthest;
}

const Cell kSquare = cell_2d(20.0, 20.0, false, false);

}  // namespace

TEST_CASE("published_advancing_layer keeps disks apart, each in contact with two") {
  const BodySource supply = scenes::lognormal_balls(2, 0.55, 48.0, 3);
  for (const bool periodic : {false, true}) {
    const PublishedLayerResult result = fill_square(supply, 800, 0.82, {}, periodic);
    CHECK(result.stop == ConstructiveStop::full);
    CHECK(certificate_of(result).passed());
    CHECK(result.overlaps.pairs == 0);
    REQUIRE(result.first_row > 5);
    const auto count = static_cast<std::int64_t>(result.packing.inclusions.size());
    for (std::int64_t i = 0; i < count; ++i) {
      const auto normals = resting::contact_normals(result.packing, i, 1e-9);
      CHECK(normals.size() >= (i == 0 && periodic ? 1 : 2));
      const Inclusion& disk = result.packing.inclusions[i];
      const bool on_floor = disk.center.y - circum_radius(disk.body) < 1e-9;
      if (i < result.first_row) CHECK(on_floor);
    }
  }
}

TEST_CASE("published_advancing_layer places what its plainest form places") {
  struct Case {
    BodySource supply;
    PublishedLayerOptions options;
  };
  const Case cases[] = {
      {scenes::lognormal_balls(2, 0.5, 20.0, 1), {.top_layer = 2.0}},
      {scenes::lognormal_balls(2, 0.2, 4.0, 1), {.top_layer = 1.1}},
      {scenes::uniform_ellipses(1.5, 10.0, 1), {.spacing = 1.0}},
      {scenes::uniform_ellipses(2.0, 4.0, 2), {.spacing = 1.0, .top_layer = 4.0}},
      {scenes::uniform_ellipses(1.3, 4.0, 3), {.spacing = 1.0, .top_layer = kInfinity}},
  };
  for (const Case& c : cases) {
    const auto bodies = first_of(c.supply, 45);
    const Cell cell = scenes::cell_for(c.supply, 28, 0.7, false);
    const PublishedLayerResult result = published_advancing_layer_pack(cell, bodies, c.options);
    CHECK(result.packing.inclusions.size() > 15);
    CHECK(distance_from_oracle(result, cell, bodies, c.options) < 1e-6);
  }
}

TEST_CASE("published_advancing_layer: true ellipses overlap, less so with finer circles") {
  const BodySource supply = scenes::uniform_ellipses(1.5, 10.0, 5);
  double before = kInfinity;
  for (const double spacing : {1.0, 0.5, 0.25, 0.1}) {
    const PublishedLayerResult result = fill_square(supply, 200, 0.8, {.spacing = spacing});
    const Certificate certificate = certificate_of(result);
    CHECK_FALSE(certificate.passed());
    CHECK(result.overlaps.pairs == certificate.overlaps);
    // Two contacts of each body, nearly every one an overlap.
    CHECK(result.overlaps.pairs > static_cast<std::int64_t>(result.packing.inclusions.size()));
    CHECK(result.overlaps.mean < result.overlaps.deepest);
    CHECK(result.overlaps.mean < 0.5 * before);
    before = result.overlaps.mean;
  }
  CHECK(before < 2e-3);
}

TEST_CASE("published_advancing_layer collapses with the printed top layer of 1.1 a_max") {
  const BodySource ellipses = scenes::uniform_ellipses(1.5, 10.0, 1);
  CHECK(fraction(fill_square(ellipses, 1200, 0.8, {.top_layer = 1.1}).packing) < 0.6);
  CHECK(fraction(fill_square(ellipses, 1200, 0.8, {.top_layer = 2.0}).packing) > 0.78);
  const BodySource disks = scenes::lognormal_balls(2, 0.8, 48.0, 1);
  CHECK(fraction(fill_square(disks, 2000, 0.82, {.top_layer = 1.1}).packing) < 0.7);
  CHECK(fraction(fill_square(disks, 2000, 0.82, {.top_layer = 2.0}).packing) > 0.8);
}

TEST_CASE("published_advancing_layer packs ellipses on a periodic axis as densely") {
  const BodySource supply = scenes::uniform_ellipses(2.0, 10.0, 7);
  const PublishedLayerResult result = fill_square(supply, 400, 0.8, {}, true);
  CHECK(fraction(result.packing) > 0.72);
  CHECK(result.overlaps.pairs == certificate_of(result).overlaps);
  CHECK(result.overlaps.deepest < 0.12);
  for (const Inclusion& inclusion : result.packing.inclusions) {
    CHECK((0.0 <= inclusion.center.x && inclusion.center.x < result.packing.cell.size.x));
  }
}

TEST_CASE("published_advancing_layer returns the bodies in the order given, and counts") {
  const BodySource supply = scenes::uniform_ellipses(1.5, 10.0, 2);
  const auto bodies = first_of(supply, 30);
  const PublishedLayerResult result =
      published_advancing_layer_pack(scenes::cell_for(supply, 60, 0.7, false), bodies);
  REQUIRE(result.stop == ConstructiveStop::target_reached);
  REQUIRE(result.packing.inclusions.size() == bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    CHECK(result.packing.inclusions[k].body == bodies[k].body);
  }
  CHECK(result.tested >= 30);
  CHECK(result.pairs_tried >= 30 - result.first_row);
}

TEST_CASE("published_advancing_layer gives the same bits again, also from an endless supply") {
  const BodySource supply = scenes::uniform_ellipses(2.0, 10.0, 4);
  const auto bodies = first_of(supply, 400);
  const Cell cell = scenes::cell_for(supply, 100, 0.75, false);
  double largest = 0.0;
  for (const OrderedBody& ordered : bodies) {
    largest = std::max(largest, circum_radius(ordered.body));
  }
  const auto hash = scenes::state_hash(published_advancing_layer_pack(cell, bodies).packing);
  CHECK(hash == scenes::state_hash(published_advancing_layer_pack(cell, bodies).packing));
  CHECK(hash ==
        scenes::state_hash(
            published_advancing_layer_fill(cell, supply, {.largest_semi_axis = largest}).packing));
}

TEST_CASE("published_advancing_layer of no bodies is an empty packing") {
  const PublishedLayerResult result = published_advancing_layer_pack(kSquare, {});
  CHECK(result.stop == ConstructiveStop::target_reached);
  CHECK(result.packing.inclusions.empty());
}

TEST_CASE("published_advancing_layer ends at the first body that the cell cannot hold") {
  const BodySource growing = [](std::int64_t k) {
    return OrderedBody{Disk{0.5 + static_cast<double>(k)}, 0};
  };
  const PublishedLayerResult result = published_advancing_layer_fill(kSquare, growing);
  CHECK(result.stop == ConstructiveStop::full);
  CHECK(result.packing.inclusions.size() < 9);
  CHECK(certificate_of(result).passed());
}

TEST_CASE("published_advancing_layer refuses what is out of range, with field, value and range") {
  const std::vector<OrderedBody> disks(3, OrderedBody{Disk{1.0}, 0});
  CHECK(message_of(kSquare, disks, {.spacing = 0.0}) ==
        "PublishedLayerOptions::spacing is 0; allowed is [0.01, 1]");
  CHECK(message_of(kSquare, disks, {.top_layer = -1.0}) ==
        "PublishedLayerOptions::top_layer is -1; allowed is a number > 0, or infinity");
  CHECK(message_of(kSquare, disks, {.largest_semi_axis = -2.0}) ==
        "PublishedLayerOptions::largest_semi_axis is -2; allowed is a number >= 0");
  CHECK_THAT(message_of(cell_2d(20.0, 20.0), disks),
             Catch::StartsWith("published_advancing_layer: Cell::periodic[1] is true"));
  CHECK(message_of(Cell{3, {9, 9, 9}, {true, true, false}}, disks) ==
        "Cell::dimension is 3; it must be 2");
  CHECK_THAT(message_of(kSquare, {{Sphere{1.0}, 0}}), Catch::Contains("dimension"));
  CHECK_THAT(message_of(kSquare, {{Disk{10.5}, 0}}), Catch::Contains("cannot stand"));
}

TEST_CASE("published_advancing_layer stops when asked to, with what stands") {
  const BodySource supply = scenes::uniform_ellipses(1.5, 10.0, 1);
  const Cell cell = scenes::cell_for(supply, 300, 0.8, false);
  const PublishedLayerOptions options{.largest_semi_axis = 3.0};
  const PublishedLayerResult all = published_advancing_layer_fill(cell, supply, options);
  std::atomic<bool> cancel{false};
  const BodySource until_100 = [&](std::int64_t k) {
    if (k == 100) cancel = true;
    return supply(k);
  };
  const PublishedLayerResult part =
      published_advancing_layer_fill(cell, until_100, options, RunContext().cancel_flag(&cancel));
  CHECK(part.stop == ConstructiveStop::cancelled);
  REQUIRE(part.packing.inclusions.size() == 101);
  for (std::size_t k = 0; k < 101; ++k) {
    CHECK(part.packing.inclusions[k] == all.packing.inclusions[k]);
  }
  CHECK(published_advancing_layer_fill(cell, supply, options, RunContext().time_limit(0.0)).stop ==
        ConstructiveStop::out_of_time);
}

TEST_CASE("true_overlaps measures pairs over all images") {
  Packing packing;
  packing.cell = cell_2d(10.0, 10.0, true, false);
  packing.inclusions = {
      {{0.5, 5, 0}, Disk{1.0}, 0}, {{8.9, 5, 0}, Disk{1.0}, 0}, {{5.0, 5, 0}, Disk{2.0}, 0}};
  const TrueOverlaps overlaps = true_overlaps(packing);
  CHECK(overlaps.pairs == 1);
  CHECK(overlaps.deepest == Approx(0.4));
  CHECK(overlaps.mean == Approx(0.4));
}

TEST_CASE("validation: published densities, and what they rest on", "[validation]") {
  // Figures 10 and 13 of MATEC Web of Conferences 80 (2016) 02004; laws only partly printed.
  double disks = 0.0;
  for (std::uint64_t seed = 1; seed <= 7; ++seed) {
    const BodySource supply = scenes::lognormal_balls(2, 0.55, 48.0, seed);
    disks += fraction(fill_square(supply, 5220, 0.82, {}).packing) / 7.0;
  }
  CHECK(disks == Approx(0.8493).margin(0.012));
  const PublishedLayerResult ellipses =
      fill_square(scenes::uniform_ellipses(4.0, 10.0, 1), 4400, 0.76, {});
  CHECK(fraction(ellipses.packing) == Approx(0.7284).margin(0.012));
  CHECK(ellipses.overlaps.deepest == Approx(0.07).margin(0.03));
}

}  // namespace packstone
