#pragma once

/// @file
/// Pairs of the zoo as the engine sees them at one instant.

#include "generate/event_driven/plane_search.hpp"
#include "movers.hpp"

namespace packstone::movers {

struct PosedPair {
  event_driven::PosedBody a, b;
};

inline PosedPair posed_pair(const zoo::Pair& pair, double factor = 1.0) {
  Scene scene;
  scene.movers.push_back({pair.a, {}, {}, {}});
  scene.movers.push_back({pair.b, {}, {}, {}});
  const Bodies bodies = bodies_of(scene);
  return {event_driven::posed(bodies, 0, bodies.pose(0, 0.0), factor),
          event_driven::posed(bodies, 1, bodies.pose(1, 0.0), factor)};
}

inline double gap_along(const PosedPair& p, const Vec3& r, const Vec3& n) {
  using event_driven::support;
  return (dot(n, r) - support(p.a, n) - support(p.b, n)) / norm(n);
}

}  // namespace packstone::movers
