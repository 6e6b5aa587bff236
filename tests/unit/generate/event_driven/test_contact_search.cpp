#include "generate/event_driven/contact_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "generate/event_driven/collision.hpp"
#include "generate/event_driven/plane_search.hpp"
#include "geometry/touching_points.hpp"
#include "judged_search.hpp"
#include "movers.hpp"
#include "support/each_pair.hpp"
#include "support/validation_seed.hpp"

namespace packstone::event_driven {
namespace {

using movers::check_search;
using movers::Motion;
using movers::Scene;
using movers::Tally;
using movers::visible_turn;

// A gap to begin with: from nearly none to the size of the pair.
double random_gap(const zoo::Pair& pair, zoo::Zoo& zoo) {
  return zoo::size_of(pair) * zoo.log_uniform(1e-8, 0.5);
}

Scene random_scene(const zoo::Pair& pair, Motion motion, zoo::Zoo& zoo) {
  motion.min_gap *= zoo::size_of(pair);
  return movers::approaching(zoo::moved_apart(pair, motion.min_gap + random_gap(pair, zoo)), motion,
                             zoo);
}

// `count` pairs of every kind of shapes and every class of pairs.
Tally search_zoo(std::uint64_t seed, int count, const Motion& motion) {
  zoo::Zoo zoo(seed);
  Tally tally;
  zoo::for_each_pair(seed, count, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    check_search(random_scene(pair, motion, zoo), {1, {}}, tally);
  });
  return tally;
}

// From time 0 as far as the engine may look.
Found search_from_start(const Scene& scene, Tally& tally) {
  const Bodies bodies = bodies_of(scene);
  ContactSearch search(bodies, scene.cell);
  Vec3 normal;
  return movers::search_to_the_end(0.0, movers::longest_look(scene), tally,
                                   [&](double from, double until) {
                                     return search.first_contact(0, {1, {}}, from, until, normal);
                                   });
}

void check_from_start(const Scene& scene, const Found& found) {
  const Bodies bodies = bodies_of(scene);
  const ContactSearch search(bodies, scene.cell);
  movers::check_found(scene, 0, {1, {}}, 0.0, movers::longest_look(scene), found, search);
}

bool touch_at_once(const Found& found) {
  return found.finding == Finding::contact && found.time == 0.0;
}

// The two of the scene collide at t, from where it goes on. Returns whether they share a side.
bool collide_at(Scene& scene, double t) {
  Bodies bodies = bodies_of(scene);
  const ContactSearch search(bodies, scene.cell);
  for (std::int32_t i = 0; i < 2; ++i) bodies.advance(i, t);
  const Contact contact = search.contact(0, {1, {}}, t, {});
  collide(bodies, 0, {1, {}}, contact, t);
  scene.size = bodies.size_at(t);
  for (std::size_t k = 0; k < 2; ++k) {
    movers::Mover& m = scene.movers[k];
    m = {turned_body(bodies, static_cast<std::int32_t>(k), m.body), bodies.flight[k].center,
         bodies.flight[k].velocity, bodies.spin[k].angular};
  }
  const auto posed_now = [&](std::int32_t i) {
    return posed(bodies, i, bodies.pose(i, t), scene.size);
  };
  const auto far_to = [&](const Vec3& toward) {
    return touching_points(posed_now(0), posed_now(1), contact.between, contact.normal, toward);
  };
  const Vec3 way = any_perpendicular(contact.normal);
  return norm(far_to(way).of_a - far_to(-way).of_a) > 0.0 ||
         norm(far_to(cross(contact.normal, way)).of_a - far_to(way).of_a) > 0.0;
}

void check_tally(const Tally& tally) {
  CHECK(tally.contacts > tally.searches / 10);
  CHECK(tally.contacts < tally.searches * 9 / 10);
  // An engine that looks again and again does not get on.
  CHECK(tally.looks_again < tally.searches / 10);
  CHECK(tally.steps < 25 * tally.searches);
}

Tally search_spheroids(double aspect, double other_aspect, double tilt, double growth, int count,
                       zoo::Zoo& zoo) {
  Tally tally;
  for (int k = 0; k < count; ++k) {
    CAPTURE(aspect, other_aspect, tilt, growth, k);
    const Quaternion turn = zoo.rotation();
    const Quaternion other =
        tilt < 0.0 ? zoo.rotation() : normalized(from_axis_angle(zoo.direction(3), tilt) * turn);
    const zoo::Pair pair{movers::spheroid(aspect, turn), movers::spheroid(other_aspect, other),
                         zoo.uniform(0.1, 1.0) * zoo.direction(3)};
    Motion motion{zoo.log_uniform(1e-3, 3.0), growth};
    Scene scene = random_scene(pair, motion, zoo);
    // Parallel bodies that stay parallel.
    if (k % 3 == 0) scene.movers[1].angular = visible_turn(pair.b, scene.movers[0].angular);
    check_search(scene, {1, {}}, tally);
  }
  return tally;
}

constexpr double kAspects[] = {1.0,   1.000001,  1.001, 2.0, 10.0,  40.0,
                               100.0, 1 / 1.001, 0.5,   0.1, 0.025, 0.01};

}  // namespace

TEST_CASE("no contact of any pair of shapes is missed, and none is found late or early") {
  check_tally(search_zoo(1, 12, {1.0}));
}

TEST_CASE("no contact is missed between bodies that hardly turn, or turn fast") {
  check_tally(search_zoo(2, 6, {1e-4}));
  const Tally fast = search_zoo(3, 6, {10.0});
  CHECK(fast.contacts > fast.searches / 30);
}

TEST_CASE("no contact is missed between bodies that grow") {
  check_tally(search_zoo(4, 6, {1.0, 0.1}));
  check_tally(search_zoo(5, 6, {0.1, 1.0}));
}

TEST_CASE("bodies that are to keep a least gap are stopped at it") {
  check_tally(search_zoo(6, 4, {1.0, 0.0, 0.02}));
  check_tally(search_zoo(7, 4, {1.0, 0.1, 0.2}));
}

TEST_CASE("no contact of needles and lenses is missed, whatever their aspect") {
  zoo::Zoo zoo(8);
  for (const double aspect : kAspects) {
    for (const double growth : {0.0, 0.1}) search_spheroids(aspect, aspect, -1.0, growth, 60, zoo);
    search_spheroids(aspect, 1.0, -1.0, 0.0, 30, zoo);
    search_spheroids(aspect, 1.0 / aspect, -1.0, 0.0, 30, zoo);
  }
}

TEST_CASE("no contact is missed between bodies whose axes are parallel or nearly so") {
  zoo::Zoo zoo(9);
  for (const double aspect : kAspects) {
    for (const double tilt : {0.0, 1e-15, 1e-9, 1e-5}) {
      search_spheroids(aspect, aspect, tilt, 0.0, 30, zoo);
    }
  }
}

TEST_CASE("no contact of a body with its own image is missed, however much longer it is") {
  zoo::Zoo zoo(10);
  Tally tally;
  for (int k = 0; k < 6000; ++k) {
    CAPTURE(k);
    const Body body = zoo.body(k % 3 == 0   ? ShapeKind::ellipsoid
                               : k % 3 == 1 ? ShapeKind::cylinder
                                            : ShapeKind::spherocylinder,
                               1.0);
    const double reach = circum_radius(body);
    Scene scene;
    scene.growth = k % 2 == 0 ? 0.0 : 0.1;
    const Vec3 angular = visible_turn(body, zoo.uniform(0, 2) * zoo.direction(3));
    scene.movers.push_back({body, {}, zoo.direction(3), angular});
    const Vec3 shift = reach * zoo.log_uniform(0.05, 2.0) * zoo.direction(3);
    scene.cell.size = {3 * reach, 3 * reach, 3 * reach};
    if (gap(body, body, shift).value <= 1e-9 * reach) continue;
    check_search(scene, {0, shift}, tally);
  }
  CHECK(tally.searches > 2000);
  CHECK(tally.contacts > tally.searches / 20);
}

TEST_CASE("no contact with a wall is missed") {
  zoo::Zoo zoo(11);
  Tally tally;
  for (int k = 0; k < 6000; ++k) {
    const auto shape = static_cast<ShapeKind>(k % 6);
    CAPTURE(name(shape), k);
    const int dim = dimension(shape);
    const Body body = zoo.body(shape, 1.0);
    const double reach = circum_radius(body);
    Scene scene;
    scene.growth = k % 2 == 0 ? 0.0 : 0.1;
    scene.cell = {dim, {4 * reach, 5 * reach, dim == 3 ? 6 * reach : 0.0}, {false, false, false}};
    Vec3 center = 0.5 * scene.cell.size;
    const int axis = static_cast<int>(zoo.uniform(0, dim));
    const bool high = zoo.uniform(0, 1) < 0.5;
    const auto a = static_cast<std::size_t>(axis);
    const double from = half_extents(body)[a] + reach * zoo.log_uniform(1e-9, 0.3);
    center[a] = high ? scene.cell.size[a] - from : from;
    const Vec3 angular = visible_turn(body, zoo.uniform(0, 2) * zoo.direction(3));
    scene.movers.push_back({body, center, reach * zoo.uniform(0, 1) * zoo.direction(dim), angular});
    check_search(scene, {wall(axis, high), {}}, tally);
  }
  check_tally(tally);
}

TEST_CASE(
    "two that have just collided may be searched from there, and do not touch at once again") {
  zoo::Zoo zoo(12);
  int collided = 0;
  zoo::for_each_pair(12, 8, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    const Motion motion{1.0, zoo.uniform(0, 1) < 0.5 ? 0.0 : 0.1};
    Scene scene = random_scene(pair, motion, zoo);
    Tally tally;
    const Found first = search_from_start(scene, tally);
    if (first.finding != Finding::contact) return;
    ++collided;
    const bool along_sides = collide_at(scene, first.time);
    Found next = search_from_start(scene, tally);
    // Where they share a side, one end of it may come down as the other one rises.
    for (int k = 0; along_sides && k < 4 && touch_at_once(next); ++k) {
      collide_at(scene, 0.0);
      next = search_from_start(scene, tally);
    }
    REQUIRE_FALSE(touch_at_once(next));
    check_from_start(scene, next);
  });
  CHECK(collided > 300);
}

TEST_CASE("the speed at which surfaces approach is that at which the gap closes") {
  zoo::Zoo zoo(13);
  int contacts = 0, off = 0;
  zoo::for_each_pair(13, 12, [&](const zoo::Pair& pair, zoo::PairClass, int) {
    const Scene scene = random_scene(pair, {0.5, zoo.uniform(0, 1) < 0.5 ? 0.0 : 0.1}, zoo);
    const Bodies bodies = bodies_of(scene);
    ContactSearch search(bodies, scene.cell);
    Vec3 normal;
    const Found found = search.first_contact(0, {1, {}}, 0.0, movers::longest_look(scene), normal);
    if (found.finding != Finding::contact) return;
    const Contact contact = search.contact(0, {1, {}}, found.time, normal);
    // Far enough back that the gap is not all rounding, near enough that the rate is the same.
    const double back = 1e-7 * zoo::size_of(pair) / contact.approach;
    if (back > 1e-4) return;
    const auto gap_at = [&](double t) { return movers::clearance(scene, 0, {1, {}}, t).value; };
    const double closed = gap_at(found.time - back) - gap_at(found.time);
    ++contacts;
    off += std::abs(closed / back / contact.approach - 1.0) > 1e-2;
  });
  CHECK(contacts > 500);
  // Sharp tips, over which the contact moves fast.
  CHECK(off < contacts / 50);
}

TEST_CASE("first_contact() reads a gap as its gap() does, and counts the most negative one") {
  Scene scene;
  scene.movers.push_back({Ellipsoid{{2, 1, 1}, {}}, {}, {}, {}});
  scene.movers.push_back({Ellipsoid{{2, 1, 1}, {}}, {3.75, 0, 0}, {}, {}});
  scene.cell.size = {20, 20, 20};
  const Bodies bodies = bodies_of(scene);
  ContactSearch search(bodies, scene.cell);
  CHECK(search.gap(0, {1, {}}, 0.0) == Approx(-0.25).epsilon(1e-12));
  CHECK(search.gap(0, {1, {0.5, 0, 0}}, 0.0) == Approx(0.25).epsilon(1e-12));
  CHECK(search.count().least_gap == 0.0);
  Vec3 normal;
  static_cast<void>(search.first_contact(0, {1, {}}, 0.0, 1.0, normal));
  CHECK(search.count().least_gap == Approx(-0.25).epsilon(1e-9));
  CHECK(search.count().searches == 1);
}

TEST_CASE("a million random pairs of all shapes, none of whose contacts is missed",
          "[validation]") {
  const std::uint64_t seed = validation_seed(14);
  Tally all;
  for (const Motion& motion : {Motion{1.0}, Motion{1.0, 0.1}, Motion{3.0, 0.0, 0.0},
                               Motion{0.3, 0.3, 0.0}, Motion{1.0, 0.05, 0.05}}) {
    const Tally tally = search_zoo(seed, 1100, motion);
    all.searches += tally.searches;
    all.contacts += tally.contacts;
  }
  CHECK(all.searches >= 1'000'000);
  CHECK(all.contacts > all.searches / 10);
}

}  // namespace packstone::event_driven
