#pragma once

/// @file
/// Pairs of the zoo as dynamic methods see them at one instant.

#include "geometry/posed_body.hpp"
#include "support/pair_zoo.hpp"

namespace packstone::zoo {

struct PosedPair {
  PosedBody a, b;
};

inline PosedBody posed_at_size(const Body& body, double factor) {
  PosedBody posed = posed_body(body);
  posed.axial *= factor;
  posed.second *= factor;
  posed.lateral *= factor;
  return posed;
}

inline PosedPair posed_pair(const Pair& pair, double factor = 1.0) {
  return {posed_at_size(pair.a, factor), posed_at_size(pair.b, factor)};
}

inline double gap_along(const PosedPair& p, const Vec3& r, const Vec3& n) {
  return (dot(n, r) - support(p.a, n) - support(p.b, n)) / norm(n);
}

}  // namespace packstone::zoo
