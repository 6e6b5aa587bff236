#pragma once

/// @file
/// A recipe by relaxation.

#include <cstdint>

#include "packstone/core/run_context.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Relaxes the bodies drawn, from where random sequential adsorption has placed them smaller, or
/// from random places; `most_restarts` is the most, whatever the recipe says. What the outcome
/// lacks yet: method, time, certificate, provenance and the names of the groups.
[[nodiscard]] PackOutcome run_relaxation(const Recipe& recipe, const InclusionMix& mix,
                                         const RunContext& run, std::int64_t most_restarts);

}  // namespace packstone::recipe
