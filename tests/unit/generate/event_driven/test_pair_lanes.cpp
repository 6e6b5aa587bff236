#include "generate/event_driven/pair_lanes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "generate/event_driven/lane_kernels.hpp"
#include "judged_search.hpp"
#include "movers.hpp"

namespace packstone::event_driven {
namespace {

using movers::Scene;
using movers::Tally;

constexpr double kNever = std::numeric_limits<double>::infinity();

// A body among others that are clear of it, each in its list through some image.
struct Crowd {
  Scene scene;
  std::vector<Neighbor> list;
  std::vector<double> times;  // Of the events of all.
};

Partner partner_of(const Crowd& crowd, const Neighbor& n) {
  return {n.body, image_shift(crowd.scene.cell, {n.image[0], n.image[1], n.image[2]})};
}

template <class Draw>
Crowd crowd_of(int others, double growth, double min_gap, zoo::Zoo& zoo, const Draw& draw) {
  Crowd crowd;
  crowd.scene.growth = growth;
  crowd.scene.min_gap = min_gap;
  crowd.scene.cell.size = {3.0, 4.0, 5.0};
  const auto mover = [&](const Body& body) {
    return movers::Mover{body,
                         {},
                         zoo.uniform(0, 1) * zoo.direction(3),
                         movers::visible_turn(body, zoo.uniform(0, 1) * zoo.direction(3))};
  };
  crowd.scene.movers.push_back(mover(draw()));
  crowd.scene.movers[0].center = zoo.direction(3);
  crowd.times.push_back(kNever);
  for (int k = 1; k <= others; ++k) {
    movers::Mover m = mover(draw());
    zoo::Pair pair{crowd.scene.movers[0].body, m.body, zoo.uniform(0.5, 2.5) * zoo.direction(3)};
    pair = zoo::moved_apart(pair, min_gap + zoo.log_uniform(1e-8, 0.5));
    Neighbor n;
    n.body = k;
    n.hint[0] = 0.5F;
    for (auto& image : n.image) image = static_cast<std::int16_t>(zoo.uniform(-3, 3));
    m.velocity = zoo.uniform(0, 1) * (zoo.direction(3) - 2.0 * normalized(pair.r));
    m.center = crowd.scene.movers[0].center + pair.r - partner_of(crowd, n).shift;
    crowd.scene.movers.push_back(m);
    crowd.list.push_back(n);
    crowd.times.push_back(zoo.uniform(0, 1) < 0.5 ? kNever : zoo.uniform(0.0, 0.5));
  }
  return crowd;
}

// Own images and walls stand in the same list.
void add_own_image_and_wall(Crowd& crowd, zoo::Zoo& zoo) {
  Neighbor own;
  own.body = 0;
  own.image[0] = 1;
  own.hint[0] = 0.5F;
  Neighbor edge;
  edge.body = wall(1, true);
  for (const Neighbor& n : {own, edge}) {
    const auto at =
        static_cast<std::ptrdiff_t>(zoo.uniform(0, static_cast<double>(crowd.list.size() + 1)));
    crowd.list.insert(crowd.list.begin() + at, n);
  }
}

// Stands the body at t, the others still where they are.
Bodies standing(const Crowd& crowd, double t) {
  Bodies bodies = bodies_of(crowd.scene);
  bodies.advance(0, t);
  return bodies;
}

struct Seen {
  std::vector<std::optional<Suspect>> suspect;  // By place in the list.
  double least_gap = 0.0;
};

Seen look(const PairLanes& lanes, Crowd& crowd, double t, double horizon) {
  std::vector<Suspect> suspects(crowd.list.size() + PairLanes::kLanes);
  Seen seen;
  const std::size_t count =
      lanes.look(0, t, horizon, crowd.times.data(), crowd.list, suspects.data(), seen.least_gap);
  seen.suspect.resize(crowd.list.size());
  REQUIRE(count <= crowd.list.size());
  for (std::size_t k = 0; k < count; ++k) {
    auto& place = seen.suspect.at(static_cast<std::size_t>(suspects[k].neighbor));
    REQUIRE_FALSE(place);
    place = suspects[k];
  }
  return seen;
}

double horizon_of(const Crowd& crowd, const Neighbor& n, double horizon) {
  return n.body == 0 ? horizon : std::min(horizon, crowd.times[static_cast<std::size_t>(n.body)]);
}

Body any_of_revolution(zoo::Zoo& zoo) {
  const double aspect = zoo.uniform(0, 1) < 0.2 ? 1.0 : zoo.log_uniform(0.02, 50.0);
  return scaled(movers::spheroid(aspect, zoo.rotation()), zoo.log_uniform(0.2, 1.2));
}

// Whoever was cleared stays away; whoever was not is searched, from where the lanes leave it.
void check_revolution(Crowd& crowd, const Bodies& bodies, const Seen& seen, double t,
                      double horizon, Tally& tally) {
  ContactSearch search(bodies, crowd.scene.cell);
  for (std::size_t k = 0; k < crowd.list.size(); ++k) {
    const Neighbor& n = crowd.list[k];
    const auto& suspect = seen.suspect[k];
    if (is_wall(n.body)) {
      REQUIRE_FALSE(suspect);
      continue;
    }
    ++tally.searches;
    const double until = std::max(t, horizon_of(crowd, n, horizon));
    const Partner partner = partner_of(crowd, n);
    Found found;
    if (suspect) {
      ++tally.contacts;
      found = movers::search_to_the_end(t, until, tally, [&](double from, double to) {
        // What the lanes have proven holds for the first look.
        const double clear = from == t ? suspect->time : 0.0;
        return search.first_contact_of_revolution(0, partner, from, to, {suspect->l, clear});
      });
    }
    CAPTURE(k, n.body, suspect.has_value());
    movers::check_found(crowd.scene, 0, partner, t, until, found, search);
  }
}

}  // namespace

TEST_CASE("lanes say what they can do") {
  zoo::Zoo zoo(1);
  const auto kind = [](const Body& a, const Body& b, double min_gap) {
    Scene scene;
    scene.min_gap = min_gap;
    scene.movers = {{a, {}, {}, {}}, {b, {}, {}, {}}};
    return PairLanes::kind_of(bodies_of(scene));
  };
  const Body ball = Sphere{1}, spheroid = Ellipsoid{{1, 1, 2}, {}},
             scalene = Ellipsoid{{1, 2, 3}, {}};
  using Kind = PairLanes::Kind;
  CHECK(kind(ball, ball, 0.0) == Kind::balls);
  CHECK(kind(ball, ball, 0.1) == Kind::balls);
  CHECK(kind(ball, spheroid, 0.0) == Kind::revolution);
  CHECK(kind(ball, scalene, 0.0) == Kind::none);
  CHECK(kind(ball, Cylinder{1, 1}, 0.0) == Kind::none);
  CHECK(kind(Disk{1}, Ellipse{{1, 2}, 0.3}, 0.0) == Kind::revolution);
}

TEST_CASE("lanes clear no body of revolution that touches before the horizon or its own event") {
  zoo::Zoo zoo(2);
  Tally tally;
  for (int round = 0; round < 250; ++round) {
    CAPTURE(round);
    const double growth = round % 3 == 0 ? 0.0 : zoo.log_uniform(1e-3, 0.5);
    const int others = static_cast<int>(zoo.uniform(1, 21));
    Crowd crowd = crowd_of(others, growth, 0.0, zoo, [&] { return any_of_revolution(zoo); });
    if (circum_radius(crowd.scene.movers[0].body) < 0.7) add_own_image_and_wall(crowd, zoo);
    double t = round % 4 == 0 ? 0.0 : zoo.uniform(0.0, 1e-3);
    // Again from the hints that the first look has left.
    for (int again = 0; again < 2; ++again, t += 1e-4) {
      const Bodies bodies = standing(crowd, t);
      const PairLanes lanes(bodies, crowd.scene.cell, lane_kernels());
      REQUIRE(lanes.kind() == PairLanes::Kind::revolution);
      const double horizon = t + zoo.log_uniform(1e-4, 0.5);
      const Seen seen = look(lanes, crowd, t, horizon);
      // Those that touched in between are of no interest.
      bool apart = true;
      for (const Neighbor& n : crowd.list) {
        apart = apart && (is_wall(n.body) ||
                          movers::clearance(crowd.scene, 0, partner_of(crowd, n), t).value > 0.0);
      }
      if (!apart) break;
      check_revolution(crowd, bodies, seen, t, horizon, tally);
    }
  }
  CHECK(tally.searches > 3000);
  // Most of them, with a short horizon.
  CHECK(tally.contacts < tally.searches / 2);
}

TEST_CASE("lanes find balls touch when the search for one pair does") {
  zoo::Zoo zoo(3);
  int contacts = 0, pairs = 0;
  for (int round = 0; round < 600; ++round) {
    CAPTURE(round);
    const double growth = round % 3 == 0 ? 0.0 : zoo.log_uniform(1e-3, 2.0);
    const double min_gap = round % 2 == 0 ? 0.0 : 0.05;
    const int others = static_cast<int>(zoo.uniform(1, 21));
    Crowd crowd =
        crowd_of(others, growth, min_gap, zoo, [&] { return Sphere{zoo.log_uniform(0.01, 0.6)}; });
    add_own_image_and_wall(crowd, zoo);
    const Bodies bodies = standing(crowd, zoo.uniform(0.0, 1e-9));
    const double t = bodies.flight[0].clock, horizon = t + zoo.log_uniform(1e-3, 2.0);
    const PairLanes lanes(bodies, crowd.scene.cell, lane_kernels());
    const Seen seen = look(lanes, crowd, t, horizon);
    ContactSearch search(bodies, crowd.scene.cell);
    for (std::size_t k = 0; k < crowd.list.size(); ++k) {
      const Neighbor& n = crowd.list[k];
      if (is_wall(n.body)) {
        REQUIRE_FALSE(seen.suspect[k]);
        continue;
      }
      ++pairs;
      const Partner partner = partner_of(crowd, n);
      const double until = horizon_of(crowd, n, horizon);
      Vec3 normal;
      const Found found = search.first_contact(0, partner, t, until, normal);
      const bool hit = found.finding == Finding::contact;
      CAPTURE(k, found.time, until, seen.suspect[k].has_value());
      // Rounding of the square of the gap that counts as contact, and of grazing ones.
      const double slack = 1e-7;
      if (hit != seen.suspect[k].has_value()) {
        const double time = hit ? found.time : seen.suspect[k]->time;
        const movers::Clearance c = movers::clearance(crowd.scene, 0, partner, time);
        REQUIRE((time > until - slack || std::abs(c.value) < 1e-11));
        continue;
      }
      if (!hit) continue;
      ++contacts;
      const double gap_then =
          movers::clearance(crowd.scene, 0, partner, seen.suspect[k]->time).value;
      REQUIRE(gap_then >= -1e-14);
      REQUIRE(gap_then <= search.contact_gap(0, partner, t) + 1e-14);
      // The same gap, some times closed slowly.
      REQUIRE(seen.suspect[k]->time == Approx(found.time).margin(1e-5));
    }
  }
  CHECK(contacts > pairs / 40);
}

TEST_CASE("lanes of balls report how deep the worst overlap is") {
  Scene scene;
  scene.cell.size = {10, 10, 10};
  scene.movers = {{Sphere{1}, {1, 1, 1}, {}, {}},
                  {Sphere{1}, {2.75, 1, 1}, {}, {}},
                  {Sphere{1}, {1, 4, 1}, {}, {}}};
  Crowd crowd{scene, std::vector<Neighbor>(2), std::vector<double>(3, kNever)};
  crowd.list[0].body = 1;
  crowd.list[1].body = 2;
  const Bodies bodies = bodies_of(scene);
  const PairLanes lanes(bodies, scene.cell, lane_kernels());
  // By the difference of squares, which for small overlaps is the gap.
  CHECK(look(lanes, crowd, 0.0, 1.0).least_gap == Approx(-0.25).epsilon(0.1));
  crowd.scene.movers[1].center.x = 3.5;
  const Bodies apart = bodies_of(crowd.scene);
  CHECK(look(PairLanes(apart, scene.cell, lane_kernels()), crowd, 0.0, 1.0).least_gap == 0.0);
}

TEST_CASE("lanes keep whoever has no number for a place as suspect") {
  zoo::Zoo zoo(4);
  Crowd crowd = crowd_of(3, 0.0, 0.0, zoo, [&] { return any_of_revolution(zoo); });
  std::fill(crowd.times.begin(), crowd.times.end(), kNever);
  Bodies bodies = bodies_of(crowd.scene);
  if (PairLanes::kind_of(bodies) != PairLanes::Kind::revolution) return;
  bodies.flight[2].center.x = std::numeric_limits<double>::quiet_NaN();
  CHECK(look(PairLanes(bodies, crowd.scene.cell, lane_kernels()), crowd, 0.0, 1e-6).suspect[1]);
}

TEST_CASE("every width of registers gives the same bits") {
  std::vector<const LaneKernels*> widths{&kLanesByTwo};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") != 0) widths.push_back(&kLanesByFour);
  if (__builtin_cpu_supports("avx512f") != 0) widths.push_back(&kLanesByEight);
#endif
  zoo::Zoo zoo(4);
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    const bool balls = round % 2 == 0;
    Crowd crowd = crowd_of(static_cast<int>(zoo.uniform(1, 21)), zoo.uniform(0.0, 0.3), 0.0, zoo,
                           [&] { return balls ? Sphere{0.3} : any_of_revolution(zoo); });
    const Bodies bodies = standing(crowd, 1e-4);
    const std::vector<Neighbor> fresh = crowd.list;
    const Seen first = look({bodies, crowd.scene.cell, kLanesByTwo}, crowd, 1e-4, 0.2);
    const std::vector<Neighbor> list = crowd.list;
    for (const LaneKernels* kernels : widths) {
      crowd.list = fresh;
      const Seen same = look({bodies, crowd.scene.cell, *kernels}, crowd, 1e-4, 0.2);
      REQUIRE(same.least_gap == first.least_gap);
      for (std::size_t k = 0; k < list.size(); ++k) {
        REQUIRE(crowd.list[k].hint[0] == list[k].hint[0]);
        REQUIRE(same.suspect[k].has_value() == first.suspect[k].has_value());
        if (!same.suspect[k]) continue;
        REQUIRE(same.suspect[k]->time == first.suspect[k]->time);
        REQUIRE(same.suspect[k]->l == first.suspect[k]->l);
      }
    }
  }
}

}  // namespace packstone::event_driven
