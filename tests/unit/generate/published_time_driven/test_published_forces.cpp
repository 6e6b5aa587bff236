#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone {
namespace {

constexpr auto kAllTypes = {PublishedContact::sc2, PublishedContact::sc3, PublishedContact::sc4,
                            PublishedContact::d1,  PublishedContact::d2,  PublishedContact::cd1,
                            PublishedContact::cd2, PublishedContact::cd3, PublishedContact::cc1,
                            PublishedContact::ss};

bool near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  return norm(a - b) < tolerance;
}

struct Pair {
  Body a, b;
  Vec3 r;
};

Body random_body(RandomStream& random) {
  if (random.uniform() < 0.4) return Sphere{random.uniform(0.5, 1.5)};
  return Cylinder{random.uniform(0.5, 1.5), random.uniform(0.5, 3.0), random_direction(random)};
}

Pair random_pair(RandomStream& random) {
  return {random_body(random), random_body(random),
          random.uniform(0.0, 4.0) * random_direction(random)};
}

Vec3 total(const PublishedForces& forces) {
  Vec3 sum;
  for (const PublishedForce& force : forces) sum += force.on_a;
  return sum;
}

// The only force of a pair.
PublishedForce only(const Body& a, const Body& b, const Vec3& r, bool literal = false) {
  const PublishedForces forces = published_forces(a, b, r, literal);
  REQUIRE(forces.size() == 1);
  return forces[0];
}

// A force of this type among those of the pair.
PublishedForce one_of(PublishedContact type, const Body& a, const Body& b, const Vec3& r,
                      bool literal = false) {
  const PublishedForces forces = published_forces(a, b, r, literal);
  for (const PublishedForce& force : forces) {
    if (force.type == type) return force;
  }
  FAIL("no force of type " << name(type));
  return {};
}

TEST_CASE("what the first body feels, the second feels reversed, at the same point") {
  RandomStream random(51, StreamId::test);
  for (int i = 0; i < 20'000; ++i) {
    const Pair p = random_pair(random);
    const auto forward = published_forces(p.a, p.b, p.r);
    const auto backward = published_forces(p.b, p.a, -p.r);
    REQUIRE(forward.size() == backward.size());
    CHECK(near(total(forward), -total(backward), 1e-9));
    Vec3 torque_forward, torque_backward;
    for (const auto& force : forward) torque_forward += cross(force.point, force.on_a);
    for (const auto& force : backward) {
      torque_backward += cross(force.point + p.r, force.on_a);
    }
    CHECK(near(torque_forward, -torque_backward, 1e-9));
  }
}

TEST_CASE("a pair that is proven apart feels nothing, once repaired") {
  RandomStream random(52, StreamId::test);
  int apart = 0, printed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Pair p = random_pair(random);
    if (overlap(p.a, p.b, p.r) != Verdict::separated) continue;
    ++apart;
    CHECK(published_forces(p.a, p.b, p.r).empty());
    printed += !published_forces(p.a, p.b, p.r, true).empty();
  }
  CHECK(apart > 2'000);
  CHECK(printed > 10);
}

// How far b has to move along d until the bodies are apart.
double way_out(const Pair& p, const Vec3& d) {
  double inside = 0.0, outside = 12.0;
  while (outside - inside > 1e-3) {
    const double middle = 0.5 * (inside + outside);
    const bool apart = overlap(p.a, p.b, p.r + middle * d) == Verdict::separated;
    (apart ? outside : inside) = middle;
  }
  return outside;
}

// Of the single forces of one type, the part that points the shorter way out rather than the
// longer.
struct Outward {
  int count = 0, shorter = 0;

  [[nodiscard]] double part() const { return static_cast<double>(shorter) / count; }
};

std::map<PublishedContact, Outward> outward_forces(bool literal) {
  RandomStream random(53, StreamId::test);
  std::map<PublishedContact, Outward> outward;
  for (int i = 0; i < 60'000; ++i) {
    const Pair p = random_pair(random);
    const PublishedForces forces = published_forces(p.a, p.b, p.r, literal);
    if (forces.size() != 1 || norm(forces[0].on_a) < 1e-6) continue;
    if (overlap(p.a, p.b, p.r) == Verdict::separated) continue;
    const PublishedForce& force = forces[0];
    const Vec3 d = normalized(force.on_a);
    Outward& of_type = outward[force.type];
    ++of_type.count;
    of_type.shorter += way_out(p, -d) < way_out(p, d);
  }
  return outward;
}

TEST_CASE("repaired forces of every type point out of the overlap, printed sc2 and d2 into it") {
  auto repaired = outward_forces(false), printed = outward_forces(true);
  for (const PublishedContact type : kAllTypes) {
    CAPTURE(name(type));
    CAPTURE(repaired[type].count);
    CAPTURE(printed[type].count);
    CHECK(repaired[type].part() >= 0.9);
    if (type == PublishedContact::sc2 || type == PublishedContact::d2) {
      CHECK(printed[type].part() <= 0.1);
    }
  }
}

double energy(const Body& a, const Body& b, const Vec3& r) {
  double sum = 0.0;
  for (const auto& force : published_forces(a, b, r)) sum += 0.5 * norm_sq(force.on_a);
  return sum;
}

TEST_CASE("where the depth is that along the force, the force is the slope of half its square") {
  RandomStream random(54, StreamId::test);
  int checked = 0;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 20'000; ++i) {
    const Pair p = random_pair(random);
    const PublishedForces forces = published_forces(p.a, p.b, p.r);
    if (forces.size() != 1 || norm(forces[0].on_a) < 1e-3) continue;
    const PublishedForce force = forces[0];
    const PublishedContact type = force.type;
    if (type != PublishedContact::ss && type != PublishedContact::sc2 &&
        type != PublishedContact::sc3 && type != PublishedContact::sc4 &&
        type != PublishedContact::cc1) {
      continue;
    }
    const auto type_at = [&](const Vec3& r) {
      const auto there = published_forces(p.a, p.b, r);
      return there.size() == 1 ? there[0].type : PublishedContact::none;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 h;
      h[axis] = kStep;
      if (type_at(p.r + h) != type || type_at(p.r - h) != type) continue;
      const double slope = (energy(p.a, p.b, p.r + h) - energy(p.a, p.b, p.r - h)) / (2.0 * kStep);
      // Moving b by h changes r by h; the force on b is -on_a = -dE/dr.
      CHECK(slope == Approx(force.on_a[axis]).margin(1e-6));
      ++checked;
    }
  }
  CHECK(checked > 10'000);
}

TEST_CASE("torque is the slope against turning, where the force is that of a depth") {
  RandomStream random(55, StreamId::test);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 5'000; ++i) {
    const Cylinder rod{random.uniform(0.5, 1.0), random.uniform(1.0, 3.0),
                       random_direction(random)};
    const Body other = random_body(random);
    const Vec3 r = random.uniform(0.5, 3.0) * random_direction(random);
    const PublishedForces forces = published_forces(rod, other, r);
    if (forces.size() != 1) continue;
    const PublishedForce force = forces[0];
    if (force.type != PublishedContact::sc2 && force.type != PublishedContact::sc4 &&
        force.type != PublishedContact::cc1) {
      continue;
    }
    const Vec3 w = normalized(cross(rod.axis, random_direction(random)));
    const auto turned = [&](double angle) {
      return Cylinder{rod.radius, rod.half_length,
                      normalized(rod.axis + angle * cross(w, rod.axis))};
    };
    const double up = energy(turned(kStep), other, r), down = energy(turned(-kStep), other, r);
    // Types change, and axes that come to cross turn the force about.
    const auto alike = [&](const PublishedForces& nearby) {
      return nearby.size() == 1 && nearby[0].type == force.type &&
             dot(nearby[0].on_a, force.on_a) > 0.0;
    };
    if (!alike(published_forces(turned(kStep), other, r))) continue;
    if (!alike(published_forces(turned(-kStep), other, r))) continue;
    const double torque = dot(w, cross(force.point, force.on_a));
    CHECK((down - up) / (2.0 * kStep) == Approx(torque).margin(1e-5));
  }
}

TEST_CASE("forces apply at the point that Table I says") {
  const Cylinder rod{1.0, 3.0, {0, 0, 1}};
  const auto ss = only(Sphere{1.0}, Sphere{0.5}, {1.2, 0, 0});
  CHECK(near(ss.on_a, {-0.3, 0, 0}));
  CHECK(near(ss.point, {0.85, 0, 0}));
  // On the cylinder's surface, as far along as the sphere.
  const auto sc2 = only(rod, Sphere{0.5}, {1.2, 0, 2});
  CHECK(sc2.type == PublishedContact::sc2);
  CHECK(near(sc2.on_a, {-0.3, 0, 0}));
  CHECK(near(sc2.point, {1, 0, 2}));
  const auto sc3 = only(rod, Sphere{0.5}, {0.4, 0, 3.3});
  CHECK(sc3.type == PublishedContact::sc3);
  CHECK(near(sc3.on_a, {0, 0, -0.2}));
  CHECK(near(sc3.point, {0.4, 0, 3.3}));
  // 3-4-5 triangle over the rim, 0.5 deep in a sphere of radius 1.
  const auto sc4 = only(rod, Sphere{1.0}, {1.3, 0, 3.4});
  CHECK(sc4.type == PublishedContact::sc4);
  CHECK(near(sc4.on_a, {-0.3, 0, -0.4}));
  CHECK(near(sc4.point, {1, 0, 3}));
  const auto cc1 = only(rod, Cylinder{1.0, 3.0, {1, 0, 0}}, {1.0, 1.8, 2.0});
  CHECK(cc1.type == PublishedContact::cc1);
  CHECK(near(cc1.on_a, {0, -0.2, 0}));
  CHECK(near(cc1.point, {0, 0.9, 2}));
}

TEST_CASE("a base that enters a face pushes with its depth, ever harder across the axis") {
  const Cylinder rod{1.0, 3.0, {0, 0, 1}};
  const Vec3 tilt = normalized(Vec3{1, 0, 0.3});
  // The end of `other` comes along its axis toward the rod; its lower rim goes first.
  double last = 0.0;
  bool crossed = false;
  for (double distance = 3.4; distance > 2.0; distance -= 0.02) {
    const auto forces = published_forces(rod, Cylinder{0.4, 2.0, tilt}, distance * tilt);
    double deepest = 0.0;
    for (const auto& force : forces) {
      if (force.type != PublishedContact::cd1 && force.type != PublishedContact::cd2) continue;
      CHECK(force.on_a.x < 0.0);
      deepest = std::max(deepest, norm(force.on_a));
      crossed = crossed || force.type == PublishedContact::cd2;
    }
    if (deepest == 0.0) continue;
    CHECK(deepest > last);
    CHECK(deepest < last + 0.2 + (last == 0.0));
    last = deepest;
  }
  CHECK(last > 0.8);
}

TEST_CASE("printed sc2 pulls, with the root of a difference of squares for a depth") {
  const Cylinder rod{1.0, 3.0, {0, 0, 1}};
  const auto printed = only(Sphere{0.5}, rod, {1.2, 0, 0}, true);
  CHECK(printed.type == PublishedContact::sc2);
  const double size = std::sqrt(1.5 * 1.5 - 1.2 * 1.2);
  // On the sphere, so toward the rod.
  CHECK(near(printed.on_a, {size, 0, 0}));
  CHECK(near(printed.point, {size - 0.5, 0, 0}));
  CHECK(only(Sphere{0.5}, rod, {1.2, 0, 0}).on_a.x < 0.0);
}

TEST_CASE("printed sc4 applies off the cylinder, along the radius") {
  const Cylinder rod{1.0, 3.0, {0, 0, 1}};
  const auto printed = only(rod, Sphere{1.0}, {1.3, 0, 3.4}, true);
  CHECK(printed.type == PublishedContact::sc4);
  CHECK(near(printed.point, {1, 0, 3.4}));
  CHECK(near(printed.on_a, {-(std::sqrt(1.0 - 0.16) + 1.0 - 1.3), 0, 0}));
}

TEST_CASE("printed cd2 weakens as the base goes deeper") {
  const Cylinder rod{1.0, 5.0, {0, 0, 1}};
  const Cylinder slanted{1.0, 2.0, normalized(Vec3{1, 0, 1})};
  const Vec3 r{0.4 + std::numbers::sqrt2, 0, 0.5 + std::numbers::sqrt2};
  const auto printed = one_of(PublishedContact::cd2, rod, slanted, r, true);
  const auto repaired = one_of(PublishedContact::cd2, rod, slanted, r);
  // (2 r_c - d) + (r_c + d) = 3 r_c.
  CHECK(norm(printed.on_a) + norm(repaired.on_a) == Approx(3.0));
  CHECK(near(normalized(printed.on_a), normalized(repaired.on_a)));
  CHECK(repaired.on_a.x < 0.0);
  CHECK(norm(repaired.on_a) == Approx(1.0 + std::sqrt(0.5) - 0.4));
}

TEST_CASE("forces that are 0/0 in print are left out there, and repaired by a direction") {
  const Cylinder rod{1.0, 3.0, {0, 0, 1}};
  // Axes that cross: along the line of centers.
  const Cylinder across{1.0, 3.0, {1, 0, 0}};
  CHECK(published_forces(rod, across, {1, 0, 1}, true).empty());
  CHECK(near(only(rod, across, {1, 0, 1}).on_a, -2.0 * normalized(Vec3{1, 0, 1})));
  // Parallel axes: side by side, in the middle of the common part.
  for (const auto& force : published_forces(rod, rod, {1.5, 0, 2}, true)) {
    CHECK(force.type != PublishedContact::cc1);
  }
  const auto beside = one_of(PublishedContact::cc1, rod, rod, {1.5, 0, 2});
  CHECK(near(beside.on_a, {-0.5, 0, 0}));
  CHECK(near(beside.point, {0.75, 0, 1}));
  // One axis: the bases push along it.
  const auto ends = published_forces(rod, rod, {0, 0, 5.5});
  CHECK(!ends.empty());
  CHECK(total(ends).z < 0.0);
  CHECK(std::hypot(total(ends).x, total(ends).y) < 1e-9);
  // A sphere centered on the axis goes out along the line of centers, one at the center somewhere.
  CHECK(only(Sphere{0.5}, rod, {0, 0, -2}).on_a.z > 0.0);
  CHECK(norm(only(Sphere{0.5}, rod, {0, 0, 0}).on_a) == Approx(1.5));
  CHECK(norm(only(Sphere{0.5}, Sphere{0.5}, {0, 0, 0}).on_a) == Approx(1.0));
}

}  // namespace
}  // namespace packstone
