#pragma once

/// @file
/// What every gap kernel must satisfy, checked on one pair.

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "support/oracle.hpp"

namespace packstone {

/// Exchange of a and b, a turn of the pair, another unit of length.
inline void check_gap_invariance(const Body& a, const Body& b, const Vec3& r,
                                 const Quaternion& turn, double unit) {
  const Gap g = gap(a, b, r);
  const Gap swapped = gap(b, a, -r);
  CHECK(std::abs(swapped.value - g.value) <= swapped.error + g.error);

  const Gap turned = gap(rotated(a, turn), rotated(b, turn), rotate(turn, r));
  // The turn itself rounds the poses.
  const double slack = 1e-14 * (norm(r) + std::fmax(circum_radius(a), circum_radius(b)));
  CHECK(std::abs(turned.value - g.value) <= turned.error + g.error + slack);

  const Gap larger = gap(scaled(a, unit), scaled(b, unit), unit * r);
  CHECK(std::abs(larger.value / unit - g.value) <= larger.error / unit + g.error);
}

/// decide() with a least gap says what gap() says, and a direction proves it.
inline void check_least_gap(const Body& a, const Body& b, const Vec3& r, double min_gap) {
  const Gap g = gap(a, b, r);
  const Decision decision = decide(a, b, r, min_gap);
  if (g.value - 3 * g.error > min_gap) REQUIRE(decision.verdict == Verdict::separated);
  if (g.value + 3 * g.error < min_gap) REQUIRE(decision.verdict == Verdict::overlapping);
  if (decision.verdict == Verdict::separated) {
    REQUIRE(oracle::certified(a, b, r, min_gap, decision));
  }
}

/// The gap after a body has grown is no wider than before.
inline void check_no_wider(const Gap& before, const Gap& after) {
  CHECK(after.value - after.error <= before.value + before.error);
}

}  // namespace packstone
