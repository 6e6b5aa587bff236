#include "recipe/run_relaxation.hpp"

#include <algorithm>
#include <utility>

#include "packstone/generate/relaxed_growth.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/standing.hpp"
#include "recipe/compare_groups.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/rsa_start.hpp"

namespace packstone::recipe {
namespace {

RelaxationOptions options_of(const Recipe& recipe, std::int64_t most_restarts) {
  const RelaxationSettings& settings = recipe.relaxation;
  RelaxationOptions options;
  options.min_gap = recipe.min_gap;
  options.inflation = settings.inflation;
  options.turn.assign(recipe.groups.size(), settings.rotate);
  options.patience = settings.patience;
  options.relocated_share = settings.relocated_share;
  options.max_relocations = settings.max_relocations;
  options.max_restarts = std::min(settings.max_restarts, most_restarts);
  options.seed = recipe.seed;
  return options;
}

// Centers from random sequential adsorption, attempt by attempt with other seeds. Fewer than there
// are bodies where it was stopped on the way.
class RsaStart {
 public:
  RsaStart(const Recipe& recipe, const InclusionMix& mix, double factor, const RunContext& run)
      : recipe_(recipe), mix_(mix), run_(run), factor_(factor) {}

  std::vector<Vec3> operator()(std::int64_t attempt) const {
    const std::uint64_t seed = recipe_.seed + static_cast<std::uint64_t>(attempt);
    const bool ordered = recipe_.relaxation.start_fraction.has_value();
    const RsaResult placed = place_smaller(recipe_, mix_.bodies, factor_, ordered, seed, run_).rsa;
    std::vector<Vec3> centers;
    for (const Inclusion& inclusion : placed.packing.inclusions) {
      centers.push_back(inclusion.center);
    }
    return centers;
  }

 private:
  const Recipe& recipe_;
  const InclusionMix& mix_;
  const RunContext& run_;
  double factor_;
};

// From bodies `factor` as large.
RelaxationStart start_of(const Recipe& recipe, const InclusionMix& mix, double factor,
                         const RunContext& run) {
  if (recipe.relaxation.start == RelaxationFrom::random) return {};
  return RsaStart(recipe, mix, factor, run);
}

double factor_ordered(const Recipe& recipe, const InclusionMix& mix) {
  return start_factor(recipe, mix.bodies, recipe.relaxation.start_fraction, 1.0);
}

PackOutcome relaxed(const Recipe& recipe, const InclusionMix& mix, const RunContext& run,
                    std::int64_t most_restarts) {
  RelaxationResult result =
      relaxation_pack(recipe.cell, mix.bodies, options_of(recipe, most_restarts), run,
                      start_of(recipe, mix, factor_ordered(recipe, mix), run));
  PackOutcome outcome;
  outcome.target_reached = result.stop == RelaxationStop::target_reached;
  outcome.packing = std::move(result.packing);
  outcome.stop = name(result.stop);
  outcome.restarts = result.report.restarts;
  outcome.relaxation = RelaxationOutcome{1.0, result.report, std::move(result.history)};
  return outcome;
}

// Sizes are open: what is longer than the cell begins smaller.
double standing_factor(const Recipe& recipe, const std::vector<OrderedBody>& bodies,
                       double factor) {
  const Turn turn = recipe.relaxation.rotate == RelaxationTurn::locked ? Turn::as_given : Turn::any;
  for (const OrderedBody& ordered : bodies) {
    while (why_it_cannot_stand(recipe.cell, scaled(ordered.body, factor), recipe.min_gap, turn)) {
      factor *= 0.9;
    }
  }
  return factor;
}

PackOutcome grown(const Recipe& recipe, const InclusionMix& mix, const RunContext& run,
                  std::int64_t most_restarts) {
  const double factor = standing_factor(recipe, mix.bodies, factor_ordered(recipe, mix));
  RelaxedGrowthResult result = grow_relaxed(recipe.cell, mix.bodies,
                                            {.relaxation = options_of(recipe, most_restarts),
                                             .start_factor = factor,
                                             .first_step = recipe.relaxation.first_step,
                                             .least_step = recipe.relaxation.least_step},
                                            run, start_of(recipe, mix, factor, run));
  PackOutcome outcome;
  outcome.target_reached = result.at_rest && result.stop != RelaxationStop::cancelled;
  outcome.packing = std::move(result.packing);
  outcome.stop = name(result.stop);
  outcome.restarts = result.report.restarts;
  outcome.relaxation =
      RelaxationOutcome{result.size_factor, result.report, std::move(result.history)};
  return outcome;
}

}  // namespace

PackOutcome run_relaxation(const Recipe& recipe, const InclusionMix& mix, const RunContext& run,
                           std::int64_t most_restarts) {
  PackOutcome outcome = recipe.relaxation.goal == RelaxationGoal::densest
                            ? grown(recipe, mix, run, most_restarts)
                            : relaxed(recipe, mix, run, most_restarts);
  outcome.groups = compare_groups(recipe, mix, outcome.packing);
  const std::vector<bool> turned = turned_groups(recipe, PackMethod::relaxation);
  for (std::size_t g = 0; g < turned.size(); ++g) outcome.groups[g].turned = turned[g];
  return outcome;
}

}  // namespace packstone::recipe
