#pragma once

/// @file
/// The bodies that a recipe orders; or where in the recipe lies what cannot be.

#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Draws the bodies; refuses, with file, line, key and value, too many for the memory of this
/// machine.
[[nodiscard]] InclusionMix draw_mix(const Recipe& recipe);

/// Whether the method places bodies one by one where they touch others, and turns none.
[[nodiscard]] bool is_constructive(PackMethod method);

/// Whether the goal of `method` leaves the sizes open.
[[nodiscard]] bool is_any_size(const Recipe& recipe, PackMethod method);

/// Refuses, with file, line, key and value, what `method` cannot place: a body that cannot stand in
/// the cell, more than there is room for. Where the goal leaves
/// the sizes open, gaps alone count.
void refuse_impossible(const Recipe& recipe, const InclusionMix& mix, PackMethod method);

/// The names of the groups, in the order of the recipe.
[[nodiscard]] std::vector<std::string> group_names(const Recipe& recipe);

/// Per group: whether its orientations are redrawn with the trials. Empty: none are.
[[nodiscard]] std::vector<bool> redrawn_groups(const Recipe& recipe);

/// Per group: whether event-driven dynamics keeps the orientations drawn. Empty: of none.
[[nodiscard]] std::vector<bool> fixed_orientations(const Recipe& recipe);

/// Per group: whether `method` changes the orientations drawn. Empty: of none.
[[nodiscard]] std::vector<bool> turned_groups(const Recipe& recipe, PackMethod method);

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
