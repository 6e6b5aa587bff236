#include "recipe/compare_groups.hpp"

#include "packstone/geometry/measures.hpp"

namespace packstone::recipe {
namespace {

// Sample mean of u u^T per group; bodies are OrderedBody or Inclusion.
template <class Bodies>
std::vector<std::optional<SymMat3>> tensors(const Bodies& bodies, std::size_t groups) {
  std::vector<std::vector<Vec3>> axes(groups);
  for (const auto& one : bodies) {
    if (const auto axis = symmetry_axis(one.body)) {
      axes[static_cast<std::size_t>(one.group)].push_back(*axis);
    }
  }
  std::vector<std::optional<SymMat3>> result(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    if (!axes[g].empty()) result[g] = orientation_tensor(axes[g]);
  }
  return result;
}

void compare_orientations(const Recipe& recipe, const InclusionMix& mix, const Packing& packing,
                          std::vector<GroupOutcome>& outcomes) {
  const auto ordered = tensors(mix.bodies, outcomes.size());
  const auto reached = tensors(packing.inclusions, outcomes.size());
  const int dimension = recipe.cell.dimension;
  for (std::size_t g = 0; g < outcomes.size(); ++g) {
    outcomes[g].ordered_tensor = ordered[g];
    outcomes[g].tensor = reached[g];
    if (!reached[g]) continue;
    outcomes[g].order = orientation_order(*reached[g], dimension);
    // A group is of one shape: all of its inclusions have an axis, or none has.
    outcomes[g].random_order = random_order(outcomes[g].count, dimension);
  }
}

}  // namespace

std::vector<GroupOutcome> compare_groups(const Recipe& recipe, const InclusionMix& mix,
                                         const Packing& packing) {
  const double space = volume(recipe.cell);
  std::vector<GroupOutcome> outcomes(recipe.groups.size());
  for (std::size_t g = 0; g < outcomes.size(); ++g) {
    outcomes[g].name = recipe.groups[g].name;
    if (mix.open_count[g]) continue;
    outcomes[g].ordered_count = 0;
    outcomes[g].ordered_fraction = 0.0;
  }
  for (const OrderedBody& ordered : mix.bodies) {
    GroupOutcome& outcome = outcomes[static_cast<std::size_t>(ordered.group)];
    ++*outcome.ordered_count;
    *outcome.ordered_fraction += volume(ordered.body) / space;
  }
  for (const Inclusion& inclusion : packing.inclusions) {
    GroupOutcome& outcome = outcomes[static_cast<std::size_t>(inclusion.group)];
    ++outcome.count;
    outcome.fraction += volume(inclusion.body) / space;
  }
  compare_orientations(recipe, mix, packing, outcomes);
  return outcomes;
}

bool everything_stands(const std::vector<GroupOutcome>& groups, bool is_full) {
  bool open = false;
  for (const GroupOutcome& group : groups) {
    if (group.ordered_count && group.count < *group.ordered_count) return false;
    open = open || !group.ordered_count;
  }
  return !open || is_full;
}

}  // namespace packstone::recipe
