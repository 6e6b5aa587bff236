#pragma once

/// @file
/// What may be said of a recipe before the work: how dense such inclusions get, how long it takes.

#include <optional>
#include <vector>

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "recipe/choose_method.hpp"

namespace packstone::recipe {

/// The fraction that random packings of such bodies are known to reach [-]; nothing where that is
/// not known: mixtures, unequal balls and ellipsoids, plates.
///
/// - Equal spheres 0.64 and disks 0.84 (J. G. Berryman, Phys. Rev. A 27 (1983) 1053-1061), equal
///   ellipsoids 0.74 (A. Donev et al., Science 303 (2004) 990-993) and ellipses 0.90 at the aspects
///   that pack best.
/// - Rods of aspect x >= 50, mean length over mean diameter: phi x = 7 (pi/4) / <|sin gamma|>, with
///   gamma the angle between two of them. That a rod touches a fixed number of others, so that phi
///   x is one constant, is the random contact equation: A. P. Philipse, Langmuir 12 (1996)
///   1127-1133, with 5.4 +- 0.2 for rods poured and shaken. 7 is what relaxations, which find other
///   places for some of them, reach at aspects 50 and 100 with directions of near rods as random as
///   at low fractions. Shorter rods line up with their neighbors earlier: a table.
[[nodiscard]] std::optional<double> random_ceiling(const std::vector<OrderedBody>& bodies);

/// What is about to be done.
[[nodiscard]] PackPlan plan_of(const Recipe& recipe, const InclusionMix& mix,
                               const MethodChoice& choice);

}  // namespace packstone::recipe
