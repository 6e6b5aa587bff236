// Bodies placed block by block against bodies placed one by one: the same to the bit.

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "generate/rsa/adsorption.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

using rsa::Adsorption;
using rsa::BlockSizes;
using rsa::Search;

constexpr BlockSizes kOneByOne{.least = std::numeric_limits<std::int64_t>::max()};

struct Scene {
  const char* name;
  Cell cell;
  std::vector<OrderedBody> bodies;
  RsaOptions options;
};

struct Outcome {
  Search search = Search::placed;
  std::int64_t trials = 0;
  std::vector<Body> bodies;
  std::vector<Vec3> centers;
};

// All starts but the first have the state of those before behind them.
Outcome place_all(const Scene& scene, const BlockSizes& blocks, int threads, int starts = 1) {
  RunContext run;
  run.threads(threads);
  const auto count = static_cast<std::int64_t>(scene.bodies.size());
  std::vector<std::int64_t> order(scene.bodies.size());
  std::iota(order.begin(), order.end(), 0);
  Adsorption adsorption(scene.cell, scene.options, run, scene.bodies, order, blocks);
  Outcome outcome;
  for (int start = 0; start < starts; ++start) {
    adsorption.start(scene.options.seed + static_cast<std::uint64_t>(start));
    outcome.search = Search::placed;
    while (adsorption.placed().size() < count && outcome.search == Search::placed) {
      const auto done = static_cast<std::size_t>(adsorption.placed().size());
      outcome.search = adsorption.place_next(scene.bodies, std::span(order).subspan(done));
    }
  }
  outcome.trials = adsorption.trials();
  const rsa::PlacedBodies& placed = adsorption.placed();
  for (std::int32_t i = 0; i < placed.size(); ++i) {
    outcome.bodies.push_back(placed.body(i));
    outcome.centers.push_back(placed.center(i));
  }
  return outcome;
}

void require_same(const Outcome& a, const Outcome& b) {
  REQUIRE(a.search == b.search);
  REQUIRE(a.trials == b.trials);
  REQUIRE(a.centers.size() == b.centers.size());
  for (std::size_t i = 0; i < a.centers.size(); ++i) {
    REQUIRE(a.centers[i] == b.centers[i]);
    REQUIRE(a.bodies[i] == b.bodies[i]);
  }
}

Body random_body(int shape, double size, RandomStream& random) {
  const Quaternion q = random_rotation(random);
  const Vec3 axis = rotate(q, {0, 0, 1});
  const double angle = random.uniform(0.0, 3.0);
  switch (shape) {
    case 0:
      return Sphere{size};
    case 1:
      return Ellipsoid{{size, 0.5 * size, 0.7 * size}, q};
    case 2:
      return Cylinder{0.4 * size, 1.2 * size, axis};
    case 3:
      return Spherocylinder{0.4 * size, 1.2 * size, axis};
    case 4:
      return Disk{size};
    default:
      return Ellipse{{size, 0.4 * size}, angle};
  }
}

// Bodies of the shapes [first, last] in turn, the largest first, `ratio` times the smallest, that
// fill the part `fraction` of the cell.
std::vector<OrderedBody> mixture(const Cell& cell, int first, int last, double ratio,
                                 double fraction, int count) {
  const auto draw = [&](double size) {
    std::vector<OrderedBody> bodies;
    for (int i = 0; i < count; ++i) {
      RandomStream random(3, StreamId::test, static_cast<std::uint64_t>(i));
      const int shape = first + i % (last - first + 1);
      const double shrink = std::pow(ratio, -static_cast<double>(i) / count);
      bodies.push_back({random_body(shape, size * shrink, random), i % 3});
    }
    return bodies;
  };
  double total = 0.0;
  for (const OrderedBody& ordered : draw(1.0)) total += volume(ordered.body);
  return draw(std::pow(fraction * volume(cell) / total, 1.0 / cell.dimension));
}

std::vector<Scene> scenes() {
  const Cell cube;
  Cell walled{3, {1.0, 0.7, 1.4}, {true, false, true}};
  Cell box{3, {1.0, 0.8, 0.9}, {false, false, false}};
  const Cell flat = cell_2d(1.0, 0.6);
  Cell strip = cell_2d(1.3, 0.5);
  strip.periodic = {true, false, false};
  RsaOptions plain, gap, redraw;
  plain.seed = 5;
  gap.seed = 6;
  gap.min_gap = 0.004;
  redraw.seed = 7;
  redraw.redraw_orientation = {true, false, true};
  return {{"equal ellipsoids", cube, mixture(cube, 1, 1, 1.0, 0.25, 500), plain},
          {"cylinders", cube, mixture(cube, 2, 2, 1.0, 0.22, 400), plain},
          {"unequal spheres", cube, mixture(cube, 0, 0, 5.0, 0.36, 600), plain},
          {"all 3D shapes with a gap", cube, mixture(cube, 0, 3, 3.0, 0.2, 400), gap},
          {"all 3D shapes between walls", walled, mixture(walled, 0, 3, 2.0, 0.2, 400), plain},
          {"turned anew", cube, mixture(cube, 0, 3, 2.0, 0.2, 300), redraw},
          {"turned anew in a box", box, mixture(box, 1, 3, 1.5, 0.15, 300), redraw},
          {"unequal disks", flat, mixture(flat, 4, 4, 3.0, 0.5, 500), plain},
          {"ellipses with a gap", flat, mixture(flat, 5, 5, 1.0, 0.35, 400), gap},
          {"disks and ellipses in a strip, turned", strip, mixture(strip, 4, 5, 2.0, 0.4, 400),
           redraw}};
}

// More than fits: the blocks end early, lists of vacancies come in, and the last body is proven to
// fit nowhere, or given up.
std::vector<Scene> saturated_scenes() {
  const Cell flat = cell_2d(1.0, 1.0);
  RsaOptions plain, few_trials, redraw;
  plain.seed = 8;
  few_trials.seed = 9;
  few_trials.max_trials = 300;
  redraw.seed = 10;
  redraw.redraw_orientation = {true, false, true};
  return {{"unequal disks", flat, mixture(flat, 4, 4, 1.5, 0.75, 300), plain},
          {"ellipses", flat, mixture(flat, 5, 5, 1.0, 0.75, 260), plain},
          {"ellipses turned anew", flat, mixture(flat, 4, 5, 1.3, 0.75, 400), redraw},
          {"ellipsoids, few trials", Cell{}, mixture(Cell{}, 1, 1, 1.0, 0.4, 400), few_trials}};
}

}  // namespace

TEST_CASE("blocks of any size place bodies as one by one does") {
  for (const Scene& scene : scenes()) {
    INFO(scene.name);
    const Outcome expected = place_all(scene, kOneByOne, 1);
    REQUIRE(expected.search == Search::placed);
    for (const BlockSizes blocks : {BlockSizes{1, 1, 1}, BlockSizes{1, 1, 7}, BlockSizes{1, 4, 100},
                                    BlockSizes{1, 1, 1000}}) {
      INFO("blocks of at most " << blocks.most);
      require_same(place_all(scene, blocks, 1), expected);
    }
  }
}

TEST_CASE("blocks place the same bodies on any number of threads") {
  for (const Scene& scene : scenes()) {
    INFO(scene.name);
    const Outcome expected = place_all(scene, kOneByOne, 1);
    for (const int threads : {2, 3, 8}) {
      INFO(threads << " threads");
      require_same(place_all(scene, {1, 1, 1000}, threads), expected);
    }
  }
}

TEST_CASE("blocks come to the same end as one by one where not all fit, over several starts") {
  for (const Scene& scene : saturated_scenes()) {
    INFO(scene.name);
    const Outcome expected = place_all(scene, kOneByOne, 1, 2);
    REQUIRE(expected.search != Search::placed);
    REQUIRE(expected.centers.size() > 160);  // Beyond the search one by one, where blocks begin.
    for (const BlockSizes blocks : {BlockSizes{1, 1, 5, 0}, BlockSizes{1, 1, 1000, 3}}) {
      INFO("blocks of at most " << blocks.most);
      for (const int threads : {1, 3}) require_same(place_all(scene, blocks, threads, 2), expected);
    }
  }
}

TEST_CASE("blocks leave the equals of a body that needed a list of vacancies to the list") {
  const Cell flat = cell_2d(1.0, 1.0);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RsaOptions options;
    options.seed = 100 + seed;
    // Some twenty of them fit.
    const Scene scene{"large disks", flat, mixture(flat, 4, 4, 1.0, 5.0, 200), options};
    const Outcome expected = place_all(scene, kOneByOne, 1, 5);
    REQUIRE(expected.search == Search::no_room);
    require_same(place_all(scene, {1, 1, 4, 0}, 1, 5), expected);
  }
}

TEST_CASE("a list of vacancies is not used again once blocks have placed other bodies") {
  const Cell flat = cell_2d(1.0, 1.0);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RsaOptions options;
    options.seed = 200 + seed;
    // Some twenty of the large ones fit; the small ones between them take part in blocks.
    Scene scene{"large and small disks", flat, {}, options};
    for (int k = 0; k < 200; ++k) scene.bodies.push_back({Disk{k % 2 == 0 ? 0.09 : 0.004}, 0});
    const Outcome expected = place_all(scene, kOneByOne, 1, 5);
    REQUIRE(expected.search == Search::no_room);
    require_same(place_all(scene, {1, 1, 4, 0}, 1, 5), expected);
  }
}

TEST_CASE("blocks of the size that long runs use place bodies as one by one does") {
  const Scene scene{"ellipsoids", Cell{}, mixture(Cell{}, 1, 1, 1.0, 0.2, 12'000), {}};
  const Outcome expected = place_all(scene, kOneByOne, 1);
  require_same(place_all(scene, {}, 1), expected);
  require_same(place_all(scene, {}, 2), expected);
}

TEST_CASE("a block stops where the run is asked to stop, with whole bodies") {
  const std::atomic<bool> cancelled = true;
  RunContext run;
  run.cancel_flag(&cancelled);
  const Cell cell;
  const auto bodies = mixture(cell, 1, 1, 1.0, 0.2, 400);
  std::vector<std::int64_t> order(bodies.size());
  std::iota(order.begin(), order.end(), 0);
  const RsaOptions options;
  RunContext never_stops;
  for (const RunContext* context : {&never_stops, &run}) {
    Adsorption adsorption(cell, options, *context, bodies, order, {1, 1, 1000});
    adsorption.start(1);
    const Search search = adsorption.place_next(bodies, order);
    CHECK(search == (context == &run ? Search::cancelled : Search::placed));
    CHECK(adsorption.placed().size() == (context == &run ? 0 : 1));
  }
}

}  // namespace packstone
