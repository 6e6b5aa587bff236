#include "packstone/generate/rsa.hpp"

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/structure/check_packing.hpp"
#include "rsa_oracle.hpp"
#include "scenes.hpp"

namespace packstone {

using namespace rsa_oracle;

namespace {

// `count` of each 3D shape, of unlike sizes, turned at random.
std::vector<OrderedBody> mixture_3d(int count, double size, std::uint64_t seed) {
  std::vector<OrderedBody> bodies;
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, StreamId::test, static_cast<std::uint64_t>(k));
    const double s = size * random.uniform(0.6, 1.2);
    bodies.push_back({Sphere{s}, 0});
    bodies.push_back({Ellipsoid{{1.6 * s, 0.9 * s, 0.7 * s}, random_rotation(random)}, 1});
    bodies.push_back({Cylinder{0.5 * s, 1.7 * s, random_direction(random)}, 2});
    bodies.push_back({Spherocylinder{0.5 * s, 1.3 * s, random_direction(random)}, 3});
  }
  return bodies;
}

std::vector<OrderedBody> mixture_2d(int count, double size, std::uint64_t seed) {
  std::vector<OrderedBody> bodies;
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, StreamId::test, static_cast<std::uint64_t>(k));
    const double s = size * random.uniform(0.6, 1.2);
    bodies.push_back({Disk{s}, 0});
    bodies.push_back({Ellipse{{2.0 * s, 0.6 * s}, random.uniform(0.0, 3.0)}, 1});
  }
  return bodies;
}

std::string message_of(const Cell& cell, const std::vector<OrderedBody>& bodies,
                       const RsaOptions& options = {}) {
  try {
    static_cast<void>(rsa_pack(cell, bodies, options));
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("rsa_pack places mixtures of all 3D shapes without any overlap over all images") {
  for (const RsaOrder order : {RsaOrder::largest_first, RsaOrder::as_given, RsaOrder::shuffled}) {
    RsaOptions options = with_seed(3);
    options.order = order;
    const auto bodies = mixture_3d(12, 0.08, 7);
    const RsaResult result = rsa_pack(Cell{}, bodies, options);
    REQUIRE(result.stop == RsaStop::target_reached);
    REQUIRE(result.packing.inclusions.size() == bodies.size());
    CHECK(result.trials >= static_cast<std::int64_t>(bodies.size()));
    require_valid(result.packing);
  }
}

TEST_CASE("rsa_pack places disks and ellipses in two dimensions") {
  const Cell cell = cell_2d(2.0, 1.0);
  const RsaResult result = rsa_pack(cell, mixture_2d(40, 0.06, 5), with_seed(2));
  REQUIRE(result.stop == RsaStop::target_reached);
  for (const Inclusion& inclusion : result.packing.inclusions) CHECK(inclusion.center.z == 0.0);
  require_valid(result.packing);
}

TEST_CASE("rsa_pack returns the bodies in the order given, sizes and orientations untouched") {
  const auto bodies = mixture_3d(10, 0.08, 11);
  const RsaResult result = rsa_pack(Cell{}, bodies, with_seed(1));
  REQUIRE(result.packing.inclusions.size() == bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    CHECK(result.packing.inclusions[k].body == bodies[k].body);
    CHECK(result.packing.inclusions[k].group == bodies[k].group);
  }
}

TEST_CASE("rsa_pack redraws orientations of the groups named and of no other, and never sizes") {
  const auto bodies = mixture_3d(10, 0.08, 11);
  RsaOptions options = with_seed(1);
  options.redraw_orientation = {false, false, true};
  const RsaResult result = rsa_pack(Cell{}, bodies, options);
  REQUIRE(result.packing.inclusions.size() == bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Body& body = result.packing.inclusions[k].body;
    if (bodies[k].group == 2) {
      CHECK_FALSE(body == bodies[k].body);
      CHECK(std::get<Cylinder>(body).radius == std::get<Cylinder>(bodies[k].body).radius);
      CHECK(std::get<Cylinder>(body).half_length == std::get<Cylinder>(bodies[k].body).half_length);
    } else {
      CHECK(body == bodies[k].body);
    }
  }
  require_valid(result.packing);
}

TEST_CASE("rsa_pack redraws every shape that has an orientation") {
  RsaOptions options = with_seed(4);
  options.redraw_orientation = {true, true, true, true};
  auto bodies = mixture_3d(8, 0.09, 3);
  for (int k = 0; k < 8; ++k) bodies.push_back({Ellipsoid{{0.05, 0.05, 0.15}, {}}, 1});
  require_valid(rsa_pack(Cell{}, bodies, options).packing);
  const RsaResult plane = rsa_pack(cell_2d(1, 1), mixture_2d(20, 0.06, 5), options);
  CHECK(plane.stop == RsaStop::target_reached);
  require_valid(plane.packing);
}

TEST_CASE("rsa_pack keeps bodies inside walls and apart by min_gap") {
  for (const bool redraw : {false, true}) {
    Cell cell;
    cell.size = {1.0, 0.8, 1.2};
    cell.periodic = {true, false, false};
    RsaOptions options = with_seed(8);
    options.min_gap = 0.02;
    if (redraw) options.redraw_orientation = {true, true, true, true};
    const RsaResult result = rsa_pack(cell, mixture_3d(8, 0.07, 2), options);
    CHECK(result.stop == RsaStop::target_reached);
    require_valid(result.packing, options.min_gap);
  }
}

TEST_CASE("rsa_pack handles fibers that meet several images of a neighbor and almost their own") {
  Cell cell;
  cell.size = {1.0, 1.0, 0.5};
  std::vector<OrderedBody> bodies;
  for (int k = 0; k < 12; ++k) {
    RandomStream random(5, StreamId::test, static_cast<std::uint64_t>(k));
    // Longer than the cell is high, tilted enough to pass its own images.
    const double phi = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec3 axis = normalized(Vec3{std::cos(phi), std::sin(phi), 0.25});
    bodies.push_back({Cylinder{0.02, 0.42, axis}, 0});
  }
  const RsaResult result = rsa_pack(cell, bodies, with_seed(2));
  CHECK(result.stop == RsaStop::target_reached);
  require_valid(result.packing);
}

TEST_CASE("rsa_pack handles a fiber as long as several short periods") {
  Cell cell;
  cell.size = {0.3, 0.3, 3.0};
  std::vector<OrderedBody> bodies;
  for (int k = 0; k < 6; ++k) bodies.push_back({Cylinder{0.03, 0.6, {0, 0, 1}}, 0});
  bodies.push_back({Cylinder{0.01, 0.7, normalized(Vec3{0.02, 0.15, 1.0})}, 0});
  const RsaResult result = rsa_pack(cell, bodies, with_seed(2));
  CHECK(result.stop == RsaStop::target_reached);
  CHECK(count_unproven_pairs(result.packing, 0.0) == 0);
}

TEST_CASE("rsa_pack places more bodies than are searched one by one") {
  // So the grid is at work; the oracle is all pairs.
  const auto bodies = mixture_3d(60, 0.045, 4);
  const RsaResult result = rsa_pack(Cell{}, bodies, with_seed(6));
  REQUIRE(result.stop == RsaStop::target_reached);
  require_valid(result.packing);
  Packing packing = result.packing;
  packing.groups = {"spheres", "ellipsoids", "cylinders", "spherocylinders"};
  CHECK(check_packing(packing).passed());
}

TEST_CASE("rsa_pack gives the same bits for 1, 2, 3 and 8 threads") {
  struct Case {
    double sphere_fraction, cylinder_fraction;
    bool redraw;
  };
  // The last bodies of each case take well over the 1024 trials after which threads take part.
  for (const Case& c : {Case{0.2, 0.1, false}, Case{0.1, 0.22, true}}) {
    const auto bodies =
        scenes::cylinders_and_spheres(20, c.sphere_fraction, c.cylinder_fraction, 3.0, 1);
    RsaOptions options = with_seed(5);
    options.order = RsaOrder::as_given;
    if (c.redraw) options.redraw_orientation = {true, false};
    const RsaResult alone = rsa_pack(Cell{}, bodies, options, RunContext{}.threads(1));
    CHECK(alone.trials > 2500);
    for (const int threads : {2, 3, 8}) {
      const RsaResult result = rsa_pack(Cell{}, bodies, options, RunContext{}.threads(threads));
      CHECK(scenes::state_hash(result.packing) == scenes::state_hash(alone.packing));
      CHECK(result.trials == alone.trials);
      CHECK(result.restarts == alone.restarts);
    }
  }
}

TEST_CASE("rsa_pack proves that no further body fits, and plain attempts agree") {
  struct Case {
    Body body;
    Cell cell;
    bool redraw;
  };
  const Case cases[] = {
      {Sphere{0.13}, Cell{}, false},
      {Disk{0.1}, cell_2d(1, 1), false},
      {Cylinder{0.07, 0.21, normalized(Vec3{1, 2, 3})}, Cell{}, false},
      {Spherocylinder{0.1, 0.15, normalized(Vec3{3, -1, 1})}, Cell{}, false},
      {Ellipsoid{{0.2, 0.12, 0.09}, normalized(Quaternion{1, 2, 3, 4})}, Cell{}, false},
      {Ellipse{{0.15, 0.07}, 0.6}, cell_2d(1, 1), false},
      {Ellipse{{0.2, 0.1}, 0.6}, cell_2d(1, 1), true},
      {Spherocylinder{0.14, 0.1, {0, 0, 1}}, Cell{}, true},
      {Ellipsoid{{0.2, 0.15, 0.15}, {}}, Cell{}, true},
      {Cylinder{0.15, 0.15, {0, 0, 1}}, Cell{}, true},
  };
  for (const Case& c : cases) {
    CAPTURE(name(kind(c.body)), c.redraw);
    const auto source = [&](std::int64_t) { return OrderedBody{c.body, 0}; };
    RsaOptions options = with_seed(1);
    options.redraw_orientation = {c.redraw};
    const RsaResult result = rsa_fill(c.cell, source, options);
    CHECK(result.stop == RsaStop::saturated);
    require_valid(result.packing);
    CHECK(count_fitting(result.packing, c.body, c.redraw, 8'000) == 0);
  }
}

TEST_CASE("rsa_pack places many equal spheres or disks, at the density where they just fit") {
  struct Case {
    Cell cell;
    Body body;
    double min_gap;
    RsaOrder order;
    int count;
  };
  const Cell walled{3, {1, 1, 1}, {true, false, true}};
  for (const Case& c : {Case{Cell{}, Sphere{0.062}, 0.0, RsaOrder::largest_first, 345},
                        Case{walled, Sphere{0.06}, 0.003, RsaOrder::shuffled, 240},
                        Case{cell_2d(1.0, 1.5), Disk{0.03}, 0.0, RsaOrder::as_given, 270}}) {
    std::vector<OrderedBody> bodies;
    for (int k = 0; k < c.count; ++k) bodies.push_back({c.body, k % 3});
    RsaOptions options = with_seed(4);
    options.min_gap = c.min_gap;
    options.order = c.order;
    const RsaResult alone = rsa_pack(c.cell, bodies, options);
    REQUIRE(alone.stop == RsaStop::target_reached);
    require_valid(alone.packing, c.min_gap);
    REQUIRE(alone.packing.inclusions.size() == bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      REQUIRE(alone.packing.inclusions[k].group == bodies[k].group);
      REQUIRE(alone.packing.inclusions[k].body == c.body);
    }
    for (const int threads : {2, 3, 8}) {
      const RsaResult result = rsa_pack(c.cell, bodies, options, RunContext{}.threads(threads));
      CHECK(scenes::state_hash(result.packing) == scenes::state_hash(alone.packing));
      CHECK(result.restarts == alone.restarts);
      CHECK(result.trials == alone.trials);
    }
    options.seed = 5;
    CHECK(scenes::state_hash(rsa_pack(c.cell, bodies, options).packing) !=
          scenes::state_hash(alone.packing));
  }
}

TEST_CASE("rsa_pack keeps what is valid when it is cancelled or out of time") {
  const auto bodies = scenes::cylinders_and_spheres(30, 0.30, 0.30, 5.0, 1);
  std::atomic<bool> cancel{false};
  RunContext run;
  std::int64_t most = 0;
  run.cancel_flag(&cancel).on_progress([&](const Progress& progress) {
    most = std::max(most, progress.placed);
    cancel = true;
  });
  RsaOptions options = with_seed(1);
  options.order = RsaOrder::as_given;
  const RsaResult cancelled = rsa_pack(Cell{}, bodies, options, run);
  CHECK(cancelled.stop == RsaStop::cancelled);
  CHECK(most > 0);
  CHECK(static_cast<std::int64_t>(cancelled.packing.inclusions.size()) >= most);
  require_valid(cancelled.packing);

  RunContext timed;
  timed.deadline(RunContext::Clock::now() + std::chrono::milliseconds(50));
  const RsaResult late = rsa_pack(Cell{}, bodies, options, timed);
  CHECK(late.stop == RsaStop::out_of_time);
  CHECK_FALSE(late.packing.inclusions.empty());
  require_valid(late.packing);
}

TEST_CASE("rsa_pack refuses options out of range, naming field, value and range") {
  const std::vector<OrderedBody> bodies{{Sphere{0.1}, 0}};
  RsaOptions options;
  options.min_gap = -0.5;
  CHECK(message_of(Cell{}, bodies, options) ==
        "RsaOptions::min_gap is -0.5; allowed are numbers >= 0 and below 1, the shortest "
        "period of the cell");
  options = {};
  options.max_trials = 0;
  CHECK(message_of(Cell{}, bodies, options) == "RsaOptions::max_trials is 0; it must be >= 1");
  options = {};
  options.max_restarts = -1;
  CHECK(message_of(Cell{}, bodies, options) == "RsaOptions::max_restarts is -1; it must be >= 0");
}

TEST_CASE("rsa_pack refuses bodies that cannot stand in the cell, naming the body and the reason") {
  using Catch::Matchers::Contains;
  const Body small = Sphere{0.1};
  CHECK_THAT(message_of(Cell{}, {{small, 0}, {Sphere{0.51}, 0}}),
             Contains("body 1") && Contains("own periodic image"));
  CHECK_THAT(message_of(Cell{}, {{Cylinder{0.01, 0.6, {1, 0, 0}}, 2}}),
             Contains("body 0") && Contains("group 2") && Contains("own periodic image"));
  Cell walled;
  walled.periodic = {true, true, false};
  CHECK_THAT(message_of(walled, {{Cylinder{0.05, 0.6, {0, 0, 1}}, 0}}),
             Contains("body 0") && Contains("walls") && Contains("along z"));
  CHECK_THAT(message_of(Cell{}, {{Disk{0.1}, 0}}), Contains("body 0") && Contains("dimension"));
  CHECK_THAT(message_of(Cell{}, {{Sphere{-1.0}, 0}}), Contains("body 0"));
  CHECK_THAT(message_of(Cell{}, std::vector<OrderedBody>(3, {Sphere{0.45}, 0})),
             Contains("all inclusions together need 1.14"));
  // A gap can make a body too large.
  RsaOptions options;
  options.min_gap = 0.2;
  CHECK_THAT(message_of(Cell{}, {{Sphere{0.45}, 0}}, options),
             Contains("does not keep a gap of 0.2"));
}

TEST_CASE("rsa_pack turns a long cylinder until it clears its own images, when it may") {
  // Along x it meets its own image; turned by some degrees it does not.
  const std::vector<OrderedBody> bodies{{Cylinder{0.02, 0.51, {1, 0, 0}}, 0}};
  CHECK_THAT(message_of(Cell{}, bodies), Catch::Matchers::Contains("own periodic image"));
  RsaOptions options;
  options.redraw_orientation = {true};
  const RsaResult result = rsa_pack(Cell{}, bodies, options);
  CHECK(result.stop == RsaStop::target_reached);
  require_valid(result.packing);
}

TEST_CASE("rsa_pack with no bodies is done at once") {
  const RsaResult result = rsa_pack(Cell{}, {});
  CHECK(result.stop == RsaStop::target_reached);
  CHECK(result.packing.inclusions.empty());
}

TEST_CASE("rsa_fill keeps the order of the source and skips nothing") {
  const auto source = [](std::int64_t k) {
    return OrderedBody{Sphere{k % 2 == 0 ? 0.15 : 0.08}, static_cast<int>(k % 2)};
  };
  const RsaResult result = rsa_fill(Cell{}, source, with_seed(2));
  CHECK(result.stop == RsaStop::saturated);
  const auto& all = result.packing.inclusions;
  REQUIRE(all.size() > 10);
  for (std::size_t k = 0; k < all.size(); ++k) CHECK(all[k].group == static_cast<int>(k % 2));
  CHECK(count_fitting(result.packing, source(static_cast<std::int64_t>(all.size())).body, false,
                      20'000) == 0);
  require_valid(result.packing);
}

TEST_CASE("rsa_fill goes on past the bodies that are searched one by one") {
  for (const bool round : {true, false}) {
    const auto source = [&](std::int64_t) {
      return OrderedBody{round ? Body{Sphere{0.066}} : Body{Cylinder{0.05, 0.1, {0, 0.6, 0.8}}}, 0};
    };
    const RsaResult result = rsa_fill(Cell{}, source, with_seed(7));
    CHECK(result.stop == RsaStop::saturated);
    REQUIRE(result.packing.inclusions.size() > 200);
    require_valid(result.packing);
  }
}

TEST_CASE("rsa_pack draws the center of the first body uniformly, between walls as well") {
  Cell cell;
  cell.periodic = {true, false, true};
  constexpr int runs = 4000;
  std::array<double, 3> sum{}, sum_sq{};
  for (int seed = 0; seed < runs; ++seed) {
    const RsaResult result =
        rsa_pack(cell, {{Sphere{0.2}, 0}}, with_seed(static_cast<std::uint64_t>(seed)));
    const Vec3 c = result.packing.inclusions[0].center;
    const Vec3 u{c.x, (c.y - 0.2) / 0.6, c.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] += u[axis];
      sum_sq[axis] += u[axis] * u[axis];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Five standard errors: of the mean sqrt(1/12 / n), of the mean square sqrt(4/45 / n).
    CHECK(sum[axis] / runs == Approx(0.5).margin(5.0 * std::sqrt(1.0 / 12 / runs)));
    CHECK(sum_sq[axis] / runs == Approx(1.0 / 3).margin(5.0 * std::sqrt(4.0 / 45 / runs)));
  }
}

// Where the second of two bodies stands, seen from where the first one leaves most room: the corner
// of the cell about it. And the axis of the second, where it is a cylinder.
struct Placing {
  Vec3 offset;
  Vec3 axis{0, 0, 1};
};

Placing second_of(const Packing& packing) {
  const Vec3 d = packing.inclusions[1].center - packing.inclusions[0].center;
  Placing placing{
      {d.x - std::floor(d.x) - 0.5, d.y - std::floor(d.y) - 0.5, d.z - std::floor(d.z) - 0.5}};
  if (const auto* rod = std::get_if<Cylinder>(&packing.inclusions[1].body)) {
    placing.axis = rod->axis;
  }
  return placing;
}

// The same by plain trials in a box about that corner, by the exact kernel.
Placing second_by_plain_trials(const Body& first, Body second, double half, RandomStream& random) {
  for (;;) {
    const Placing trial{
        {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)},
        random_direction(random)};
    if (auto* rod = std::get_if<Cylinder>(&second)) rod->axis = trial.axis;
    bool free = true;
    for (int corner = 0; corner < 8 && free; ++corner) {
      const Vec3 at{(corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5};
      free = overlap(first, second, trial.offset - at) == Verdict::separated;
    }
    if (free) return trial;
  }
}

// Things whose means tell one law of placings from another.
std::array<double, 4> features(const Placing& placing) {
  const Vec3& d = placing.offset;
  return {norm(d), d.x * d.x, std::abs(dot(d, placing.axis)), placing.axis.z * placing.axis.z};
}

TEST_CASE("rsa_pack places the last body by the law of plain trials, mask and list or not") {
  struct Case {
    Body first, second;
    double half;  // Of a box that holds all centers of the second body.
  };
  // One trial in a thousand fits, or fewer, so that most places are not found by plain trials.
  const Case cases[] = {{Sphere{0.45}, Sphere{0.395}, 0.04},
                        {Sphere{0.48}, Cylinder{0.2, 0.27, {0, 0, 1}}, 0.5},
                        {Cylinder{0.3, 0.45, {0, 0, 1}}, Sphere{0.38}, 0.5}};
  for (const Case& c : cases) {
    constexpr int runs = 1500;
    std::array<double, 4> sum{}, sum_sq{}, oracle{};
    std::int64_t trials = 0;
    for (int seed = 0; seed < runs; ++seed) {
      RsaOptions options = with_seed(static_cast<std::uint64_t>(seed));
      options.order = RsaOrder::as_given;
      options.redraw_orientation = {false, true};
      const RsaResult result = rsa_pack(Cell{}, {{c.first, 0}, {c.second, 1}}, options);
      REQUIRE(result.stop == RsaStop::target_reached);
      trials += result.trials;
      RandomStream random(51, StreamId::test, static_cast<std::uint64_t>(seed));
      const auto ours = features(second_of(result.packing));
      const auto plain = features(second_by_plain_trials(c.first, c.second, c.half, random));
      for (std::size_t k = 0; k < 4; ++k) {
        sum[k] += ours[k] / runs;
        sum_sq[k] += ours[k] * ours[k] / runs;
        oracle[k] += plain[k] / runs;
      }
    }
    CHECK(trials > 100 * runs);
    const bool is_rod = std::holds_alternative<Cylinder>(c.second);
    for (std::size_t k = 0; k < (is_rod ? 4 : 2); ++k) {
      CAPTURE(name(kind(c.second)), k, trials);
      // Five standard errors of a difference of two such means.
      const double variance = sum_sq[k] - sum[k] * sum[k];
      CHECK(sum[k] == Approx(oracle[k]).margin(5.0 * std::sqrt(2.0 * variance / runs)));
    }
  }
}

TEST_CASE("names of stop reasons") {
  CHECK(name(RsaStop::target_reached) == "target_reached");
  CHECK(name(RsaStop::saturated) == "saturated");
  CHECK(name(RsaStop::given_up) == "given_up");
  CHECK(name(RsaStop::cancelled) == "cancelled");
  CHECK(name(RsaStop::out_of_time) == "out_of_time");
}

TEST_CASE("validation: equal spheres and disks saturate at the published fractions",
          "[validation]") {
  // G. Zhang, S. Torquato, Phys. Rev. E 88 (2013) 053312: 0.38413 for spheres, 0.54707 for disks.
  // The standard deviation over packings of 1000 bodies is about 0.004 and 0.005 here, so the mean
  // of 8 stays within 0.006.
  double spheres = 0.0, disks = 0.0;
  constexpr int runs = 8;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const auto ball = [](std::int64_t) { return OrderedBody{Sphere{0.045}, 0}; };
    const auto disk = [](std::int64_t) { return OrderedBody{Disk{0.013}, 0}; };
    const RsaResult a = rsa_fill(Cell{}, ball, with_seed(seed));
    const RsaResult b = rsa_fill(cell_2d(1, 1), disk, with_seed(seed));
    REQUIRE(a.stop == RsaStop::saturated);
    REQUIRE(b.stop == RsaStop::saturated);
    spheres += fraction(a.packing) / runs;
    disks += fraction(b.packing) / runs;
  }
  CHECK(spheres == Approx(0.3841).margin(0.006));
  CHECK(disks == Approx(0.5471).margin(0.006));
}

TEST_CASE("validation: a million plain attempts find no room in saturated states", "[validation]") {
  for (const bool redraw : {false, true}) {
    const Body body = Cylinder{0.11, 0.22, normalized(Vec3{1, 2, 3})};
    RsaOptions options = with_seed(4);
    options.redraw_orientation = {redraw};
    const RsaResult result = rsa_fill(
        Cell{},
        [&](std::int64_t) {
          return OrderedBody{body, 0};
        },
        options);
    REQUIRE(result.stop == RsaStop::saturated);
    CHECK(count_fitting(result.packing, body, redraw, 1'000'000) == 0);
  }
}

TEST_CASE("validation: every filled cell of the published tables stands, both ways of turning",
          "[validation]") {
  struct Case {
    int count_each;
    double sphere_fraction, cylinder_fraction, aspect;
  };
  for (const Case& c : {Case{10, 0.25, 0.10, 3}, Case{20, 0.20, 0.15, 3}, Case{30, 0.05, 0.25, 5},
                        Case{50, 0.15, 0.15, 5}}) {
    for (const bool redraw : {false, true}) {
      RsaOptions options = with_seed(1);
      options.order = RsaOrder::as_given;
      if (redraw) options.redraw_orientation = {true, false};
      const auto bodies = scenes::cylinders_and_spheres(c.count_each, c.sphere_fraction,
                                                        c.cylinder_fraction, c.aspect, 1);
      const RsaResult result = rsa_pack(Cell{}, bodies, options);
      CHECK(result.stop == RsaStop::target_reached);
      require_valid(result.packing);
    }
  }
}

}  // namespace packstone
