#pragma once

/// @file
/// Pairs of ellipsoids that fly toward each other, and their state at and between contacts.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/random.hpp"
#include "packstone/generate/published_event_driven.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::moving_pairs {

inline constexpr Cell kUnitCube{};
inline constexpr auto kPrinted = PublishedForm::printed;

using MovingPair = std::pair<MovingEllipsoid, MovingEllipsoid>;

inline double longest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

inline MovingPair moved(const MovingPair& pair, double dt) {
  return {published_moved(pair.first, dt), published_moved(pair.second, dt)};
}

inline Vec3 separation(const MovingPair& pair) { return pair.second.center - pair.first.center; }

inline Gap gap(const MovingPair& pair) {
  return gap(Body{body_of(pair.first)}, Body{body_of(pair.second)}, separation(pair));
}

inline bool apart(const MovingPair& pair) {
  return decide(Body{body_of(pair.first)}, Body{body_of(pair.second)}, separation(pair)).verdict ==
         Verdict::separated;
}

/// Two equal bodies, longest semi-axis 1, that fly toward each other at a speed near 1. Their tips
/// turn at up to `spin`; their axes make an angle of `tilt`, random without one.
inline MovingPair approaching_pair(RandomStream& random, const Vec3& shape, double spin,
                                   std::optional<double> tilt = {}) {
  MovingEllipsoid a{.orientation = random_rotation(random),
                    .velocity = 0.2 * random_direction(random),
                    .angular_velocity = spin * random.uniform() * random_direction(random),
                    .semi_axes = shape / longest(shape),
                    .growth = 0.02 * shape / longest(shape)};
  MovingEllipsoid b = a;
  b.orientation = random_rotation(random);
  if (tilt) {
    b.orientation = normalized(from_axis_angle(random_direction(random), *tilt) * a.orientation);
  }
  const Vec3 d = random_direction(random);
  b.center =
      random.uniform(1.05, 2.0) / contact_scale(Body{body_of(a)}, Body{body_of(b)}, d).lower * d;
  b.velocity = a.velocity - d + 0.3 * random_direction(random);
  if (!tilt) b.angular_velocity = spin * random.uniform() * random_direction(random);
  return {a, b};
}

/// By then the two have passed each other.
inline double passing_time(const MovingPair& pair) { return norm(separation(pair)) + 3.0; }

/// Pairs that collide, at the moment of touching.
inline std::vector<MovingPair> touching_pairs(const Vec3& shape, double spin, int count,
                                              std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  std::vector<MovingPair> touching;
  while (static_cast<int>(touching.size()) < count) {
    const MovingPair pair = approaching_pair(random, shape, spin);
    const auto time = published_contact_time(pair.first, pair.second, passing_time(pair));
    if (time) touching.push_back(moved(pair, *time));
  }
  return touching;
}

}  // namespace packstone::moving_pairs
