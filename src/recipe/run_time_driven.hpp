#pragma once

/// @file
/// A recipe by the published time-driven method.

#include "packstone/core/run_context.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Relaxes the bodies drawn, from random places, as Salnikov et al. (2015) do. What the outcome
/// lacks yet: method, time, certificate, provenance and the names of the groups. The target is
/// reached where the certificate says so, whatever the method believes.
[[nodiscard]] PackOutcome run_time_driven(const Recipe& recipe, const InclusionMix& mix,
                                          const RunContext& run);

}  // namespace packstone::recipe
