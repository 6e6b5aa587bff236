#include "recipe/run_time_driven.hpp"

#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "recipe/compare_groups.hpp"
#include "recipe/draw_mix.hpp"

namespace packstone::recipe {

PackOutcome run_time_driven(const Recipe& recipe, const InclusionMix& mix, const RunContext& run) {
  if (recipe.min_gap > 0.0) {
    throw InvalidArgument("packing.min_gap = " + number_text(recipe.min_gap) +
                          "; allowed is 0: the published method knows no least gap");
  }
  TimeDrivenOptions options = recipe.time_driven;
  options.seed = recipe.seed;
  TimeDrivenResult result = published_time_driven_pack(recipe.cell, mix.bodies, options, run);
  PackOutcome outcome;
  const bool passed = result.packing.certificate->passed();
  outcome.target_reached = passed && result.stop == TimeDrivenStop::relaxed;
  outcome.stop = outcome.target_reached ? "target_reached" : std::string(name(result.stop));
  outcome.packing = std::move(result.packing);
  outcome.time_driven = TimeDrivenOutcome{.start_energy = result.start_energy,
                                          .potential_energy = result.potential_energy,
                                          .kinetic_energy = result.kinetic_energy,
                                          .overlaps = result.overlaps,
                                          .deepest = result.deepest,
                                          .steps = result.steps,
                                          .reshuffles = result.reshuffles,
                                          .history = std::move(result.history)};
  outcome.groups = compare_groups(recipe, mix, outcome.packing);
  const std::vector<bool> turned = turned_groups(recipe, PackMethod::time_driven);
  for (std::size_t g = 0; g < turned.size(); ++g) outcome.groups[g].turned = turned[g];
  return outcome;
}

}  // namespace packstone::recipe
