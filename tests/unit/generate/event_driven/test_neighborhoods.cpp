#include "generate/event_driven/neighborhoods.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "movers.hpp"
#include "scattered.hpp"
#include "support/oracle.hpp"

namespace packstone::event_driven {
namespace {

using movers::Scattering;
using movers::Scene;

using enum ShapeKind;

const Scattering kScatterings[] = {
    {"balls", {}, 40, {sphere}, 0.05, 0.2},
    {"spheroids", {}, 40, {ellipsoid, sphere}, 0.1, 0.4, 3.0},
    {"lenses", {}, 40, {ellipsoid}, 0.1, 0.4, 0.1},
    {"needles", {}, 8, {ellipsoid}, 0.6, 0.8, 40.0, 0.1},
    {"all shapes", {}, 40, {sphere, ellipsoid, cylinder, spherocylinder}, 0.05, 0.5, 0.0, 0.2},
    {"the plane", cell_2d(1.0, 0.7), 40, {disk, ellipse}, 0.05, 0.2, 0.0, 0.1},
};

// Bodies, their neighborhoods and the scene that they came from.
struct Standing {
  Scene scene;
  Bodies bodies;
  Neighborhoods near;
  std::vector<Body> body;    // As they were when their neighborhoods were made,
  std::vector<Vec3> center;  // and where.

  Standing(const Scattering& s, std::uint64_t seed)
      : scene(scattered(s, seed)), bodies(bodies_of(scene)), near(bodies, s.cell) {
    zoo::Zoo zoo(seed + 1);
    for (std::int32_t i = 0; i < bodies.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double t = zoo.uniform(0, 0.3);
      bodies.advance(i, t);
      near.set(i, t, circum_radius(scene.movers[k].body) * zoo.log_uniform(0.01, 0.5));
      body.push_back(movers::body_at(scene, k, t));
      center.push_back(movers::center_at(scene.movers[k], t));
    }
  }
  // As the judge sees how far apart two stand.
  [[nodiscard]] Gap gap_to(std::int32_t i, std::int32_t j, const Vec3& shift) const {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    return gap(body[a], body[b], center[b] + shift - center[a]);
  }
};

Vec3 shift_of(const Cell& cell, const Neighbor& n) {
  return image_shift(cell, {n.image[0], n.image[1], n.image[2]});
}

bool inside(const Cell& cell, const Vec3& p) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (cell.periodic[a] && !(p[a] >= 0.0 && p[a] <= cell.size[a])) return false;
  }
  return true;
}

// All images of all others that stand within a few margins.
std::vector<Neighbor> all_near(const Standing& s, std::int32_t i) {
  std::vector<Neighbor> others;
  const auto a = static_cast<std::size_t>(i);
  for (std::int32_t j = 0; j < s.bodies.count(); ++j) {
    const auto b = static_cast<std::size_t>(j);
    const double reach = 1.2 * (circum_radius(s.body[a]) + circum_radius(s.body[b]));
    movers::for_images_within(s.scene.cell, s.center[b] - s.center[a], reach, [&](const auto& m) {
      if (i == j && m == std::array<int, 3>{}) return;
      Neighbor n;
      n.body = j;
      for (std::size_t k = 0; k < 3; ++k) n.image[k] = static_cast<std::int16_t>(m[k]);
      others.push_back(n);
    });
  }
  return others;
}

}  // namespace

TEST_CASE("the capsule and the ball of a neighborhood hold the body with its margin") {
  zoo::Zoo zoo(1);
  for (const Scattering& scattering : kScatterings) {
    CAPTURE(scattering.label);
    const Standing s(scattering, 11);
    for (std::int32_t i = 0; i < s.bodies.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Capsule c = s.near.capsule(i);
      CHECK(inside(s.scene.cell, c.center));
      for (int trial = 0; trial < 30; ++trial) {
        const Vec3 d = zoo.direction(s.scene.cell.dimension);
        const double held = static_cast<double>(oracle::support(s.body[k], d)) + s.near.margin(i);
        CHECK(c.half * std::abs(dot(d, c.axis)) + c.radius >= held * (1.0 - 1e-14));
        CHECK(s.near.reach(i) >= held * (1.0 - 1e-14));
      }
      // The center is an image of that of the body.
      const Vec3 off = s.center[k] - c.center;
      for (std::size_t a = 0; a < static_cast<std::size_t>(s.scene.cell.dimension); ++a) {
        const double periods = off[a] / s.scene.cell.size[a];
        CHECK(std::abs(periods - std::round(periods)) < 1e-14);
      }
    }
  }
}

TEST_CASE("an image among the places in the cell is named as it is among the centers") {
  for (const Scattering& scattering : kScatterings) {
    const Standing s(scattering, 12);
    const Cell& cell = s.scene.cell;
    for (std::int32_t i = 0; i < s.bodies.count(); ++i) {
      for (std::int32_t j = 0; j < s.bodies.count(); ++j) {
        const std::array<int, 3> image{1, -2, cell.dimension == 3 ? 3 : 0};
        const Neighbor n = s.near.neighbor(i, j, image);
        const Vec3 by_places =
            s.near.capsule(j).center + image_shift(cell, image) - s.near.capsule(i).center;
        const Vec3 by_centers = s.center[static_cast<std::size_t>(j)] + shift_of(cell, n) -
                                s.center[static_cast<std::size_t>(i)];
        CHECK(n.body == j);
        CHECK(norm(by_places - by_centers) < 1e-13);
      }
    }
  }
}

TEST_CASE("no neighborhood that meets another one is struck out, few of those that do not stay") {
  int struck = 0, kept = 0, apart = 0;
  for (const Scattering& scattering : kScatterings) {
    CAPTURE(scattering.label);
    for (std::uint64_t seed = 13; seed < 15; ++seed) {
      const Standing s(scattering, seed);
      for (std::int32_t i = 0; i < s.bodies.count(); i += 4) {
        const std::vector<Neighbor> others = all_near(s, i);
        std::vector<double> bounds(others.size());
        s.near.bound_gaps(i, others, bounds.data());
        std::vector<Neighbor> left = others;
        s.near.keep_near(i, left);
        for (std::size_t k = 0, at = 0; k < others.size(); ++k) {
          const Neighbor& n = others[k];
          const Gap truth = s.gap_to(i, n.body, shift_of(s.scene.cell, n));
          const double slack = truth.error + 1e-13 * s.near.reach(i);
          CAPTURE(i, n.body, truth.value, bounds[k]);
          REQUIRE(bounds[k] <= truth.value + slack);
          const bool stays = at < left.size() && left[at].body == n.body &&
                             std::equal(n.image, n.image + 3, left[at].image);
          at += stays;
          const double margins = s.near.margin(i) + s.near.margin(n.body);
          if (truth.value <= margins - slack) REQUIRE(stays);
          struck += !stays;
          kept += stays;
          apart += stays && truth.value > margins;
        }
      }
    }
  }
  CHECK(struck > kept / 2);
  CHECK(apart < kept / 3);
}

TEST_CASE("the gap to a wall is that of the body as it stands") {
  Scattering scattering = kScatterings[4];
  scattering.cell.periodic = {false, false, false};
  const Standing s(scattering, 14);
  for (std::int32_t i = 0; i < s.bodies.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double extent = half_extents(s.body[k])[a], at = s.center[k][a];
      CHECK(s.near.wall_gap(i, axis, false) == Approx(at - extent).margin(1e-13));
      CHECK(s.near.wall_gap(i, axis, true) ==
            Approx(s.scene.cell.size[a] - at - extent).margin(1e-13));
    }
  }
}

TEST_CASE("a body with room left is inside its neighborhood, up to its exit time at least") {
  zoo::Zoo zoo(2);
  int used_up = 0, exits = 0;
  for (const Scattering& scattering : kScatterings) {
    CAPTURE(scattering.label);
    for (std::uint64_t seed = 15; seed < 18; ++seed) {
      Standing s(scattering, seed);
      for (std::int32_t i = 0; i < s.bodies.count(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double margin = s.near.margin(i), start = s.bodies.flight[k].clock;
        CHECK(s.near.room_left(i, start) == Approx(margin));
        const double exit = s.near.exit_time(i, start);
        REQUIRE(exit > start);
        for (const double part : {0.3, 0.9, 1.0}) {
          Bodies& bodies = s.bodies;
          const double t = start + part * (exit - start);
          bodies.advance(i, t);
          // Rounding of times and places.
          CHECK(s.near.room_left(i, t) >= -1e-13);
          for (int trial = 0; trial < 20; ++trial) {
            const Vec3 d = zoo.direction(s.scene.cell.dimension);
            const Vec3 moved = movers::center_at(s.scene.movers[k], t) - s.center[k];
            const auto now = oracle::support(movers::body_at(s.scene, k, t), d);
            const auto then = oracle::support(s.body[k], d);
            CHECK(static_cast<double>(now - then) + dot(d, moved) <= margin + 1e-13);
          }
        }
        ++exits;
        const double turned = norm(s.scene.movers[k].angular) * (exit - start);
        // Where a body leaves before it has turned by the most it may, it has used its room.
        used_up += turned > 0.999 * kMostTurn || s.near.room_left(i, exit) < 0.2 * margin;
      }
    }
  }
  CHECK(used_up > 0.9 * exits);
}

TEST_CASE("a body that keeps flying is let on as its exit time is asked for again and again") {
  Standing s(kScatterings[1], 18);
  for (std::int32_t i = 0; i < s.bodies.count(); ++i) {
    double t = s.bodies.flight[static_cast<std::size_t>(i)].clock;
    for (int k = 0; k < 20; ++k) {
      const double exit = s.near.exit_time(i, t);
      REQUIRE(exit >= t);
      t = exit;
      s.bodies.advance(i, t);
      REQUIRE(s.near.room_left(i, t) >= -1e-13);
    }
  }
}

TEST_CASE("lists of neighbors stay mutual through many changes") {
  constexpr std::int32_t kBodies = 12;
  using Key = std::array<int, 4>;
  const auto key = [](const Neighbor& n) {
    return Key{n.body, n.image[0], n.image[1], n.image[2]};
  };
  std::vector<std::map<Key, int>> truth(kBodies);
  NeighborLists lists;
  lists.reset(kBodies);
  RandomStream random(3, StreamId::test);
  for (int round = 0; round < 3000; ++round) {
    const auto i = static_cast<std::int32_t>(random.below(kBodies));
    auto& own = truth[static_cast<std::size_t>(i)];
    if (random.below(4) == 0) {
      lists.remove(i);
      for (auto& list : truth) {
        std::erase_if(list, [i](const auto& entry) { return entry.first[0] == i; });
      }
      own.clear();
    } else {
      Neighbor n;
      n.body = static_cast<std::int32_t>(random.below(kBodies + 1)) - 1;  // -1: a wall.
      for (auto& m : n.image) m = static_cast<std::int16_t>(random.below(5)) - 2;
      if (own.count(key(n)) > 0 || (n.body == i && own.count(key(reversed(n, i))) > 0)) continue;
      lists.add(i, n);
      ++own[key(n)];
      if (n.body >= 0 && n.body != i) {
        ++truth[static_cast<std::size_t>(n.body)][key(reversed(n, i))];
      }
    }
    for (std::int32_t b = 0; b < kBodies; ++b) {
      std::map<Key, int> listed;
      for (const Neighbor& n : lists.of(b)) ++listed[key(n)];
      REQUIRE(listed == truth[static_cast<std::size_t>(b)]);
      REQUIRE(lists.size(b) == static_cast<std::int32_t>(listed.size()));
    }
  }
}

}  // namespace packstone::event_driven
