#pragma once

/// @file
/// Bodies that are ordered, runs that pack them, and what must hold of every result.

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "scenes.hpp"
#include "support/brute_force_check.hpp"
#include "support/random_body.hpp"

namespace packstone::orders {

using Bodies = std::vector<OrderedBody>;

// The shapes that any list of them should have.
inline const Body kBall = Sphere{1}, kProlate = Ellipsoid{{2, 1, 1}, {}},
                  kOblate = Ellipsoid{{3, 3, 1}, {}}, kScalene = Ellipsoid{{3, 2, 1}, {}},
                  kRod = Cylinder{1, 3}, kCoin = Cylinder{3, 1}, kCapsule = Spherocylinder{1, 3};

/// Volume of all [L^3]; in the plane area [L^2].
inline double total_volume(const Bodies& bodies) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += volume(b.body);
  return sum;
}

/// All made larger or smaller by one factor, so that they fill `fraction` of the cell.
inline Bodies filling(const Cell& cell, Bodies bodies, double fraction) {
  const double factor =
      std::pow(fraction * volume(cell) / total_volume(bodies), 1.0 / cell.dimension);
  for (OrderedBody& b : bodies) b.body = scaled(b.body, factor);
  return bodies;
}

/// `count` times the shape, turned at random.
inline Bodies copies(const Body& shape, int count, std::uint64_t seed = 5) {
  Bodies bodies;
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, StreamId::test, static_cast<std::uint64_t>(k));
    bodies.push_back({rotated(shape, random_rotation(random)), 0});
  }
  return bodies;
}

/// Of all shapes, in three groups.
inline Bodies mixture(int dimension, int count, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  Bodies bodies;
  for (int k = 0; k < count; ++k) {
    const ShapeKind shape = test::random_shape(dimension, random);
    bodies.push_back(
        {test::random_body(shape, random, [&] { return random.uniform(0.5, 1.5); }), k % 3});
  }
  return bodies;
}

/// Free of overlap, and of gaps below the least; small packings by brute force too.
inline void check_valid(const EventDrivenResult& result, double min_gap = 0.0) {
  const Certificate certificate = check_packing(result.packing, {.min_gap = min_gap});
  CAPTURE(certificate.smallest_gap, certificate.worst_pair[0], certificate.worst_pair[1]);
  CHECK(certificate.overlaps == 0);
  CHECK(certificate.gaps_below == 0);
  CHECK(certificate.outside_walls == 0);
  if (result.packing.inclusions.size() > 12) return;
  CHECK(test::brute_force_check(result.packing, min_gap).passed());
}

/// The same shape and size to the last bit, however it is turned.
inline bool same_size(const Body& a, const Body& b) {
  if (a.index() != b.index()) return false;
  const auto unturned = [](Body body) {
    std::visit(
        [](auto& s) {
          if constexpr (requires { s.orientation; }) s.orientation = {};
          if constexpr (requires { s.axis; }) s.axis = {0, 0, 1};
          if constexpr (requires { s.angle; }) s.angle = 0.0;
        },
        body);
    return body;
  };
  return unturned(a) == unturned(b);
}

/// All bodies ordered stand there at their full size, and nothing else.
inline void check_reached(const Cell& cell, const Bodies& bodies, const EventDrivenResult& result,
                          double min_gap = 0.0) {
  REQUIRE(result.stop == EventDrivenStop::target_reached);
  CHECK(result.size_factor == 1.0);
  REQUIRE(result.packing.inclusions.size() == bodies.size());
  CHECK(result.packing.cell == cell);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    CHECK(same_size(result.packing.inclusions[k].body, bodies[k].body));
    CHECK(result.packing.inclusions[k].group == bodies[k].group);
  }
  CHECK(fraction(result.packing) == Approx(total_volume(bodies) / volume(cell)).epsilon(1e-12));
  // Rounding of coordinates.
  CHECK(result.report.most_negative_gap >= -1e-13);
  check_valid(result, min_gap);
}

/// With a time limit that no run comes near, so that one that would never end fails.
inline EventDrivenResult pack(const Cell& cell, const Bodies& bodies,
                              EventDrivenOptions options = {}) {
  if (options.seed == 0) options.seed = 3;
  const auto limit = RunContext::Clock::now() + std::chrono::seconds(20);
  return event_driven_pack(cell, bodies, options, RunContext{}.deadline(limit));
}

inline std::uint64_t hash_of(const EventDrivenResult& result) {
  return scenes::state_hash(result.packing);
}

/// What InvalidArgument says; empty if nothing is thrown.
template <class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

/// All of these are in the message.
inline void check_names(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    CAPTURE(message, part);
    CHECK(message.find(part) != std::string::npos);
  }
}

}  // namespace packstone::orders
