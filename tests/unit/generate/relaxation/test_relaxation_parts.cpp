#include <catch2/catch.hpp>
#include <cmath>

#include "generate/relaxation/bodies.hpp"
#include "generate/relaxation/descent.hpp"
#include "generate/relaxation/overlap_energy.hpp"
#include "generate/relaxation/relocation.hpp"
#include "generate/relaxation/tensor_hold.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "support/random_packing.hpp"

namespace packstone::relaxation {
namespace {

// Bodies of all shapes of a dimension, at random places of a cell, overlapping.
Packing thrown(int dimension, int count, double size, std::uint64_t seed, bool walls) {
  Packing packing;
  packing.cell.dimension = dimension;
  packing.cell.size = {1.0, 0.8, dimension == 2 ? 0.0 : 0.9};
  packing.cell.periodic = {true, !walls, dimension == 3};
  packing.groups = {"all"};
  RandomStream random(seed, StreamId::test);
  for (int k = 0; k < count; ++k) {
    const Vec3 u = random_direction(random);
    const double s = size * random.uniform(0.5, 1.0);
    Body body;
    if (dimension == 2) {
      if (k % 2 == 0) body = Disk{s};
      if (k % 2 == 1) body = Ellipse{{s, 0.5 * s}, random.uniform(0, 3)};
    } else {
      if (k % 5 == 0) body = Sphere{s};
      if (k % 5 == 1) body = Spherocylinder{0.4 * s, s, u};
      if (k % 5 == 2) body = Ellipsoid{{s, 0.7 * s, 0.5 * s}, random_rotation(random)};
      if (k % 5 == 3) body = Ellipsoid{{s, 0.6 * s, 0.6 * s}, random_rotation(random)};
      if (k % 5 == 4) body = Cylinder{0.5 * s, s, u};
    }
    Vec3 center;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
      center[a] = random.uniform(0.0, packing.cell.size[a]);
    }
    packing.inclusions.push_back({center, body, 0});
  }
  return packing;
}

// Equation (1) of relaxation.hpp over all pairs and images, by the proven gap.
double slow_energy(const Packing& packing, const RelaxationOptions& options, const Bodies& bodies) {
  double sum = 0.0;
  const std::size_t n = packing.inclusions.size();
  const auto add = [&](double depth) { sum += depth > 0.0 ? 0.5 * depth * depth : 0.0; };
  for (std::size_t i = 0; i < n; ++i) {
    const Inclusion& a = packing.inclusions[i];
    for (std::size_t j = i; j < n; ++j) {
      const Inclusion& b = packing.inclusions[j];
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) {
            const std::array<int, 3> image{x, y, z};
            if ((x != 0 && !packing.cell.periodic[0]) || (y != 0 && !packing.cell.periodic[1]))
              continue;
            if (z != 0 && !packing.cell.periodic[2]) continue;
            if (i == j && image <= std::array<int, 3>{0, 0, 0}) continue;
            const Vec3 r = b.center - a.center + image_shift(packing.cell, image);
            const double wanted = options.min_gap + std::min(bodies.shell[i], bodies.shell[j]);
            add(wanted - gap(a.body, b.body, r).value);
          }
        }
      }
    }
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(packing.cell.dimension); ++axis) {
      if (packing.cell.periodic[axis]) continue;
      Vec3 out;
      out[axis] = 1.0;
      const double reach = support(bodies.posed[i], out);
      add(bodies.shell[i] - (a.center[axis] - reach));
      add(bodies.shell[i] - (packing.cell.size[axis] - a.center[axis] - reach));
    }
  }
  return sum;
}

Motion random_motion(const Bodies& bodies, int dimension, RandomStream& random) {
  Motion motion(bodies.motion_size(), 0.0);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const bool turn = k >= 3 * bodies.count();
    const bool out = dimension == 2 && (turn ? k % 3 != 2 : k % 3 == 2);
    if (!out) motion[k] = random.normal();
  }
  return motion;
}

}  // namespace

TEST_CASE("the energy is that of all pairs, images and walls") {
  for (const int dimension : {2, 3}) {
    for (const bool walls : {false, true}) {
      for (int seed = 1; seed <= 6; ++seed) {
        const double size = dimension == 2 ? 0.1 : 0.16;
        const Packing packing =
            thrown(dimension, 25, size, static_cast<std::uint64_t>(seed), walls);
        const RelaxationOptions options{.min_gap = 0.01, .inflation = 0.05};
        const Bodies bodies = bodies_of(packing, options);
        OverlapEnergy overlap(packing.cell, 1);
        Motion gradient;
        const Energy energy = overlap(bodies, gradient);
        const double slow = slow_energy(packing, options, bodies);
        CAPTURE(dimension, walls, seed);
        REQUIRE(energy.contacts > 5);
        // Of deep overlaps a local search may find another depth than the least.
        CHECK(energy.value >= slow * (1 - 1e-9));
        CHECK(energy.value <= slow * 1.2);
        CHECK(static_cast<std::int64_t>(overlap.pushes().size()) == energy.contacts);
      }
    }
  }
}

TEST_CASE("the gradient is the slope of the energy along any motion") {
  RandomStream random(21, StreamId::test);
  int off = 0, tried = 0;
  for (const int dimension : {2, 3}) {
    for (int seed = 1; seed <= 20; ++seed) {
      const Packing packing = thrown(dimension, 20, 0.1, static_cast<std::uint64_t>(seed), true);
      const RelaxationOptions options{.inflation = 0.05};
      Bodies bodies = bodies_of(packing, options);
      OverlapEnergy overlap(packing.cell, 1);
      Motion gradient, unused;
      overlap(bodies, gradient);
      const std::vector<PosedBody> from = bodies.posed;
      const Motion motion = random_motion(bodies, dimension, random);
      const double h = 1e-7;
      move(bodies, from, motion, h);
      const double ahead = overlap(bodies, unused).value;
      move(bodies, from, motion, -h);
      const double behind = overlap(bodies, unused).value;
      const double slope = inner_product(gradient, motion, 1);
      ++tried;
      off +=
          std::abs((ahead - behind) / (2 * h) - slope) >
          1e-4 * std::sqrt(inner_product(gradient, gradient, 1) * inner_product(motion, motion, 1));
    }
  }
  // Where a contact jumps along a shared side the energy has an edge.
  CHECK(off <= tried / 10);
}

TEST_CASE("near pairs are kept while they hold, and the energy does not depend on it") {
  const Packing packing = thrown(3, 60, 0.1, 5, false);
  const RelaxationOptions options;
  Bodies bodies = bodies_of(packing, options);
  OverlapEnergy kept(packing.cell, 1);
  RandomStream random(22, StreamId::test);
  Motion gradient, fresh_gradient;
  kept(bodies, gradient);
  for (int step = 0; step < 30; ++step) {
    const std::vector<PosedBody> from = bodies.posed;
    move(bodies, from, random_motion(bodies, 3, random), 1e-3);
    const Energy energy = kept(bodies, gradient);
    const Energy fresh = OverlapEnergy(packing.cell, 1)(bodies, fresh_gradient);
    REQUIRE(energy.value == Approx(fresh.value).epsilon(0.05));
  }
  CHECK(kept.searches() > 1);
  CHECK(kept.searches() < 20);
}

TEST_CASE("few bodies that go far are found anew alone, and no contact is missed") {
  for (const bool walls : {false, true}) {
    Packing packing = thrown(3, 600, 0.05, 6, walls);
    for (Inclusion& inclusion : packing.inclusions) {
      if (std::holds_alternative<Sphere>(inclusion.body)) continue;
      inclusion.body =
          Spherocylinder{0.01, 0.2, symmetry_axis(inclusion.body).value_or(Vec3{0, 1, 0})};
    }
    Bodies bodies = bodies_of(packing, RelaxationOptions{});
    OverlapEnergy kept(packing.cell, 1);
    RandomStream random(25, StreamId::test);
    Motion gradient, fresh_gradient;
    std::int64_t far_contacts = 0;
    for (int step = 0; step < 60; ++step) {
      // Every fiftieth body moves by a width or more each time, all others by a thousandth of it.
      Motion motion = random_motion(bodies, 3, random);
      for (std::size_t i = 0; i < bodies.count(); ++i) {
        const double scale = i % 50 == 0 ? 1.0 : 1e-3;
        set_at(motion, 3 * i, scale * vec_at(motion, 3 * i));
        if (bodies.turning[i].slot < 0) continue;
        set_at(motion, bodies.turn_at(i), scale * vec_at(motion, bodies.turn_at(i)));
      }
      const std::vector<PosedBody> from = bodies.posed;
      move(bodies, from, motion, 0.02);
      const Energy energy = kept(bodies, gradient);
      const Energy fresh = OverlapEnergy(packing.cell, 1)(bodies, fresh_gradient);
      REQUIRE(energy.contacts == fresh.contacts);
      REQUIRE(energy.value == Approx(fresh.value).epsilon(1e-9));
      for (const Push& push : kept.pushes()) far_contacts += push.a % 50 == 0 ? 1 : 0;
    }
    CHECK(far_contacts > 500);
    CHECK(kept.searches() < 20);
  }
}

TEST_CASE("remembered steps make directions of descent that solve a quadratic problem") {
  // 1/2 sum c_k x_k^2, c from 1 to 100.
  const std::size_t n = 60;
  const auto slope = [&](const Motion& x) {
    Motion g(n);
    for (std::size_t k = 0; k < n; ++k)
      g[k] = (1.0 + 99.0 * static_cast<double>(k) / (n - 1)) * x[k];
    return g;
  };
  Motion x(n, 1.0);
  CurvatureMemory memory(1);
  Motion gradient = slope(x);
  for (int step = 0; step < 150; ++step) {
    Motion direction;
    memory.find_direction(gradient, direction);
    REQUIRE(inner_product(direction, gradient, 1) < 0.0);
    // The exact step along the line.
    const Motion bent = slope(direction);
    const double length =
        -inner_product(direction, gradient, 1) / inner_product(direction, bent, 1);
    const Motion before = gradient;
    add_multiple(length, direction, x, 1);
    add_multiple(length, bent, gradient, 1);
    memory.add(length, direction, before, gradient);
    if (inner_product(gradient, gradient, 1) < 1e-16) break;
  }
  CHECK(inner_product(x, x, 1) < 1e-10);
}

TEST_CASE("sums of products do not depend on the number of threads") {
  RandomStream random(23, StreamId::test);
  Motion x(50'000), y(50'000);
  for (double& v : x) v = random.normal();
  for (double& v : y) v = random.normal();
  CHECK(inner_product(x, y, 1) == inner_product(x, y, 2));
  CHECK(inner_product(x, y, 1) == inner_product(x, y, 7));
}

TEST_CASE("a projected motion leaves the tensor, and restoring it turns little") {
  RandomStream random(24, StreamId::test);
  for (const int count : {5, 20, 200}) {
    Packing packing;
    packing.cell = {3, {1, 1, 1}, {true, true, true}};
    packing.groups = {"fibers"};
    for (int k = 0; k < count; ++k) {
      packing.inclusions.push_back(
          {{0.5, 0.5, 0.5}, Spherocylinder{0.01, 0.1, random_direction(random)}, 0});
    }
    const RelaxationOptions options;
    Bodies bodies = bodies_of(packing, options);
    const std::vector<TensorHold> holds = tensor_holds(bodies, packing, options);
    REQUIRE(holds.size() == 1);
    const auto tensor = [&] {
      std::vector<Vec3> axes;
      for (const PosedBody& body : bodies.posed) axes.push_back(body.pose.axis);
      return orientation_tensor(axes);
    };
    const SymMat3 before = tensor();
    Motion motion = random_motion(bodies, 3, random);
    holds[0].project(bodies, motion);
    Motion again = motion;
    holds[0].project(bodies, again);
    add_multiple(-1.0, motion, again, 1);
    CHECK(inner_product(again, again, 1) < 1e-18 * inner_product(motion, motion, 1));

    const std::vector<PosedBody> from = bodies.posed;
    const double step = 1e-5 * bodies.turning[0].arm;
    move(bodies, from, motion, step);
    const SymMat3 moved = tensor() - before;
    CHECK(std::abs(moved.xx) + std::abs(moved.xy) + std::abs(moved.yz) < 1e-8);
    REQUIRE(holds[0].restore(bodies));
    const SymMat3 restored = tensor() - before;
    CHECK(std::abs(restored.xx) + std::abs(restored.xy) + std::abs(restored.yz) < 1e-13);
  }
}

TEST_CASE("a body that overlaps is moved to where it does not, if there is such a place") {
  Packing packing;
  packing.cell = {3, {1, 1, 1}, {true, false, true}};
  packing.groups = {"balls"};
  packing.inclusions = {{{0.5, 0.5, 0.5}, Sphere{0.2}, 0}, {{0.5, 0.55, 0.5}, Sphere{0.2}, 0}};
  const RelaxationOptions options;
  Bodies bodies = bodies_of(packing, options);
  OverlapEnergy overlap(packing.cell, 1);
  Motion gradient;
  REQUIRE(overlap(bodies, gradient).contacts == 1);
  RandomStream random(25, StreamId::test);
  CHECK(relocate(bodies, packing.cell, overlap.pushes(), 0.02, random) == 1);
  CHECK(overlap(bodies, gradient).contacts == 0);
  CHECK(relocate(bodies, packing.cell, {}, 0.02, random) == 0);
}

}  // namespace packstone::relaxation
