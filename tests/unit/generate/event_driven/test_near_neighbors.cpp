#include "generate/event_driven/near_neighbors.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <utility>
#include <vector>

#include "generate/event_driven/event_queue.hpp"
#include "movers.hpp"
#include "scattered.hpp"

namespace packstone::event_driven {
namespace {

using movers::Scattering;
using movers::Scene;

using enum ShapeKind;

constexpr Cell kWalls{3, {1.0, 1.4, 0.8}, {false, true, false}};

const Scattering kScatterings[] = {
    {"balls", {}, 120, {sphere}, 0.08, 0.08},
    {"balls that grow", {}, 120, {sphere}, 0.08, 0.08, 0.0, 0.5},
    {"balls of sizes 1 to 1000", {}, 150, {sphere}, 3e-4, 0.3},
    {"spheroids", {3, {1.0, 0.7, 1.4}, {true, true, true}}, 100, {ellipsoid}, 0.1, 0.2, 2.0},
    {"needles longer than the cell", {}, 12, {ellipsoid}, 0.8, 1.1, 40.0, 0.1},
    {"one rod that meets its own images alone", {}, 1, {cylinder}, 1.3, 1.3, 30.0},
    {"lenses", {}, 60, {ellipsoid}, 0.15, 0.25, 0.05},
    {"all shapes", {}, 80, {sphere, ellipsoid, cylinder, spherocylinder}, 0.05, 0.3, 0.0, 0.2},
    {"between walls", kWalls, 60, {sphere, ellipsoid, cylinder}, 0.05, 0.2, 4.0, 0.1},
    {"the plane", cell_2d(1.0, 0.7), 80, {disk, ellipse}, 0.05, 0.1, 0.0, 0.1},
    {"many needles", {}, 420, {ellipsoid}, 0.2, 0.25, 30.0, 0.05},
    {"many rods", {}, 410, {cylinder, spherocylinder}, 0.15, 0.3, 20.0},
};

using Image = std::array<int, 3>;
using Listed = std::set<std::pair<std::int32_t, Image>>;

Image image_of(const Neighbor& n) { return {n.image[0], n.image[1], n.image[2]}; }

// Bodies that fly through each other, and their lists.
class Flying {
 public:
  Flying(const Scattering& s, std::uint64_t seed)
      : scene_(scattered(s, seed)), bodies_(bodies_of(scene_)), near_(bodies_, s.cell) {
    near_.rebuild_all(0.0);
    queue_.reset(bodies_.count());
    for (std::int32_t i = 0; i < bodies_.count(); ++i) queue_.set(i, near_.exit_time(i, 0.0));
  }

  // Carries out exits, each with or without a new list, and now and then a change of velocity.
  void fly(int exits, zoo::Zoo& zoo) {
    for (int k = 0; k < exits; ++k) {
      const std::int32_t i = queue_.next();
      now_ = queue_.time(i);
      bodies_.advance(i, now_);
      if (near_.room_left(i, now_) < 0.1) near_.rebuild(i, now_);
      if (zoo.uniform(0, 1) < 0.3) {
        const int dim = scene_.cell.dimension;
        bodies_.flight[at(i)].velocity = zoo.uniform(0, 1) * zoo.direction(dim);
      }
      queue_.set(i, near_.exit_time(i, now_));
      REQUIRE(queue_.time(i) >= now_);
    }
    for (std::int32_t i = 0; i < bodies_.count(); ++i) bodies_.advance(i, now_);
  }

  [[nodiscard]] std::vector<Listed> lists() {
    std::vector<Listed> lists(bodies_.flight.size());
    for (std::int32_t i = 0; i < bodies_.count(); ++i) {
      for (const Neighbor& n : near_.of(i)) {
        // Nobody twice.
        REQUIRE(lists[at(i)].insert({n.body, image_of(n)}).second);
      }
    }
    return lists;
  }

  void check_mutual() {
    const std::vector<Listed> all = lists();
    for (std::int32_t i = 0; i < bodies_.count(); ++i) {
      for (const auto& [j, m] : all[at(i)]) {
        if (is_wall(j)) continue;
        const bool back = all[at(j)].count({i, {-m[0], -m[1], -m[2]}}) > 0;
        // Own images stand in their list once, in one of the two directions.
        REQUIRE(back == (j != i));
      }
    }
  }

  // Lets all that are near each other, but not in each other's lists, fly at each other until one
  // leaves its neighborhood: they must not meet. Returns how many came close.
  int attack(zoo::Zoo& zoo) {
    const std::vector<Listed> all = lists();
    int close = 0;
    for (std::int32_t i = 0; i < bodies_.count(); ++i) {
      close += attack_others(i, all[at(i)], zoo);
      attack_walls(i, all[at(i)]);
    }
    return close;
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

  // How far body i may fly straight on.
  double room(std::int32_t i) {
    const Flight flight = bodies_.flight[at(i)];
    bodies_.flight[at(i)].velocity = {1, 0, 0};
    bodies_.flight[at(i)].turn = 0.0;
    const double exit = near_.exit_time(i, now_);
    bodies_.flight[at(i)] = flight;
    return exit - now_;
  }

  int attack_others(std::int32_t i, const Listed& listed, zoo::Zoo& zoo) {
    int close = 0;
    for (std::int32_t j = 0; j <= i; ++j) {
      const double rooms = room(i) + room(j);
      const double reach = bodies_.size_at(now_) * (bodies_.reach[at(i)] + bodies_.reach[at(j)]) +
                           1.2 * rooms + bodies_.min_gap;
      const Vec3 r = bodies_.flight[at(j)].center - bodies_.flight[at(i)].center;
      movers::for_images_within(scene_.cell, r, reach, [&](const Image& m) {
        if (norm(r + image_shift(scene_.cell, m)) > reach) return;
        if (i == j && m <= Image{}) return;
        if (listed.count({j, m}) > 0) return;
        if (i == j && listed.count({j, {-m[0], -m[1], -m[2]}}) > 0) return;
        close += attack_pair(i, j, m, rooms, zoo);
      });
    }
    return close;
  }

  // The two as they stand now, sizes as at present.
  Scene pair_scene(std::int32_t i, std::int32_t j) const {
    Scene pair;
    pair.cell = scene_.cell;
    pair.size = bodies_.size_at(now_);
    pair.growth = bodies_.growth;
    pair.min_gap = bodies_.min_gap;
    for (const std::int32_t k : {i, j}) {
      pair.movers.push_back({turned_body(bodies_, k, scene_.movers[at(k)].body),
                             bodies_.flight[at(k)].center, bodies_.flight[at(k)].velocity,
                             bodies_.spin[at(k)].angular});
    }
    return pair;
  }

  // Sends both at each other along `normal`, as fast as brings both to the end of their rooms at
  // once; what they do then goes into `pair`, not into the bodies. Returns the first exit.
  double fly_together(std::int32_t i, std::int32_t j, const Vec3& normal, bool turn, Scene& pair) {
    double exits[2];
    double speed = 1.0;
    for (int round = 0; round < 2; ++round) {
      for (std::size_t side = 0; side < 2; ++side) {
        const std::int32_t k = side == 0 ? i : j;
        const Flight flight = bodies_.flight[at(k)];
        const Vec3 angular = bodies_.spin[at(k)].angular;
        bodies_.flight[at(k)].velocity = side == 0 ? normal : -speed * normal;
        if (!turn) bodies_.set_angular(at(k), {});
        exits[side] = near_.exit_time(k, now_);
        pair.movers[side].velocity = bodies_.flight[at(k)].velocity;
        pair.movers[side].angular = bodies_.spin[at(k)].angular;
        bodies_.flight[at(k)] = flight;
        bodies_.set_angular(at(k), angular);
      }
      speed = (exits[1] - now_) / (exits[0] - now_);
    }
    return std::min(exits[0], exits[1]);
  }

  bool attack_pair(std::int32_t i, std::int32_t j, const Image& m, double rooms, zoo::Zoo& zoo) {
    Scene pair = pair_scene(i, j);
    const Partner partner{i == j ? 0 : 1, image_shift(scene_.cell, m)};
    const Vec3 r = pair.movers[1].center + partner.shift - pair.movers[0].center;
    const Gap g = gap(movers::body_at(pair, 0, 0.0), movers::body_at(pair, 1, 0.0), r);
    // Whoever is far cannot come near.
    if (g.value > bodies_.min_gap + 1.2 * rooms) return false;
    const bool turn = zoo.uniform(0, 1) < 0.3;
    const double exit = fly_together(i, j, g.normal, turn, pair) - now_;
    double least = g.value;
    for (const double part : {0.5, 1.0}) {
      const movers::Clearance c = movers::clearance(pair, 0, partner, part * exit);
      CAPTURE(i, j, m[0], m[1], m[2], g.value, exit, c.value);
      // Rounding of places and of the gap.
      REQUIRE(c.value >= -1e-12 - c.error);
      least = std::min(least, c.value);
    }
    return least < 0.15 * g.value;
  }

  void attack_walls(std::int32_t i, const Listed& listed) {
    for (int axis = 0; axis < scene_.cell.dimension; ++axis) {
      if (scene_.cell.periodic[static_cast<std::size_t>(axis)]) continue;
      for (const bool high : {false, true}) {
        if (listed.count({wall(axis, high), {}}) > 0) continue;
        const Flight kept = bodies_.flight[at(i)];
        Vec3 toward;
        toward[static_cast<std::size_t>(axis)] = high ? 1.0 : -1.0;
        bodies_.flight[at(i)].velocity = toward;
        const double exit = near_.exit_time(i, now_) - now_;
        bodies_.flight[at(i)] = kept;
        Scene pair = pair_scene(i, i);
        pair.movers[0].velocity = toward;
        REQUIRE(movers::clearance(pair, 0, {wall(axis, high), {}}, exit).value >= -1e-12);
      }
    }
  }

  Scene scene_;
  Bodies bodies_;
  NearNeighbors near_;
  EventQueue queue_;
  double now_ = 0.0;
};

}  // namespace

TEST_CASE("whoever is in no list of a body cannot touch it before one leaves its neighborhood") {
  zoo::Zoo zoo(1);
  for (const Scattering& scattering : kScatterings) {
    CAPTURE(scattering.label);
    Flying flying(scattering, 21);
    const int close = flying.attack(zoo);
    // The attack is no better than those that it nearly brings together.
    if (scattering.count >= 50) CHECK(close > scattering.count / 10);
  }
}

TEST_CASE("lists miss nobody after many exits and new lists either") {
  zoo::Zoo zoo(2);
  for (const Scattering& scattering : kScatterings) {
    CAPTURE(scattering.label);
    Flying flying(scattering, 22);
    for (int round = 0; round < 2; ++round) {
      flying.fly(3 * scattering.count, zoo);
      flying.check_mutual();
      flying.attack(zoo);
    }
  }
}

TEST_CASE("bodies that keep a least gap have those in their lists that come within it") {
  zoo::Zoo zoo(3);
  for (const std::size_t k : {std::size_t{0}, std::size_t{3}, std::size_t{7}, std::size_t{9}}) {
    Scattering scattering = kScatterings[k];
    scattering.min_gap = 0.05;
    CAPTURE(scattering.label);
    Flying flying(scattering, 23);
    flying.attack(zoo);
    flying.fly(2 * scattering.count, zoo);
    flying.check_mutual();
    flying.attack(zoo);
  }
}

TEST_CASE("lists are mutual and name nobody twice") {
  for (const Scattering& scattering : kScatterings) {
    CAPTURE(scattering.label);
    Flying flying(scattering, 24);
    flying.check_mutual();
  }
}

TEST_CASE("lists are of the length that runs are fast with") {
  Flying flying({"balls", {}, 500, {sphere}, 0.07, 0.07}, 25);
  double sum = 0.0;
  for (const Listed& list : flying.lists()) sum += static_cast<double>(list.size());
  CHECK(sum / 500 > 6.0);
  CHECK(sum / 500 < 40.0);
}

}  // namespace packstone::event_driven
