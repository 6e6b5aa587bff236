#include "spatial/capsule_grid.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {
namespace {

using Image = CapsuleGrid::Image;
using Found = std::map<std::pair<std::int32_t, Image>, int>;  // How often.

Body body_of(const Capsule& c) {
  if (c.half == 0.0) return Sphere{c.radius};
  return Spherocylinder{c.radius, c.half, c.axis};
}

// How the capsules of a case are drawn.
struct Kind {
  const char* label;
  Cell cell;
  int count;
  double smallest, largest;  // Reach.
  double slender;            // Least radius over reach.
  bool parallel = false;
};

Capsule random_capsule(const Kind& kind, RandomStream& random) {
  Capsule c;
  const double reach = kind.smallest * std::pow(kind.largest / kind.smallest, random.uniform());
  c.radius = reach * (kind.slender < 1.0 ? random.uniform(kind.slender, 1.0) : 1.0);
  c.half = reach - c.radius;
  c.axis = random_direction(random);
  if (kind.cell.dimension == 2) c.axis = normalized(Vec3{c.axis.x, c.axis.y, 0.0});
  if (kind.parallel) c.axis = normalized(Vec3{1, 2, 3} + 1e-4 * random_direction(random));
  for (std::size_t a = 0; a < static_cast<std::size_t>(kind.cell.dimension); ++a) {
    c.center[a] = kind.cell.size[a] * random.uniform();
  }
  return c;
}

// The grid and all that is in it.
class Filled {
 public:
  explicit Filled(const Kind& kind) : kind_(kind), random_(7, StreamId::test), grid_(kind.cell) {
    for (int k = 0; k < kind.count; ++k) capsules_.push_back(random_capsule(kind, random_));
    grid_.reset(capsules_);
    for (std::int32_t i = 0; i < kind.count; ++i) grid_.insert(i, capsules_[at(i)]);
    inside_.assign(capsules_.size(), true);
  }

  // Takes some out and puts others in, elsewhere, turned and larger or smaller by up to a half.
  void shuffle(int times) {
    for (int k = 0; k < times; ++k) {
      const auto i = static_cast<std::int32_t>(random_.below(capsules_.size()));
      if (inside_[at(i)]) grid_.remove(i);
      inside_[at(i)] = random_.below(8) != 0;
      if (!inside_[at(i)]) continue;
      const double factor = random_.uniform(0.6, 1.5);
      Capsule fresh = random_capsule(kind_, random_);
      fresh.half = factor * capsules_[at(i)].half;
      fresh.radius = factor * capsules_[at(i)].radius;
      capsules_[at(i)] = fresh;
      grid_.insert(i, fresh);
    }
  }

  [[nodiscard]] Found query(const Capsule& c) {
    Found found;
    grid_.query(c, scratch_, [&](std::int32_t i, const Image& image) {
      ++found[{i, image}];
      return true;
    });
    return found;
  }

  // Checks a query against all images of all capsules; returns how many met.
  int check(const Capsule& asked) {
    const Found found = query(asked);
    for (const auto& [which, times] : found) REQUIRE(times == 1);
    int met = 0;
    for (std::int32_t i = 0; i < kind_.count; ++i) met += check_images(asked, i, found);
    return met;
  }
  int check_some(int queries) {
    int met = 0;
    for (int k = 0; k < queries; ++k) met += check(random_capsule(kind_, random_));
    return met;
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

  int check_images(const Capsule& asked, std::int32_t i, const Found& found) const {
    const Capsule& c = capsules_[at(i)];
    const Cell& cell = kind_.cell;
    const double reach = asked.reach() + c.reach();
    std::array<int, 3> range{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
      if (cell.periodic[a]) range[a] = 1 + static_cast<int>(std::ceil(reach / cell.size[a]));
    }
    int met = 0, seen = 0;
    for (int x = -range[0]; x <= range[0]; ++x) {
      for (int y = -range[1]; y <= range[1]; ++y) {
        for (int z = -range[2]; z <= range[2]; ++z) {
          const Image image{x, y, z};
          const Vec3 r = c.center + image_shift(cell, image) - asked.center;
          const bool there = found.count({i, image}) > 0;
          seen += there;
          if (!inside_[at(i)]) {
            REQUIRE_FALSE(there);
          } else if (norm(r) < 1.01 * reach || there) {
            met += judge(asked, c, r, there);
          }
        }
      }
    }
    REQUIRE(seen == std::count_if(found.begin(), found.end(),
                                  [i](const auto& f) { return f.first.first == i; }));
    return met;
  }

  bool judge(const Capsule& asked, const Capsule& c, const Vec3& r, bool there) const {
    const double longest = std::max({kind_.cell.size.x, kind_.cell.size.y, kind_.cell.size.z});
    const Gap between = gap(body_of(asked), body_of(c), r);
    CAPTURE(between.value, norm(r), asked.half, c.half);
    if (between.value <= 0.0) REQUIRE(there);
    // Parallel ones are not resolved as well in floats.
    if (!kind_.parallel && between.value > 0x1p-18 * longest) REQUIRE_FALSE(there);
    return between.value <= 0.0;
  }

  Kind kind_;
  RandomStream random_;
  CapsuleGrid grid_;
  CapsuleGrid::Scratch scratch_;
  std::vector<Capsule> capsules_;
  std::vector<bool> inside_;
};

const Kind kKinds[] = {
    {"equal balls", {}, 200, 0.08, 0.08, 1.0},
    {"balls of sizes 1 to 1000", {}, 400, 3e-4, 0.3, 1.0},
    {"rods", {3, {1, 0.7, 1.4}, {true, true, true}}, 150, 0.1, 0.3, 0.05},
    {"needles", {}, 1500, 0.2, 0.3, 0.02},
    {"needles and balls", {}, 400, 0.02, 0.4, 0.02},
    {"needles longer than the cell", {}, 12, 0.8, 1.4, 0.01},
    {"parallel needles", {}, 60, 0.4, 0.6, 0.01, true},
    {"a few", {}, 3, 0.2, 0.4, 0.3},
    {"between walls", {3, {1, 2, 1}, {true, false, false}}, 150, 0.05, 0.3, 0.1},
    {"needles between walls", {3, {1, 2, 1}, {true, false, false}}, 600, 0.2, 0.3, 0.02},
    {"needles in the plane", cell_2d(1.0, 0.6), 400, 0.1, 0.2, 0.02},
    {"in the plane", cell_2d(1.0, 0.6), 150, 0.01, 0.2, 0.1},
    {"in the plane between walls", cell_2d(1.0, 0.6, false, true), 150, 0.01, 0.2, 0.1},
    {"a flat cell", {3, {4, 4, 0.1}, {true, true, true}}, 100, 0.05, 0.3, 0.1},
};

}  // namespace

TEST_CASE("the grid finds every capsule and image that meets another one, and each once") {
  for (const Kind& kind : kKinds) {
    CAPTURE(kind.label);
    Filled filled(kind);
    CHECK(filled.check_some(15) > 10);
  }
}

TEST_CASE("the grid forgets nobody however often capsules leave, enter, grow and shrink") {
  for (const Kind& kind : kKinds) {
    CAPTURE(kind.label);
    Filled filled(kind);
    for (int round = 0; round < 3; ++round) {
      filled.shuffle(5 * kind.count);
      filled.check_some(4);
    }
  }
}

TEST_CASE("the grid finds those of one crowded place, and none when it is empty") {
  const Cell cell{};
  CapsuleGrid grid(cell);
  constexpr std::int32_t kCrowd = 100;
  const Capsule spot{{0.5, 0.5, 0.5}, {0, 0, 1}, 0.0, 0.01};
  grid.reset(std::vector<Capsule>(kCrowd, spot));
  const auto found = [&] {
    std::set<std::int32_t> bodies;
    CapsuleGrid::Scratch scratch;
    grid.query(spot, scratch, [&](std::int32_t i, const Image&) {
      bodies.insert(i);
      return true;
    });
    return bodies.size();
  };
  CHECK(found() == 0);
  for (std::int32_t i = 0; i < kCrowd; ++i) grid.insert(i, spot);
  CHECK(found() == kCrowd);
  for (std::int32_t i = 0; i < kCrowd; i += 2) grid.remove(i);
  CHECK(found() == kCrowd / 2);
  for (std::int32_t i = 1; i < kCrowd; i += 2) grid.remove(i);
  CHECK(found() == 0);
}

TEST_CASE("a query leaves out lower numbers, and pieces of one body come one by one") {
  CapsuleGrid grid(Cell{});
  const Capsule rod{{0.5, 0.5, 0.5}, {0, 0, 1}, 0.4, 0.01};
  const std::vector<Capsule> rods(400, rod);
  grid.reset(rods);
  for (std::size_t k = 0; k < rods.size(); ++k) grid.insert(static_cast<std::int32_t>(k), rod);
  grid.remove(399);
  CapsuleGrid::Scratch scratch;
  std::multiset<std::int32_t> found, pieces;
  const auto note_in = [](auto& numbers) {
    return [&numbers](std::int32_t i, const Image&) {
      numbers.insert(i);
      return true;
    };
  };
  CHECK(grid.query(rod, scratch, note_in(found), 392));
  CHECK(found == std::multiset<std::int32_t>{392, 393, 394, 395, 396, 397, 398});
  CHECK(grid.query_pieces(rod, note_in(pieces)));
  CHECK(pieces.size() > 399);
  CHECK(std::set<std::int32_t>(pieces.begin(), pieces.end()).size() == 399);
  int visits = 0;
  const auto stop = [&](std::int32_t, const Image&) { return ++visits < 3; };
  CHECK_FALSE(grid.query(rod, scratch, stop));
  CHECK_FALSE(grid.query_pieces(rod, stop));
  CHECK(visits == 4);
}

TEST_CASE("the grid finds capsules on the faces and corners of the cell") {
  const Cell cell{};
  CapsuleGrid grid(cell);
  const double last = std::nextafter(1.0, 0.0);
  const std::vector<Vec3> places{{0, 0, 0}, {last, 0, 0}, {0, last, 0.5}, {last, last, last}};
  std::vector<Capsule> capsules;
  for (const Vec3& place : places) capsules.push_back({place, {0, 0, 1}, 0.0, 0.05});
  grid.reset(capsules);
  for (std::size_t k = 0; k < places.size(); ++k) {
    grid.insert(static_cast<std::int32_t>(k), capsules[k]);
  }
  std::set<std::pair<std::int32_t, Image>> found;
  CapsuleGrid::Scratch scratch;
  grid.query({{last, 0, 0}, {0, 0, 1}, 0.0, 0.01}, scratch,
             [&](std::int32_t i, const Image& image) {
               found.insert({i, image});
               return true;
             });
  CHECK(found ==
        std::set<std::pair<std::int32_t, Image>>{{0, {1, 0, 0}}, {1, {0, 0, 0}}, {3, {0, -1, -1}}});
}

TEST_CASE("all widths of registers find the same capsules") {
  std::vector<CapsuleHits> widths{kCapsulesByTwo};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") != 0) widths.push_back(kCapsulesByFour);
  if (__builtin_cpu_supports("avx512f") != 0) widths.push_back(kCapsulesByEight);
#endif
  RandomStream random(7, StreamId::test);
  const auto number = [&](double lo, double hi) {
    return static_cast<float>(random.uniform(lo, hi));
  };
  int met = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    CapsuleChunk chunk;
    for (std::size_t l = 0; l < CapsuleChunk::kLanes; ++l) {
      const Vec3 axis = random_direction(random);
      chunk.x[l] = number(-2, 2), chunk.y[l] = number(-2, 2), chunk.z[l] = number(-2, 2);
      chunk.axis_x[l] = static_cast<float>(axis.x), chunk.axis_y[l] = static_cast<float>(axis.y),
      chunk.axis_z[l] = static_cast<float>(axis.z);
      chunk.half[l] = number(0, 1), chunk.radius[l] = number(0, 0.5);
    }
    chunk.count = static_cast<std::int32_t>(1 + random.below(CapsuleChunk::kLanes));
    const SeenCapsule seen{0, 0, 0, 0, 0, 1, number(0, 1), number(0, 0.5)};
    const unsigned hits = widths.front()(chunk, seen);
    met += hits != 0;
    for (const CapsuleHits width : widths) REQUIRE(width(chunk, seen) == hits);
  }
  CHECK(met > 1000);
}

}  // namespace packstone
