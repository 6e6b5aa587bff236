#include "packstone/generate/event_driven.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "support/brute_force_check.hpp"
#include "support/random_body.hpp"

namespace packstone {
namespace {

using Bodies = std::vector<OrderedBody>;

// All made larger or smaller by one factor, so that they fill `fraction` of the cell.
Bodies filling(const Cell& cell, Bodies bodies, double fraction) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += volume(b.body);
  const double factor = std::pow(fraction * volume(cell) / sum, 1.0 / cell.dimension);
  for (OrderedBody& b : bodies) b.body = scaled(b.body, factor);
  return bodies;
}

// `count` times the shape, turned at random.
Bodies copies(const Body& shape, int count, std::uint64_t seed = 5) {
  Bodies bodies;
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, StreamId::test, static_cast<std::uint64_t>(k));
    bodies.push_back({rotated(shape, random_rotation(random)), 0});
  }
  return bodies;
}

Bodies mixture(int dimension, int count, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  Bodies bodies;
  for (int k = 0; k < count; ++k) {
    const ShapeKind shape = test::random_shape(dimension, random);
    bodies.push_back(
        {test::random_body(shape, random, [&] { return random.uniform(0.5, 1.5); }), k % 3});
  }
  return bodies;
}

// Radii from 1 down to 1 / range, as many of each size as fills the space between the larger ones.
Bodies spheres_of_sizes(int count, double range) {
  Bodies bodies;
  for (int k = 0; k < count; ++k) {
    bodies.push_back({Sphere{std::pow(range, -k / (count - 1.0))}, 0});
  }
  return bodies;
}

double filled(const Cell& cell, const Bodies& bodies) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += volume(b.body);
  return sum / volume(cell);
}

void check_valid(const EventDrivenResult& result, double min_gap = 0.0) {
  const Certificate certificate = check_packing(result.packing, {.min_gap = min_gap});
  CAPTURE(certificate.smallest_gap, certificate.worst_pair[0], certificate.worst_pair[1]);
  CHECK(certificate.overlaps == 0);
  CHECK(certificate.gaps_below == 0);
  CHECK(certificate.outside_walls == 0);
  if (result.packing.inclusions.size() > 12) return;
  CHECK(test::brute_force_check(result.packing, min_gap).passed());
}

// The same shape and size to the last bit, however it is turned.
bool same_size(const Body& a, const Body& b) {
  if (a.index() != b.index()) return false;
  const auto unturned = [](Body body) {
    std::visit(
        [](auto& s) {
          if constexpr (requires { s.orientation; }) s.orientation = {};
          if constexpr (requires { s.axis; }) s.axis = {0, 0, 1};
          if constexpr (requires { s.angle; }) s.angle = 0.0;
        },
        body);
    return body;
  };
  return unturned(a) == unturned(b);
}

void check_reached(const Cell& cell, const Bodies& bodies, const EventDrivenResult& result,
                   double min_gap = 0.0) {
  REQUIRE(result.stop == EventDrivenStop::target_reached);
  CHECK(result.size_factor == 1.0);
  REQUIRE(result.packing.inclusions.size() == bodies.size());
  CHECK(result.packing.cell == cell);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    CHECK(same_size(result.packing.inclusions[k].body, bodies[k].body));
    CHECK(result.packing.inclusions[k].group == bodies[k].group);
  }
  CHECK(fraction(result.packing) == Approx(filled(cell, bodies)).epsilon(1e-12));
  // Rounding of coordinates.
  CHECK(result.report.most_negative_gap >= -1e-13);
  check_valid(result, min_gap);
}

// With a time limit that no run comes near, so that one that would never end fails.
EventDrivenResult pack(const Cell& cell, const Bodies& bodies, EventDrivenOptions options = {}) {
  if (options.seed == 0) options.seed = 3;
  const auto limit = RunContext::Clock::now() + std::chrono::seconds(20);
  return event_driven_pack(cell, bodies, options, RunContext{}.deadline(limit));
}

void check_packs(const Cell& cell, const Bodies& bodies, const EventDrivenOptions& options = {}) {
  check_reached(cell, bodies, pack(cell, bodies, options), options.min_gap);
}

std::uint64_t hash_of(const EventDrivenResult& result) {
  return scenes::state_hash(result.packing);
}

template <class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const EventDrivenOptions& options) {
  return message_of([&] {
    static_cast<void>(
        event_driven_pack(Cell{}, filling(Cell{}, copies(Sphere{1}, 4), 0.1), options));
  });
}

void check_names(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    CAPTURE(message, part);
    CHECK(message.find(part) != std::string::npos);
  }
}

// The shapes that any list of them should have.
const Body kBall = Sphere{1}, kProlate = Ellipsoid{{2, 1, 1}, {}},
           kOblate = Ellipsoid{{3, 3, 1}, {}}, kScalene = Ellipsoid{{3, 2, 1}, {}},
           kRod = Cylinder{1, 3}, kCoin = Cylinder{3, 1}, kCapsule = Spherocylinder{1, 3};

}  // namespace

TEST_CASE("event_driven_pack packs every shape in space to the size ordered") {
  const Cell cell{};
  check_packs(cell, filling(cell, copies(kBall, 50), 0.55));
  check_packs(cell, filling(cell, copies(kProlate, 40), 0.55));
  check_packs(cell, filling(cell, copies(kOblate, 40), 0.45));
  check_packs(cell, filling(cell, copies(kScalene, 30), 0.5));
  check_packs(cell, filling(cell, copies(kRod, 15), 0.35));
  check_packs(cell, filling(cell, copies(kCoin, 15), 0.3));
  check_packs(cell, filling(cell, copies(kCapsule, 20), 0.4));
}

TEST_CASE("event_driven_pack packs disks and ellipses, and they stay in the plane") {
  const Cell cell = cell_2d(1.0, 0.7);
  for (const Body& shape :
       {Body{Disk{1}}, Body{Ellipse{{2, 1}, 0.0}}, Body{Ellipse{{10, 1}, 0.0}}}) {
    const Bodies bodies = filling(cell, copies(shape, 40), 0.6);
    const EventDrivenResult result = pack(cell, bodies);
    check_reached(cell, bodies, result);
    for (const Inclusion& inclusion : result.packing.inclusions) CHECK(inclusion.center.z == 0.0);
    for (const Vec3& velocity : result.state.velocity) CHECK(velocity.z == 0.0);
  }
  check_packs(cell, filling(cell, mixture(2, 40, 8), 0.6));
}

TEST_CASE("event_driven_pack packs mixtures of all shapes and of very unequal sizes") {
  const Cell cell{3, {1.0, 1.5, 0.8}, {true, true, true}};
  check_packs(cell, filling(cell, mixture(3, 40, 8), 0.4));
  check_packs(cell, filling(cell, spheres_of_sizes(80, 100.0), 0.4));
  check_packs(cell, filling(cell, spheres_of_sizes(60, 1000.0), 0.3));
}

TEST_CASE("event_driven_pack packs needles and lenses of aspect 100") {
  const Cell cell{};
  check_packs(cell, filling(cell, copies(Ellipsoid{{100, 1, 1}, {}}, 30), 0.005));
  check_packs(cell, filling(cell, copies(Ellipsoid{{100, 100, 1}, {}}, 10), 0.02));
  check_packs(cell, filling(cell, copies(Spherocylinder{1, 100}, 15), 0.005));
}

TEST_CASE("event_driven_pack packs between walls across one axis or all of them") {
  for (const auto& periodic : {std::array<bool, 3>{true, true, false}, {false, false, false}}) {
    const Cell cell{3, {1.0, 0.8, 1.2}, periodic};
    check_packs(cell, filling(cell, copies(kBall, 30), 0.4));
    check_packs(cell, filling(cell, copies(kProlate, 20), 0.4));
    check_packs(cell, filling(cell, mixture(3, 16, 9), 0.25));
    check_packs(cell, filling(cell, copies(kRod, 8), 0.15));
  }
  const Cell plane = cell_2d(1.0, 1.0, false, false);
  check_packs(plane, filling(plane, mixture(2, 20, 9), 0.5));
  const EventDrivenResult box =
      pack({3, {1, 1, 1}, {false, false, false}}, filling(Cell{}, copies(kBall, 10), 0.3));
  CHECK(box.report.wall_collisions > 0);
  CHECK(box.report.wall_collisions <= box.report.collisions);
}

TEST_CASE("event_driven_pack packs one body, and two") {
  const Cell cell{};
  for (const int count : {1, 2}) {
    check_packs(cell, filling(cell, copies(kBall, count), 0.4));
    check_packs(cell, filling(cell, copies(kScalene, count), 0.25));
    check_packs(cell, filling(cell, copies(kRod, count), 0.1));
  }
  check_packs({3, {1, 1, 1}, {false, false, false}}, filling(cell, copies(kBall, 1), 0.5));
}

TEST_CASE("event_driven_pack packs bodies longer than the cell, clear of their own images") {
  const Cell cell{};
  for (const int count : {1, 2, 6}) {
    check_packs(cell, copies(Ellipsoid{{0.55, 0.05, 0.05}, {}}, count));
    check_packs(cell, copies(Ellipsoid{{0.8, 0.02, 0.02}, {}}, count));
    check_packs(cell, copies(Spherocylinder{0.02, 0.7}, count));
    check_packs(cell, copies(Cylinder{0.02, 0.7}, count));
  }
  const Cell flat{3, {1, 1, 0.3}, {true, true, true}};
  check_packs(flat, copies(Ellipsoid{{0.3, 0.04, 0.04}, {}}, 10));
}

TEST_CASE("event_driven_pack leaves fixed orientations as they are, to the last bit") {
  const Cell cell{};
  Bodies bodies = filling(cell, mixture(3, 30, 10), 0.3);
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].group = k % 2 == 0 ? 0 : 2;
  EventDrivenOptions options;
  options.fixed_orientation = {false, false, true};
  const EventDrivenResult result = pack(cell, bodies, options);
  check_reached(cell, bodies, result);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const bool stays = bodies[k].group == 2 || is_round(kind(bodies[k].body));
    CHECK((result.packing.inclusions[k].body == bodies[k].body) == stays);
  }
  // Cylinders side by side, which their rounded kin could not be packed as.
  options.fixed_orientation = {true};
  check_packs(cell, filling(cell, Bodies(20, {Cylinder{1, 2, {0, 0, 1}}, 0}), 0.4), options);
}

TEST_CASE("event_driven_pack keeps the least gap that is ordered") {
  const Cell cell{};
  const EventDrivenOptions options{.min_gap = 0.03};
  check_packs(cell, filling(cell, copies(kBall, 40), 0.3), options);
  check_packs(cell, filling(cell, copies(kProlate, 30), 0.2), options);
  check_packs(cell, filling(cell, mixture(3, 30, 11), 0.15), options);
  check_packs(cell, filling(cell, copies(kRod, 10), 0.1), options);
  const Cell plane = cell_2d(1.0, 1.0);
  check_packs(plane, filling(plane, mixture(2, 20, 11), 0.3), options);
  const Cell walls{3, {1, 1, 1}, {false, false, false}};
  check_packs(walls, filling(walls, copies(kBall, 10), 0.15), options);
}

TEST_CASE("the least gap is one between inclusions: a wall may be nearer") {
  const Cell walls{3, {1, 1, 1}, {false, false, false}};
  check_packs(walls, {{Sphere{0.45}, 0}}, {.min_gap = 0.2});
}

TEST_CASE("looking at all pairs after every event finds nothing wrong") {
  EventDrivenOptions options;
  options.check_every_event = true;
  const Cell cell{};
  for (const Body& shape : {kBall, kProlate, kOblate, kScalene, kRod, kCapsule}) {
    check_packs(cell, filling(cell, copies(shape, 8), 0.25), options);
  }
  check_packs(cell, copies(Ellipsoid{{0.8, 0.02, 0.02}, {}}, 3), options);
  const Cell walls{3, {1, 0.8, 1}, {false, true, false}};
  check_packs(walls, filling(walls, mixture(3, 8, 12), 0.2), options);
  options.min_gap = 0.02;
  check_packs(cell, filling(cell, copies(kProlate, 8), 0.2), options);
}

TEST_CASE("event_driven_pack gives the same bits again, and others for another seed") {
  const Cell cell{};
  for (const Bodies& bodies :
       {filling(cell, copies(kBall, 30), 0.4), filling(cell, copies(kProlate, 30), 0.4),
        filling(cell, mixture(3, 15, 13), 0.3)}) {
    const EventDrivenResult once = pack(cell, bodies), again = pack(cell, bodies);
    CHECK(hash_of(once) == hash_of(again));
    CHECK(once.report.collisions == again.report.collisions);
    CHECK(once.report.steps == again.report.steps);
    CHECK(hash_of(pack(cell, bodies, {.seed = 99})) != hash_of(once));
  }
}

namespace {

// All states that a run offers to keep.
struct Kept {
  EventDrivenResult result;
  std::vector<MovingPacking> states;
};
Kept keep_all(const Cell& cell, const Bodies& bodies, const EventDrivenOptions& options) {
  Kept kept;
  const Checkpointing every{0.0, [&](const MovingPacking& state) { kept.states.push_back(state); }};
  kept.result = event_driven_pack(cell, bodies, options, {}, every);
  return kept;
}

void check_continues(const Kept& kept, const MovingPacking& state,
                     const EventDrivenOptions& options) {
  const EventDrivenResult result = event_driven_continue(state, options);
  CHECK(result.stop == kept.result.stop);
  CHECK(hash_of(result) == hash_of(kept.result));
  CHECK(result.state.velocity == kept.result.state.velocity);
  CHECK(result.state.angular_velocity == kept.result.state.angular_velocity);
  CHECK(result.state.numbers == kept.result.state.numbers);
}

// The state of a run that is cancelled when it has offered `offers` states to keep.
EventDrivenResult cancelled_after(int offers, const Cell& cell, const Bodies& bodies,
                                  const EventDrivenOptions& options) {
  std::atomic<bool> cancel{false};
  int seen = 0;
  const Checkpointing counting{0.0,
                               [&](const MovingPacking&) { cancel = cancel || ++seen >= offers; }};
  return event_driven_pack(cell, bodies, options, RunContext{}.cancel_flag(&cancel), counting);
}

}  // namespace

TEST_CASE("a run goes on from every state that it offers to keep as if it had never stopped") {
  const Cell cell{};
  for (const Bodies& bodies :
       {filling(cell, copies(kBall, 30), 0.5), filling(cell, copies(kProlate, 30), 0.5),
        filling(cell, mixture(3, 30, 14), 0.5)}) {
    const EventDrivenOptions options{.growth_rate = 0.01, .seed = 4};
    const Kept kept = keep_all(cell, bodies, options);
    REQUIRE(kept.states.size() >= 4);
    // The last one is the end.
    for (std::size_t k = 0; k + 1 < kept.states.size(); k += 1 + kept.states.size() / 6) {
      CAPTURE(k, kept.states.size());
      check_continues(kept, kept.states[k], options);
    }
  }
}

TEST_CASE("a run in equilibrium goes on from every state, and measures the same pressure") {
  const Cell cell{};
  const EventDrivenOptions options{
      .goal = EventDrivenGoal::equilibrium, .collisions_per_body = 60.0, .seed = 4};
  const Kept kept = keep_all(cell, filling(cell, copies(kProlate, 20), 0.3), options);
  REQUIRE(kept.states.size() >= 4);
  for (std::size_t k = 0; k + 1 < kept.states.size(); k += 2) {
    check_continues(kept, kept.states[k], options);
    const EventDrivenResult result = event_driven_continue(kept.states[k], options);
    CHECK(result.report.reduced_pressure == kept.result.report.reduced_pressure);
    CHECK(result.report.energy_drift == kept.result.report.energy_drift);
  }
}

TEST_CASE("a cancelled run keeps a valid packing and goes on from its state as if never stopped") {
  const Cell cell{};
  const EventDrivenOptions options{.growth_rate = 0.01, .seed = 4};
  for (const Bodies& bodies :
       {filling(cell, copies(kBall, 30), 0.5), filling(cell, mixture(3, 30, 14), 0.5)}) {
    const Kept kept = keep_all(cell, bodies, options);
    for (const int offers : {1, 2, 4}) {
      CAPTURE(offers);
      const EventDrivenResult stopped = cancelled_after(offers, cell, bodies, options);
      REQUIRE(stopped.stop == EventDrivenStop::cancelled);
      CHECK(stopped.size_factor > 0.0);
      CHECK(stopped.size_factor < 1.0);
      CHECK(stopped.size_factor >= stopped.state.size_factor);
      check_valid(stopped);
      check_continues(kept, stopped.state, options);
    }
  }
}

TEST_CASE("a run that is stopped anywhere goes on from its state as if never stopped") {
  const Cell cell{};
  const EventDrivenOptions options{.growth_rate = 0.03, .seed = 6};
  const Bodies bodies = filling(cell, copies(kProlate, 100), 0.5);
  const Kept kept = keep_all(cell, bodies, options);
  // Wherever the clock happens to stop it: the answer must be the same.
  for (const int milliseconds : {1, 4, 11}) {
    const auto limit = RunContext::Clock::now() + std::chrono::milliseconds(milliseconds);
    const EventDrivenResult stopped =
        event_driven_pack(cell, bodies, options, RunContext{}.deadline(limit));
    check_valid(stopped);
    if (stopped.stop != EventDrivenStop::out_of_time) continue;
    check_continues(kept, stopped.state, options);
  }
}

TEST_CASE("a run that is cancelled before it begins has nothing, or what is valid") {
  const std::atomic<bool> cancel{true};
  const Cell cell{};
  for (const double min_gap : {0.0, 0.05}) {
    const EventDrivenResult result =
        event_driven_pack(cell, filling(cell, copies(kBall, 20), 0.3), {.min_gap = min_gap},
                          RunContext{}.cancel_flag(&cancel));
    CHECK(result.stop == EventDrivenStop::cancelled);
    check_valid(result, min_gap);
  }
}

TEST_CASE("a run out of time says so and keeps a valid packing") {
  const Cell cell{};
  const auto begin = RunContext::Clock::now();
  const EventDrivenResult result =
      event_driven_pack(cell, filling(cell, copies(kProlate, 100), 0.3),
                        {.goal = EventDrivenGoal::equilibrium, .collisions_per_body = 1e9},
                        RunContext{}.deadline(begin + std::chrono::milliseconds(200)));
  CHECK(result.stop == EventDrivenStop::out_of_time);
  check_valid(result);
}

TEST_CASE("a run reports how far it has come") {
  const Cell cell{};
  int reports = 0;
  const auto run = RunContext{}.on_progress([&](const Progress& progress) {
    ++reports;
    CHECK(progress.done <= 1.0);
    CHECK(progress.fraction <= 0.5);
    CHECK(!progress.stage.empty());
  });
  static_cast<void>(event_driven_pack(cell, filling(cell, copies(kBall, 30), 0.5), {}, run));
  CHECK(reports > 0);
}

TEST_CASE("event_driven_pack refuses options out of range and names field, value and range") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -0.1, 10.5, infinite, nan}) {
    const std::string message = refusal({.growth_rate = bad});
    check_names(message, {"EventDrivenOptions::growth_rate is ", "> 0 and <= 10"});
  }
  check_names(refusal({.growth_rate = 10.5}), {"10.5"});
  for (const double bad : {0.0, -1e-6, 0.2, nan}) {
    check_names(refusal({.slowest_growth = bad}),
                {"EventDrivenOptions::slowest_growth is ", "> 0 and <= growth_rate"});
  }
  check_names(refusal({.slowest_growth = 0.2}), {"0.2"});
  for (const double bad : {0.0, -3.0, infinite, nan}) {
    check_names(refusal({.collisions_per_body = bad}),
                {"EventDrivenOptions::collisions_per_body is ", "> 0"});
  }
  for (const double bad : {-0.01, infinite, nan, 1.5}) {
    check_names(refusal({.min_gap = bad}), {"EventDrivenOptions::min_gap is "});
  }
  CHECK(refusal({.growth_rate = 10.0}).empty());
  CHECK(refusal({.growth_rate = 0.01, .slowest_growth = 0.01}).empty());
}

TEST_CASE("event_driven_pack refuses before any work what no cell can hold") {
  const auto refused = [](const Cell& cell, const Bodies& bodies, EventDrivenOptions options = {}) {
    return message_of([&] { static_cast<void>(event_driven_pack(cell, bodies, options)); });
  };
  const Cell cell{};
  check_names(refused(cell, {{Sphere{0.2}, 0}, {Sphere{0.6}, 0}}), {"body 1", "sphere"});
  check_names(refused(cell, {{Disk{0.2}, 0}}), {"body 0", "dimension"});
  check_names(refused(cell, {{Sphere{-1.0}, 0}}), {"body 0"});
  check_names(refused(cell, {{Sphere{0.1}, -1}}), {"group is -1"});
  CHECK(!refused(cell, filling(cell, copies(kBall, 30), 0.75)).empty());
  CHECK(!refused(cell, filling(cell, copies(kRod, 30), 1.01)).empty());
  CHECK(!refused(cell, filling(cell, copies(kBall, 30), 0.6), {.min_gap = 0.1}).empty());
  // Turned as it is it meets its own image; if it may turn it can stand.
  const Bodies along{{Ellipsoid{{0.55, 0.05, 0.05}, {}}, 0}};
  CHECK(refused(cell, along).empty());
  EventDrivenOptions fixed;
  fixed.fixed_orientation = {true};
  CHECK(!refused(cell, along, fixed).empty());
  CHECK(!refused({4, {1, 1, 1}, {true, true, true}}, {{Sphere{0.1}, 0}}).empty());
}

TEST_CASE("an order that cannot be met ends as jammed, with a valid packing") {
  const Cell cell{};
  Bodies bodies = copies(kBall, 10);
  for (OrderedBody& b : copies(Sphere{1.2}, 10)) bodies.push_back(b);
  bodies = filling(cell, bodies, 0.73);
  const EventDrivenResult result = pack(cell, bodies, {.growth_rate = 0.3, .slowest_growth = 0.05});
  CHECK(result.stop == EventDrivenStop::jammed);
  CHECK(result.size_factor < 1.0);
  CHECK(fraction(result.packing) > 0.5);
  CHECK(fraction(result.packing) < 0.73);
  check_valid(result);
}

TEST_CASE("an empty order is met at once") {
  const EventDrivenResult result = pack(Cell{}, {});
  CHECK(result.stop == EventDrivenStop::target_reached);
  CHECK(result.packing.inclusions.empty());
}

TEST_CASE("the densest packing goes beyond what is ordered, in proportion") {
  const Cell cell{};
  const Bodies bodies = filling(cell, copies(kBall, 20), 0.01);
  const EventDrivenResult result = pack(
      cell, bodies, {.goal = EventDrivenGoal::densest, .growth_rate = 0.1, .slowest_growth = 0.03});
  CHECK(result.stop == EventDrivenStop::jammed);
  CHECK(fraction(result.packing) > 0.58);
  CHECK(fraction(result.packing) < 0.7405);
  const double radius = std::get<Sphere>(bodies[0].body).radius;
  for (const Inclusion& inclusion : result.packing.inclusions) {
    CHECK(std::get<Sphere>(inclusion.body).radius == Approx(result.size_factor * radius));
  }
  check_valid(result);
}

TEST_CASE("the densest packing of one ball is the one that touches its own images") {
  const auto soon = RunContext::Clock::now() + std::chrono::seconds(2);
  const EventDrivenResult result = event_driven_pack(
      Cell{}, {{Sphere{0.1}, 0}}, {.goal = EventDrivenGoal::densest}, RunContext{}.deadline(soon));
  CHECK(result.stop == EventDrivenStop::jammed);
  CHECK(result.size_factor == Approx(5.0).epsilon(1e-9));
  check_valid(result);
}

TEST_CASE("in equilibrium the bodies keep their size and their energy") {
  const Cell cell{};
  for (const Body& shape : {kBall, kProlate, kOblate}) {
    const Bodies bodies = filling(cell, copies(shape, 64), 0.3);
    const EventDrivenResult result =
        pack(cell, bodies, {.goal = EventDrivenGoal::equilibrium, .collisions_per_body = 100.0});
    check_reached(cell, bodies, result);
    CHECK(result.report.energy_drift < 1e-12);
    // That of spheres by N. F. Carnahan and K. E. Starling (1969) is 3.97; statistics of 6400
    // collisions and 64 bodies.
    if (shape == kBall) CHECK(result.report.reduced_pressure == Approx(3.97).epsilon(0.06));
    CHECK(result.report.reduced_pressure > 3.0);
  }
}

TEST_CASE("the published criterion ends a run earlier") {
  const Cell cell{};
  const Bodies bodies = filling(cell, copies(kProlate, 30), 0.64);
  const EventDrivenResult patient = pack(cell, bodies, {.growth_rate = 0.01});
  const EventDrivenResult hasty =
      pack(cell, bodies, {.growth_rate = 0.01, .published_stagnation = true});
  CHECK(hasty.stop == EventDrivenStop::stagnated);
  CHECK(hasty.size_factor < patient.size_factor);
  CHECK(hasty.report.collisions < patient.report.collisions);
  check_valid(hasty);
}

TEST_CASE("report and history of a run agree") {
  const Cell cell{};
  const Bodies bodies = filling(cell, copies(kProlate, 40), 0.5);
  const EventDrivenResult result = pack(cell, bodies, {.growth_rate = 0.01});
  const auto& history = result.history;
  REQUIRE(history.size() >= 3);
  CHECK(static_cast<std::int64_t>(history.size()) == result.report.blocks);
  CHECK(history.back().collisions == result.report.collisions);
  CHECK(history.back().size_factor == 1.0);
  CHECK(history.back().fraction == Approx(0.5));
  for (std::size_t k = 1; k < history.size(); ++k) {
    CHECK(history[k].time > history[k - 1].time);
    CHECK(history[k].collisions >= history[k - 1].collisions);
    CHECK(history[k].fraction > history[k - 1].fraction);
    CHECK(history[k].fraction == Approx(0.5 * std::pow(history[k].size_factor, 3)));
  }
  for (const EventDrivenSample& sample : history) {
    CHECK(sample.reduced_pressure >= 1.0);
    CHECK(sample.collision_rate >= 0.0);
    CHECK(sample.growth_rate > 0.0);
    CHECK(sample.nematic_order >= 0.0);
    CHECK(sample.nematic_order <= 1.0);
    CHECK(sample.kinetic_energy > 0.5);
  }
  CHECK(result.report.predictions > result.report.collisions);
  CHECK(result.report.steps >= result.report.searches);
  CHECK(result.report.searches > 0);
  CHECK(result.report.neighbor_searches > 0);
}

TEST_CASE("only a gas that is dilute or thin grows faster than is ordered") {
  const Cell cell{};
  // The dilute one has no pressure yet.
  constexpr double kThin = 6.0, kDilute = 0.12;
  for (const double growth : {0.1, 0.01}) {
    const EventDrivenResult result =
        pack(cell, filling(cell, mixture(3, 30, 15), 0.55), {.growth_rate = growth});
    REQUIRE(result.stop == EventDrivenStop::target_reached);
    int crowded = 0;
    double fraction = 0.0, pressure = 0.0;
    for (const EventDrivenSample& sample : result.history) {
      const double part = pressure > 0.0 && pressure < kThin ? kThin / pressure : 1.0;
      const double most = std::min(1.0, growth * part * part);
      if (fraction >= kDilute) CHECK(sample.growth_rate <= most * 1.001);
      if (fraction >= kDilute && part == 1.0) ++crowded;
      fraction = sample.fraction;
      pressure = sample.reduced_pressure;
    }
    // The fast one may come to its end before it crowds.
    CHECK((crowded > 0 || growth == 0.1));
  }
}

TEST_CASE("event_driven_continue starts from what stands, and refuses what overlaps") {
  MovingPacking start;
  start.packing = scenes::jostled_ellipsoids(32, 0.4, 3);
  start.size_factor = 1.0;
  const EventDrivenOptions equilibrium{.goal = EventDrivenGoal::equilibrium,
                                       .collisions_per_body = 20.0};
  const EventDrivenResult result = event_driven_continue(start, equilibrium);
  CHECK(result.stop == EventDrivenStop::target_reached);
  CHECK(result.size_factor == 1.0);
  check_valid(result);
  CHECK(hash_of(result) != scenes::state_hash(start.packing));

  MovingPacking smaller = start;
  smaller.size_factor = 0.5;
  const EventDrivenResult grown = event_driven_continue(smaller);
  CHECK(grown.stop == EventDrivenStop::target_reached);
  CHECK(grown.size_factor == 1.0);
  check_valid(grown);

  MovingPacking overlapping = start;
  overlapping.packing.inclusions[1].center = overlapping.packing.inclusions[0].center;
  check_names(message_of([&] { static_cast<void>(event_driven_continue(overlapping)); }),
              {"worst pair 0 and 1"});
  MovingPacking few = start;
  few.velocity.resize(3);
  CHECK(!message_of([&] { static_cast<void>(event_driven_continue(few)); }).empty());
}

TEST_CASE("every reason to stop has a name of its own") {
  CHECK(name(EventDrivenStop::target_reached) == "target_reached");
  CHECK(name(EventDrivenStop::jammed) == "jammed");
  CHECK(name(EventDrivenStop::stagnated) == "stagnated");
  CHECK(name(EventDrivenStop::cancelled) == "cancelled");
  CHECK(name(EventDrivenStop::out_of_time) == "out_of_time");
}

}  // namespace packstone
