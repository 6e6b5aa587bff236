#pragma once

/// @file
/// A recipe by event-driven dynamics.

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Lets the bodies grow from where the recipe has them start. What the outcome lacks yet: method,
/// time, certificate, provenance and the names of the groups.
[[nodiscard]] PackOutcome run_event_driven(const Recipe& recipe, const InclusionMix& mix,
                                           const RunContext& run,
                                           const Checkpointing& checkpointing);

/// The same from a state of an earlier run. Throws InvalidArgument when its inclusions are not
/// those of `mix`.
[[nodiscard]] PackOutcome continue_event_driven(const Recipe& recipe, const InclusionMix& mix,
                                                MovingPacking state, const RunContext& run,
                                                const Checkpointing& checkpointing);

}  // namespace packstone::recipe
