#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"

using namespace packstone;

namespace {

using Hit = std::tuple<int, int, int, int>;

struct Boxed {
  Vec3 center;
  Vec3 half_extents;
};

struct Query {
  Vec3 center;
  Vec3 half_extents;
  double margin;
};

// Images that can matter along an axis: as many periods as both boxes and the margin span.
int image_reach(const Cell& cell, std::size_t axis, const Boxed& body, const Query& query) {
  if (!cell.periodic[axis]) return 0;
  const double span = body.half_extents[axis] + query.half_extents[axis] + query.margin +
                      std::abs(query.center[axis]) + cell.size[axis];
  return static_cast<int>(std::ceil(span / cell.size[axis]));
}

bool within(const Boxed& body, const Vec3& shift, const Query& query, double margin) {
  bool near = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double distance = std::abs(body.center[axis] + shift[axis] - query.center[axis]);
    near = near && distance <= body.half_extents[axis] + query.half_extents[axis] + margin;
  }
  return near;
}

std::vector<Hit> brute_force(const Cell& cell, const std::vector<Boxed>& bodies, const Query& query,
                             double margin) {
  std::vector<Hit> hits;
  for (std::size_t id = 0; id < bodies.size(); ++id) {
    const int nx = image_reach(cell, 0, bodies[id], query);
    const int ny = image_reach(cell, 1, bodies[id], query);
    const int nz = cell.dimension == 3 ? image_reach(cell, 2, bodies[id], query) : 0;
    for (int i = -nx; i <= nx; ++i) {
      for (int j = -ny; j <= ny; ++j) {
        for (int k = -nz; k <= nz; ++k) {
          if (within(bodies[id], image_shift(cell, {i, j, k}), query, margin)) {
            hits.emplace_back(static_cast<int>(id), i, j, k);
          }
        }
      }
    }
  }
  return hits;
}

std::vector<Hit> from_grid(const HierarchicalGrid& grid, const Query& query) {
  std::vector<Hit> hits;
  grid.query(query.center, query.half_extents, query.margin,
             [&](std::int32_t id, const HierarchicalGrid::Image& image) {
               hits.emplace_back(id, image[0], image[1], image[2]);
               return true;
             });
  std::sort(hits.begin(), hits.end());
  return hits;
}

struct Population {
  const char* name;
  double smallest;  // Of the half extents, drawn log-uniformly, one factor for all axes ...
  double largest;
  double elongation;  // ... times another one between 1 / elongation and 1 for each axis.
};

Cell random_cell(RandomStream& random) {
  Cell cell = random.uniform() < 0.3 ? cell_2d(1, 1) : Cell{};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    cell.size[axis] = random.uniform(0.5, 2.0);
    cell.periodic[axis] = random.uniform() < 0.7;
  }
  return cell;
}

Vec3 random_point(const Cell& cell, RandomStream& random) {
  const Vec3 u{random.uniform(), random.uniform(), random.uniform()};
  return scale(u, cell.size);
}

Boxed random_box(const Cell& cell, const Population& population, RandomStream& random) {
  Boxed box{random_point(cell, random), {}};
  const double size =
      population.smallest * std::pow(population.largest / population.smallest, random.uniform());
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    box.half_extents[axis] = size * std::pow(population.elongation, -random.uniform());
  }
  return box;
}

// The grid finds all that brute force finds, and nothing beyond the slack that it states.
void compare(const Cell& cell, const HierarchicalGrid& grid, const std::vector<Boxed>& bodies,
             const Query& query) {
  const auto found = from_grid(grid, query);
  REQUIRE(std::adjacent_find(found.begin(), found.end()) == found.end());
  const auto needed = brute_force(cell, bodies, query, query.margin);
  REQUIRE(std::includes(found.begin(), found.end(), needed.begin(), needed.end()));
  const double edge = std::max({cell.size.x, cell.size.y, cell.size.z});
  // Slack of 2^-22 edges; boxes spanning several edges are floats of that magnitude.
  const double slack = 0x1p-20 * edge * (1.0 + norm(query.half_extents) / edge);
  const auto allowed = brute_force(cell, bodies, query, query.margin + slack);
  REQUIRE(std::includes(allowed.begin(), allowed.end(), found.begin(), found.end()));
}

}  // namespace

TEST_CASE("the grid finds each image within the margin once, as brute force does") {
  const Population population = GENERATE(
      Population{"equal boxes", 0.05, 0.05, 1.0}, Population{"sizes 1 to 1000", 0.0005, 0.5, 1.0},
      Population{"needles", 0.3, 0.3, 100.0}, Population{"longer than the cell", 0.5, 4.0, 20.0});
  CAPTURE(population.name);
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    RandomStream random(11, StreamId::test, trial);
    const Cell cell = random_cell(random);
    const auto count = random.below(population.largest > 1.0 ? 12 : 150);
    std::vector<Boxed> bodies;
    HierarchicalGrid grid(cell);
    if (trial % 3 == 0) grid.reserve(static_cast<std::int64_t>(count));
    for (std::uint64_t id = 0; id < count; ++id) {
      bodies.push_back(random_box(cell, population, random));
      grid.insert(static_cast<std::int32_t>(id), bodies.back().center, bodies.back().half_extents);
    }
    REQUIRE(grid.size() == static_cast<std::int64_t>(count));
    for (int q = 0; q < 8; ++q) {
      const Boxed box = random_box(cell, population, random);
      const Vec3 away = q == 7 ? 3.0 * random_point(cell, random) - cell.size : box.center;
      compare(cell, grid, bodies, {away, box.half_extents, q % 2 == 0 ? 0.0 : 0.02});
    }
  }
}

TEST_CASE("one body alone meets its own images") {
  HierarchicalGrid grid(Cell{3, {1, 2, 1}, {true, true, false}});
  grid.insert(7, {0.5, 0.1, 0.5}, {1.2, 0.3, 0.4});
  // Boxes 2.4 long at a period of 1 meet two images on either side; 0.6 high at 2 meet none.
  const std::vector<Hit> expected{
      {7, -2, 0, 0}, {7, -1, 0, 0}, {7, 0, 0, 0}, {7, 1, 0, 0}, {7, 2, 0, 0}};
  CHECK(from_grid(grid, {{0.5, 0.1, 0.5}, {1.2, 0.3, 0.4}, 0.0}) == expected);
}

TEST_CASE("a center on the edge of the cell is found from either side") {
  for (const double x : {0.0, std::nextafter(1.0, 0.0)}) {
    HierarchicalGrid grid(Cell{});
    for (int id = 0; id < 1000; ++id) {
      grid.insert(id, {x, (id % 10 + 0.5) / 10.0, (id / 10 + 0.5) / 100.0}, {1e-3, 1e-3, 1e-3});
    }
    for (int id = 0; id < 1000; id += 37) {
      const Vec3 center{x, (id % 10 + 0.5) / 10.0, (id / 10 + 0.5) / 100.0};
      for (const double side : {-1.9e-3, 1.9e-3}) {
        const auto hits = from_grid(grid, {center + Vec3{side, 0, 0}, {1e-3, 1e-3, 1e-3}, 0.0});
        REQUIRE(hits.size() == 1);
        REQUIRE(std::get<0>(hits[0]) == id);
      }
    }
  }
}

TEST_CASE("a ball meets cores as brute force finds, except for a hair") {
  int met = 0, missed = 0, apart = 0;
  for (int round = 0; round < 60; ++round) {
    RandomStream random(11, StreamId::test, static_cast<std::uint64_t>(round));
    const Cell cell = random_cell(random);
    HierarchicalGrid grid(cell);
    struct Core {
      Vec3 center;
      double radius;
    };
    std::vector<Core> cores;
    for (int id = 0; id < 120; ++id) {
      const Vec3 center = random_point(cell, random);
      const double radius = 0.1 * std::pow(random.uniform(), 3.0);
      cores.push_back({center, radius});
      const Vec3 half_extents{1.5 * radius, 1.1 * radius, cell.dimension == 2 ? 0.0 : radius};
      grid.insert(id, center, half_extents, radius);
    }
    for (int k = 0; k < 300; ++k) {
      const Vec3 center = random_point(cell, random);
      const double radius = 0.1 * random.uniform();
      double gap = 10.0;  // Between the ball and the nearest core, of the nearest image.
      double allowed = 0.0;
      for (const Core& core : cores) {
        Vec3 d = core.center - center;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (cell.periodic[axis])
            d[axis] -= cell.size[axis] * std::round(d[axis] / cell.size[axis]);
        }
        gap = std::min(gap, norm(d) - core.radius - radius);
        allowed = std::max(allowed, 0.01 * core.radius + 0x1p-19);
      }
      const bool meets = grid.meets_core(center, radius);
      if (grid.meets_core_at_home(center, radius)) REQUIRE(meets);
      if (gap >= 0.0) REQUIRE_FALSE(meets);
      if (gap < -allowed) REQUIRE(meets);
      met += meets;
      missed += gap < 0.0 && !meets;
      apart += gap >= 0.0;
    }
  }
  CHECK(met > 1000);
  CHECK(apart > 1000);
  CHECK(missed < 100);
}

TEST_CASE("bodies without a core are met by no ball") {
  HierarchicalGrid grid{Cell{}};
  for (int id = 0; id < 100; ++id) grid.insert(id, {0.01 * id, 0.5, 0.5}, {0.1, 0.1, 0.1});
  CHECK_FALSE(grid.meets_core({0.505, 0.5, 0.501}, 1e-4));
  CHECK(grid.meets_core({0.505, 0.5, 0.5}, 0.01));  // It holds a center, with a core of radius 0.
}

TEST_CASE("a visit that returns false ends the query") {
  HierarchicalGrid grid(Cell{});
  for (int id = 0; id < 100; ++id) grid.insert(id, {0.01 * id, 0.5, 0.5}, {0.1, 0.1, 0.1});
  int visits = 0;
  const bool ended =
      grid.query({0.5, 0.5, 0.5}, {0.1, 0.1, 0.1}, 0.0,
                 [&](std::int32_t, const HierarchicalGrid::Image&) { return ++visits < 3; });
  CHECK_FALSE(ended);
  CHECK(visits == 3);
}

TEST_CASE("a cleared grid is empty and can be filled again") {
  HierarchicalGrid grid(Cell{});
  for (int id = 0; id < 100; ++id) grid.insert(id, {0.01 * id, 0.5, 0.5}, {0.01, 0.01, 0.01});
  grid.clear();
  CHECK(grid.size() == 0);
  CHECK(from_grid(grid, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, 0.0}).empty());
  grid.insert(3, {0.5, 0.5, 0.5}, {0.2, 0.2, 0.2});
  CHECK(from_grid(grid, {{0.4, 0.5, 0.5}, {0.01, 0.01, 0.01}, 0.0}) ==
        std::vector<Hit>{{3, 0, 0, 0}});
}
