#pragma once

/// @file
/// The bodies that a recipe orders; or where in the recipe lies what cannot be.

#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Draws the bodies and refuses, with file, line, key and value, what cannot be placed: too many
/// for the memory of this machine, one that cannot stand in the cell, more than there is room for.
[[nodiscard]] InclusionMix draw_mix(const Recipe& recipe);

/// Per group: whether its orientations are redrawn with the trials. Empty: none are.
[[nodiscard]] std::vector<bool> redrawn_groups(const Recipe& recipe);

/// Radius of the equal spheres or disks that one group alone orders in open number, else 0 [L].
[[nodiscard]] double saturating_radius(const Recipe& recipe);

/// "fibers.toml:7: inclusions[0].count = 20; " and what is wrong with it.
[[nodiscard]] std::string complaint(const Recipe& recipe, const InvalidGroup& problem);

/// What `step` returns; its complaints say where in the recipe the fault lies.
template <class Step>
auto for_recipe(const Recipe& recipe, Step step) {
  try {
    return step();
  } catch (const InvalidGroup& problem) {
    throw InvalidArgument(complaint(recipe, problem));
  } catch (const InvalidArgument& problem) {
    if (recipe.origin.empty()) throw;
    throw InvalidArgument(recipe.origin + ": " + problem.what());
  }
}

}  // namespace packstone::recipe
