// The proofs inside random sequential adsorption: outlines, orientation cells, common cores.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "generate/rsa/outline.hpp"
#include "generate/rsa/pose.hpp"
#include "generate/rsa/trial_numbers.hpp"
#include "generate/rsa/vacancy_list.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone {
namespace {

using rsa::Candidate;
using rsa::CommonCore;
using rsa::OrientationCells;
using rsa::Turning;

// Any 3D body with aspect ratios from 0.1 to 10.
Body random_body(RandomStream& random) {
  const double a = std::pow(10.0, random.uniform(-0.5, 0.5));
  const double b = std::pow(10.0, random.uniform(-0.5, 0.5));
  const double c = std::pow(10.0, random.uniform(-0.5, 0.5));
  const Quaternion q = random_rotation(random);
  switch (random.below(4)) {
    case 0:
      return Sphere{a};
    case 1:
      return Ellipsoid{{a, b, c}, q};
    case 2:
      return Cylinder{a, b, rotate(q, {0, 0, 1})};
    default:
      return Spherocylinder{a, b, rotate(q, {0, 0, 1})};
  }
}

Vec3 axis_of(const Body& body) {
  if (const auto* cylinder = std::get_if<Cylinder>(&body)) return cylinder->axis;
  return std::get<Spherocylinder>(body).axis;
}

bool leaves_room_for(const rsa::PlacedBodies& placed, const Candidate& candidate,
                     const Vec3& center, std::int64_t& cost) {
  rsa::PlacedBodies::View view;
  return placed.look_around(candidate.outline, center, view, cost) &&
         placed.leaves_room_for(candidate, center, view, cost);
}

double angle_between_lines(const Vec3& u, const Vec3& v) {
  return std::atan2(norm(cross(u, v)), std::abs(dot(u, v)));
}

}  // namespace

TEST_CASE("verdicts of outlines are those of the exact kernel, for all pairs of shapes") {
  int settled = 0;
  constexpr int pairs = 40'000;
  for (int k = 0; k < pairs; ++k) {
    RandomStream random(1, StreamId::test, static_cast<std::uint64_t>(k));
    const Body a = random_body(random), b = random_body(random);
    const auto outline_a = rsa::outline_of(a), outline_b = rsa::outline_of(b);
    const double reach = outline_a.circum_radius + outline_b.circum_radius;
    const Vec3 r = random.uniform(0.0, 1.05) * reach * random_direction(random);
    const double min_gap = k % 3 == 0 ? 0.1 * reach * random.uniform() : 0.0;
    const Verdict exact = overlap(a, b, r, min_gap);
    const Verdict quick = rsa::quick_verdict(outline_a, outline_b, r, min_gap);
    const rsa::Glance seen = rsa::glance(outline_a, outline_b, r, min_gap);
    CAPTURE(k, name(kind(a)), name(kind(b)), min_gap);
    if (quick != Verdict::undecided) REQUIRE(quick == exact);
    if (seen.verdict != Verdict::undecided) REQUIRE(seen.verdict == exact);
    if (exact == Verdict::overlapping) REQUIRE(seen.gap_bound <= min_gap);
    settled += quick != Verdict::undecided;
  }
  // That is what outlines are for.
  CHECK(settled > 0.7 * pairs);
}

TEST_CASE("verdicts of outlines hold for nearly parallel and end to end bodies") {
  for (int k = 0; k < 40'000; ++k) {
    RandomStream random(2, StreamId::test, static_cast<std::uint64_t>(k));
    const Vec3 u = random_direction(random);
    const double tilt = std::pow(10.0, random.uniform(-12.0, -1.0));
    const Vec3 v = normalized(u + tilt * random_direction(random));
    const bool flat = k % 2 == 0;
    const Body a = flat ? Body{Cylinder{1.0, 3.0, u}} : Body{Spherocylinder{1.0, 3.0, u}};
    const Body b = k % 4 < 2 ? Body{Cylinder{0.5, 5.0, v}} : Body{Spherocylinder{0.5, 5.0, v}};
    const double along = k % 5 == 0 ? random.uniform(7.9, 8.1) : random.uniform(0.0, 9.0);
    const Vec3 r = along * u + random.uniform(0.0, 1.6) * any_perpendicular(u);
    const Verdict exact = overlap(a, b, r);
    const Verdict quick = rsa::quick_verdict(rsa::outline_of(a), rsa::outline_of(b), r, 0.0);
    CAPTURE(k, along, tilt);
    if (quick != Verdict::undecided && exact != Verdict::undecided) REQUIRE(quick == exact);
  }
}

TEST_CASE("meets_ball agrees with the exact kernel") {
  for (int k = 0; k < 20'000; ++k) {
    RandomStream random(3, StreamId::test, static_cast<std::uint64_t>(k));
    const Body body = random_body(random);
    const double radius = random.uniform(0.01, 1.0);
    const auto outline = rsa::outline_of(body);
    const Vec3 x =
        random.uniform(0.0, 1.05) * (outline.circum_radius + radius) * random_direction(random);
    const bool meets = rsa::meets_ball(outline, x, radius, 0.0);
    const Verdict exact = overlap(body, Sphere{radius}, x);
    CAPTURE(k, name(kind(body)));
    if (meets) REQUIRE(exact == Verdict::overlapping);
    if (exact == Verdict::overlapping && outline.ends != rsa::Outline::Ends::loose) REQUIRE(meets);
  }
}

TEST_CASE("orientation cells have equal measure and members within the angle stated") {
  OrientationCells cells(Turning::of_axis);
  const Body body = Cylinder{1.0, 2.0, {0, 0, 1}};
  for (int level = 0; level < 5; ++level) {
    const std::int32_t count = cells.count();
    CHECK(count == 6 << (2 * level));
    // Uniform points of all cells are uniform on the half sphere: second moments are 1/3.
    SymMat3 moments;
    constexpr int samples = 60'000;
    for (int k = 0; k < samples; ++k) {
      RandomStream random(4, StreamId::test, static_cast<std::uint64_t>(k));
      const auto cell = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(count)));
      const double u = random.uniform(), v = random.uniform();
      const Vec3 axis = axis_of(cells.turned(body, cell, u, v));
      const Vec3 middle = axis_of(cells.turned(body, cell, 0.5, 0.5));
      REQUIRE(angle_between_lines(axis, middle) <= cells.angle(cell));
      REQUIRE(cells.angle(cell) <= cells.widest());
      moments = moments + (1.0 / samples) * dyad(axis);
    }
    // Standard error of u_x^2 is 0.298 / sqrt(samples) = 0.0012.
    CHECK(moments.xx == Approx(1.0 / 3).margin(0.006));
    CHECK(moments.yy == Approx(1.0 / 3).margin(0.006));
    CHECK(moments.zz == Approx(1.0 / 3).margin(0.006));
    CHECK(std::abs(moments.xy) + std::abs(moments.xz) + std::abs(moments.yz) < 0.012);
    cells.split();
  }
}

TEST_CASE("children of an orientation cell share its orientations") {
  OrientationCells coarse(Turning::of_axis), fine(Turning::of_axis);
  fine.split();
  const Body body = Cylinder{1.0, 2.0, {0, 0, 1}};
  for (int level = 0; level < 3; ++level) {
    for (std::int32_t cell = 0; cell < coarse.count(); ++cell) {
      const Vec3 middle = axis_of(coarse.turned(body, cell, 0.5, 0.5));
      for (std::int32_t child = 0; child < 4; ++child) {
        const Body turned = fine.turned(body, fine.first_child(cell) + child, 0.5, 0.5);
        REQUIRE(angle_between_lines(axis_of(turned), middle) < coarse.angle(cell));
      }
    }
    coarse.split();
    fine.split();
  }
}

TEST_CASE("every member of an orientation cell contains the parts of the common core") {
  for (int k = 0; k < 3000; ++k) {
    RandomStream random(5, StreamId::test, static_cast<std::uint64_t>(k));
    const double a = std::pow(10.0, random.uniform(-0.7, 0.7));
    const Vec3 axis = random_direction(random);
    const Body bodies[] = {Cylinder{1.0, a, axis}, Spherocylinder{1.0, a, axis},
                           Ellipsoid{{1.0, 1.0, a}, from_z_to(axis)}};
    const Body& middle = bodies[k % 3];
    const double angle = std::pow(10.0, random.uniform(-2.0, 0.2));
    const CommonCore core = rsa::common_core(middle, angle);
    REQUIRE(core.part_count > 0);
    const Vec3 pivot = normalized(cross(axis, random_direction(random)));
    const Body member =
        rotated(middle, from_axis_angle(pivot, random.uniform(0.0, std::min(angle, 1.57))));
    for (int part = 0; part < core.part_count; ++part) {
      for (int d = 0; d < 30; ++d) {
        const Vec3 direction = random_direction(random);
        const Body& inner = core.parts[static_cast<std::size_t>(part)];
        CAPTURE(k, part, a, angle);
        // Containment of convex bodies: S_inner <= S_member in every direction.
        REQUIRE(support(inner, direction) <= support(member, direction));
      }
    }
  }
}

TEST_CASE("an ellipse that turns in its plane keeps its common core") {
  for (int k = 0; k < 3000; ++k) {
    RandomStream random(6, StreamId::test, static_cast<std::uint64_t>(k));
    const double angle = random.uniform(0.0, 1.5), turn = random.uniform(-angle, angle);
    const Ellipse middle{{random.uniform(0.2, 1.0), 0.5}, random.uniform(0.0, 3.0)};
    const CommonCore core = rsa::common_core(middle, angle);
    const Ellipse member{middle.semi_axes, middle.angle + turn};
    const double phi = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec3 d{std::cos(phi), std::sin(phi), 0.0};
    REQUIRE(support(core.parts[0], d) <= support(member, d));
  }
}

TEST_CASE("numbers of trials are uniform, within a trial, from trial to trial, from body to body") {
  // Pairs of neighboring words in 16 x 16 boxes: chi-square with 255 degrees of freedom has mean
  // 255 and standard deviation 22.6; bounds are five of these away.
  constexpr int pairs = 1 << 18;
  const auto chi_square = [](const auto& pair_of) {
    std::vector<int> counts(256, 0);
    for (int k = 0; k < pairs; ++k) {
      const auto [a, b] = pair_of(k);
      ++counts[static_cast<std::size_t>(16.0 * a) * 16 + static_cast<std::size_t>(16.0 * b)];
    }
    double sum = 0.0;
    for (const int count : counts) sum += std::pow(count - pairs / 256.0, 2) / (pairs / 256.0);
    return sum;
  };
  const rsa::TrialNumbers numbers(3, StreamId::test, 4);
  const double within = chi_square([&](int k) {
    auto row = numbers.trial(k);
    const double a = row.uniform();
    return std::pair{a, row.uniform()};
  });
  const double between_trials = chi_square([&](int k) {
    return std::pair{numbers.trial(k).uniform(), numbers.trial(k + 1).uniform()};
  });
  const double between_bodies = chi_square([&](int k) {
    const auto item = static_cast<std::uint64_t>(k);
    return std::pair{rsa::TrialNumbers(3, StreamId::test, item).trial(5).uniform(),
                     rsa::TrialNumbers(3, StreamId::test, item + 1).trial(5).uniform()};
  });
  for (const double sum : {within, between_trials, between_bodies}) {
    CHECK(sum > 142.0);
    CHECK(sum < 368.0);
  }
  std::vector<int> thirds(3, 0);
  for (int k = 0; k < 30'000; ++k) ++thirds[numbers.trial(k).below(3)];
  for (const int third : thirds) CHECK(std::abs(third - 10'000) < 410);  // Five deviations.
}

TEST_CASE("a list of vacancies never loses a pose that fits") {
  // Every pose found to fit by plain attempts must lie in a cell of the list: the part of the poses
  // that fit, estimated from the list, agrees with that from plain attempts.
  for (const bool redraw : {false, true}) {
    rsa::PlacedBodies placed(Cell{}, 0.0, 10);
    for (int k = 0; k < 6; ++k) {
      RandomStream random(7, StreamId::test, static_cast<std::uint64_t>(k));
      const Vec3 center{random.uniform(), random.uniform(), random.uniform()};
      placed.add(Candidate(Cylinder{0.1, 0.3, random_direction(random)}), center);
    }
    const Candidate candidate(Cylinder{0.1, 0.3, normalized(Vec3{1, 2, 4})});
    const Turning turning = rsa::turning_of(candidate.body, redraw);
    constexpr int attempts = 100'000;
    std::int64_t cost = 0;
    int plain = 0;
    for (int k = 0; k < attempts; ++k) {
      RandomStream random(8, StreamId::test, static_cast<std::uint64_t>(k));
      const Vec3 center{random.uniform(), random.uniform(), random.uniform()};
      rsa::TrialNumbers::Row row = rsa::TrialNumbers(10, StreamId::test, 0).trial(k);
      const Candidate turned(rsa::turned_at_random(candidate.body, turning, row));
      plain += leaves_room_for(placed, turned, center, cost);
    }
    REQUIRE(plain > 300);
    rsa::VacancyList list(placed, candidate, turning);
    for (int level = 0; level < 6; ++level) {
      int fitting = 0;
      const rsa::TrialNumbers numbers(9, StreamId::test, static_cast<std::uint64_t>(level));
      for (int k = 0; k < attempts / 4; ++k) {
        const auto pose = list.draw(numbers.trial(k));
        const bool fits = list.fits(pose, cost);
        // Neighbors of the cell decide as all bodies do.
        REQUIRE(fits ==
                leaves_room_for(placed, list.turned(pose), wrapped(Cell{}, pose.center), cost));
        fitting += fits;
      }
      const double found = list.part() * fitting / (attempts / 4);
      const double expected = static_cast<double>(plain) / attempts;
      const double error = std::sqrt(expected / attempts + found * list.part() / (attempts / 4));
      CHECK(found == Approx(expected).margin(4.5 * error));
      static_cast<void>(list.split(RunContext{}));
    }
    CHECK(list.part() < 0.6);
  }
}

}  // namespace packstone
