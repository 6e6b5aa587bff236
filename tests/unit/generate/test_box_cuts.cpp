// Half-spaces of what is free of a box: they lose no free point, and what they prove is so.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "generate/rsa/box_cuts.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {
namespace {

using rsa::BoxCuts;
using rsa::Cut;

Vec3 random_in_cube(RandomStream& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

Body random_rod_or_ball(RandomStream& random) {
  const double radius = random.uniform(0.1, 0.5), half_length = random.uniform(0.1, 1.0);
  const Vec3 axis = random_direction(random);
  switch (random.below(3)) {
    case 0:
      return Sphere{radius};
    case 1:
      return Cylinder{radius, half_length, axis};
    default:
      return Spherocylinder{radius, half_length, axis};
  }
}

// The range of the convex set that cut_by() looks at.
double range_of(const rsa::Outline& body, double ball) {
  return ball + (body.ends == rsa::Outline::Ends::flat ? 0.0 : body.radius);
}

// The slow oracle: the most, over the box, of the least surplus of any half-space. By all vertices
// of the linear program in (x, surplus): every four of the planes, faces of the box among them.
double largest_surplus(const std::vector<Cut>& cuts, const Vec3& half) {
  struct Row {
    Vec3 normal;
    double weight, least;  // dot(normal, x) - weight * surplus >= least.
  };
  std::vector<Row> rows;
  for (const Cut& cut : cuts) rows.push_back({cut.away, 1.0, cut.least});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 normal{0, 0, 0};
      normal[axis] = side;
      rows.push_back({normal, 0.0, -half[axis]});
    }
  }
  double best = -1e300;
  const std::size_t n = rows.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        for (std::size_t d = c + 1; d < n; ++d) {
          // Gauss with pivoting for (x, surplus).
          double m[4][5];
          const Row* of[4] = {&rows[a], &rows[b], &rows[c], &rows[d]};
          for (int i = 0; i < 4; ++i) {
            const Row& row = *of[i];
            const double line[5] = {row.normal.x, row.normal.y, row.normal.z, -row.weight,
                                    row.least};
            std::copy(line, line + 5, m[i]);
          }
          bool regular = true;
          for (int k = 0; k < 4 && regular; ++k) {
            int pivot = k;
            for (int i = k + 1; i < 4; ++i) {
              if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
            }
            regular = std::abs(m[pivot][k]) > 1e-12;
            if (!regular) break;
            std::swap_ranges(m[k], m[k] + 5, m[pivot]);
            for (int i = 0; i < 4; ++i) {
              if (i == k) continue;
              const double factor = m[i][k] / m[k][k];
              for (int j = k; j < 5; ++j) m[i][j] -= factor * m[k][j];
            }
          }
          if (!regular) continue;
          const Vec3 x{m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2]};
          const double surplus = m[3][4] / m[3][3];
          const bool feasible = std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
            return dot(row.normal, x) - row.weight * surplus >= row.least - 1e-9;
          });
          if (feasible) best = std::max(best, surplus);
        }
      }
    }
  }
  return best;
}

}  // namespace

TEST_CASE("a cut loses no point to which the body keeps its distance") {
  RandomStream random(1, StreamId::test);
  int free = 0, close = 0;
  for (int k = 0; k < 4000; ++k) {
    const Body body = random_rod_or_ball(random);
    const rsa::Outline outline = rsa::outline_of(body);
    const Vec3 p = random_in_cube(random, 1.5);
    const double ball = random.uniform(0.1, 0.5), half = std::pow(10.0, random.uniform(-4.0, -0.5));
    const Cut cut = rsa::cut_by(outline, p, range_of(outline, ball), 3.0 * half * half);
    for (int i = 0; i < 50; ++i) {
      const Vec3 x = random_in_cube(random, half);
      if (overlap(Sphere{ball}, body, -(p + x), 0.0) != Verdict::separated) continue;
      ++free;
      const double surplus = dot(cut.away, x) - cut.least;
      REQUIRE(surplus >= 0.0);
      if (surplus < 6.0 * half * half) ++close;
    }
  }
  CHECK(free > 50000);
  CHECK(close > 100);
}

TEST_CASE("a cut of a ball is sharp at the corners of the box") {
  const rsa::Outline ball = rsa::outline_of(Sphere{0.3});
  const Vec3 p{0.3, 0.4, 0.5}, corner{0.1, 0.1, 0.1};
  const double distance = norm(p + corner);
  for (const double factor : {1.0 - 1e-9, 1.0 + 1e-9}) {
    const Cut cut = rsa::cut_by(ball, p, factor * distance, norm_sq(corner));
    CHECK((dot(cut.away, corner) >= cut.least) == (factor < 1.0));
  }
}

TEST_CASE("how a body meets a box holds for all its points") {
  RandomStream random(3, StreamId::test);
  std::array<int, 4> seen{0, 0, 0, 0};
  for (int k = 0; k < 4000; ++k) {
    const Body body = random_rod_or_ball(random);
    const rsa::Outline outline = rsa::outline_of(body);
    const Vec3 p = random_in_cube(random, 1.5);
    const double ball = random.uniform(0.1, 0.5), half = std::pow(10.0, random.uniform(-2.0, -0.2));
    BoxCuts box({half, half, half});
    const auto meeting = box.look_at(outline, p, range_of(outline, ball));
    ++seen[static_cast<std::size_t>(meeting)];
    CAPTURE(k, static_cast<int>(meeting));
    const auto overlaps = [&](const Vec3& x) {
      return overlap(Sphere{ball}, body, -(p + x), 0.0) == Verdict::overlapping;
    };
    const bool at_middle =
        meeting == BoxCuts::Meeting::covers || meeting == BoxCuts::Meeting::middle;
    REQUIRE(overlaps({0, 0, 0}) == at_middle);
    for (int i = 0; i < 20; ++i) {
      const Vec3 x = random_in_cube(random, half);
      if (meeting == BoxCuts::Meeting::covers) REQUIRE(overlaps(x));
      if (meeting == BoxCuts::Meeting::nowhere) REQUIRE_FALSE(overlaps(x));
    }
  }
  for (const int times : seen) CHECK(times > 100);
}

TEST_CASE("half-spaces are proven to leave nothing of a box where, and only where, they do") {
  RandomStream random(2, StreamId::test);
  int empty = 0, by_several = 0;
  for (int k = 0; k < 3000; ++k) {
    const bool flat = random.below(4) == 0;
    const Vec3 half{random.uniform(0.5, 2.0), random.uniform(0.5, 2.0),
                    flat ? 0.0 : random.uniform(0.5, 2.0)};
    BoxCuts box(half);
    std::vector<Cut> cuts;
    bool by_one = false;
    const auto count = 1 + random.below(6);
    for (std::uint64_t i = 0; i < count; ++i) {
      Cut cut{random_direction(random), 0.0, 0.0};
      if (flat) cut.away.z = 0.0;
      cut.least = random.uniform(-1.0, 1.0) * box.reach(cut);
      if (random.below(8) == 0) cut.least = 1.1 * box.reach(cut);
      by_one |= cut.least > box.reach(cut);
      cuts.push_back(cut);
      box.add(cut);
    }
    const double surplus = largest_surplus(cuts, half);
    // Around zero the oracle's rounding and the margin of the proof decide.
    if (std::abs(surplus) < 1e-6) continue;
    CAPTURE(k, count, surplus);
    REQUIRE(box.leave_nothing() == (surplus < 0.0));
    empty += surplus < 0.0;
    by_several += surplus < 0.0 && !by_one;
  }
  CHECK(empty > 300);
  CHECK(by_several > 100);
}

TEST_CASE("half-spaces beyond those that count prove nothing, and nothing wrong") {
  BoxCuts box({1, 1, 1});
  for (int k = 0; k < 100; ++k) box.add({{1, 0, 0}, 1.0, -0.5});
  CHECK_FALSE(box.leave_nothing());
  box.add({{1, 0, 0}, 1.0, 2.0});
  CHECK_FALSE(box.leave_nothing());
}

}  // namespace packstone
