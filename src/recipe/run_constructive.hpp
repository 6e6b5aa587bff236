#pragma once

/// @file
/// From a recipe to the constructive methods: advancing layers, dropping and rolling.

#include "packstone/core/run_context.hpp"
#include "packstone/recipe/pack.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Throws InvalidArgument, naming the line that orders the method, when it does not take the shapes
/// or the cell of the recipe.
void refuse_unsuited(const Recipe& recipe, PackMethod method);

/// Places the bodies of `mix`, or with a group of open count as many as fit.
[[nodiscard]] PackOutcome run_constructive(const Recipe& recipe, const InclusionMix& mix,
                                           PackMethod method, const RunContext& run);

}  // namespace packstone::recipe
