#pragma once

/// @file
/// What the tests of random sequential adsorption hold its packings against.

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>

#include "packstone/core/random.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::rsa_oracle {

// Calls visit(shift) for all images within `range` periods.
template <class Visit>
inline void for_images(const Cell& cell, int range, Visit&& visit) {
  const auto last = [&](std::size_t axis) { return cell.periodic[axis] ? range : 0; };
  for (int z = -last(2); z <= last(2); ++z) {
    for (int y = -last(1); y <= last(1); ++y) {
      for (int x = -last(0); x <= last(0); ++x) visit(image_shift(cell, {x, y, z}));
    }
  }
}

// All pairs over all images within two periods, own images included, by the exact kernel.
inline int count_unproven_pairs(const Packing& packing, double min_gap) {
  int unproven = 0;
  const auto& all = packing.inclusions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i; j < all.size(); ++j) {
      for_images(packing.cell, 2, [&](const Vec3& shift) {
        if (i == j && norm(shift) == 0.0) return;
        const Vec3 r = (all[j].center + shift) - all[i].center;
        unproven += overlap(all[i].body, all[j].body, r, min_gap) != Verdict::separated;
      });
    }
  }
  return unproven;
}

inline int count_outside_walls(const Packing& packing) {
  int outside = 0;
  for (const Inclusion& inclusion : packing.inclusions) {
    const Vec3 extents = half_extents(inclusion.body);
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(packing.cell.dimension); ++axis) {
      const double x = inclusion.center[axis];
      if (packing.cell.periodic[axis]) {
        outside += x < 0.0 || x >= packing.cell.size[axis];
      } else {
        outside += x - extents[axis] < 0.0 || x + extents[axis] > packing.cell.size[axis];
      }
    }
  }
  return outside;
}

inline void require_valid(const Packing& packing, double min_gap = 0.0) {
  CHECK(count_unproven_pairs(packing, min_gap) == 0);
  CHECK(count_outside_walls(packing) == 0);
}

// Plain attempts at further copies of `body`, turned at random if `turn`: how many fit? Shares
// nothing with the generator but the exact kernel.
inline int count_fitting(const Packing& packing, const Body& body, bool turn, int attempts) {
  int fitting = 0;
  for (int k = 0; k < attempts; ++k) {
    RandomStream random(99, StreamId::test, static_cast<std::uint64_t>(k));
    Vec3 c{random.uniform() * packing.cell.size.x, random.uniform() * packing.cell.size.y, 0.0};
    if (packing.cell.dimension == 3) c.z = random.uniform() * packing.cell.size.z;
    const Body turned = turn ? rotated(body, random_rotation(random)) : body;
    bool free = true;
    for (const Inclusion& other : packing.inclusions) {
      const double reach = circum_radius(turned) + circum_radius(other.body);
      for_images(packing.cell, 1, [&](const Vec3& shift) {
        const Vec3 r = (other.center + shift) - c;
        if (free && norm_sq(r) < reach * reach) {
          free = overlap(turned, other.body, r) == Verdict::separated;
        }
      });
      if (!free) break;
    }
    fitting += free;
  }
  return fitting;
}

inline RsaOptions with_seed(std::uint64_t seed) {
  RsaOptions options;
  options.seed = seed;
  return options;
}

}  // namespace packstone::rsa_oracle
