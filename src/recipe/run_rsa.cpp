#include "recipe/run_rsa.hpp"

#include <algorithm>
#include <utility>

#include "packstone/geometry/measures.hpp"
#include "recipe/compare_groups.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/open_supply.hpp"

namespace packstone::recipe {
namespace {

RsaResult place(const Recipe& recipe, const InclusionMix& mix, const RunContext& run) {
  const RsaOptions options = rsa_options(recipe);
  const auto open = std::find(mix.open_count.begin(), mix.open_count.end(), true);
  if (open == mix.open_count.end()) return rsa_pack(recipe.cell, mix.bodies, options, run);
  if (const double radius = saturating_radius(recipe); radius > 0.0) {
    return rsa_saturate(recipe.cell, radius, options, run);
  }
  std::vector<OrderedBody> first = mix.bodies;
  if (recipe.rsa.order == RsaOrder::largest_first) {
    std::stable_sort(first.begin(), first.end(), [](const OrderedBody& a, const OrderedBody& b) {
      return volume(a.body) > volume(b.body);
    });
  }
  OpenSupply supply(recipe, std::move(first), 0);
  return rsa_fill(
      recipe.cell, [&supply](std::int64_t k) { return supply(k); }, options, run);
}

bool ended_full(RsaStop stop) {
  return stop == RsaStop::saturated || stop == RsaStop::given_up || stop == RsaStop::target_reached;
}

// What the summary says of groups whose saturation cannot be proven.
std::vector<std::string> limits_of_redrawing(const Recipe& recipe, const InclusionMix& mix) {
  const std::vector<bool> redrawn = redrawn_groups(recipe);
  std::vector<std::string> sentences;
  for (std::size_t g = 0; g < redrawn.size(); ++g) {
    const auto unequal = [&](const OrderedBody& b) {
      const auto* const ellipsoid = std::get_if<Ellipsoid>(&b.body);
      if (ellipsoid == nullptr || b.group != static_cast<int>(g)) return false;
      const Vec3& s = ellipsoid->semi_axes;
      return s.x != s.y && s.y != s.z && s.x != s.z;
    };
    if (!redrawn[g] || std::none_of(mix.bodies.begin(), mix.bodies.end(), unequal)) continue;
    sentences.push_back(recipe.groups[g].name +
                        ": of redrawn ellipsoids with three different semi-axes none is proven to "
                        "fit nowhere; one that finds no place is given up after max_trials = " +
                        std::to_string(recipe.rsa.max_trials));
  }
  return sentences;
}

}  // namespace

RsaOptions rsa_options(const Recipe& recipe) {
  return {.min_gap = recipe.min_gap,
          .order = recipe.rsa.order,
          .redraw_orientation = redrawn_groups(recipe),
          .max_trials = recipe.rsa.max_trials,
          .max_restarts = recipe.rsa.max_restarts,
          .seed = recipe.seed};
}

PackOutcome run_rsa(const Recipe& recipe, const InclusionMix& mix, const RunContext& run) {
  RsaResult result = place(recipe, mix, run);
  PackOutcome outcome;
  outcome.packing = std::move(result.packing);
  outcome.stop = name(result.stop);
  outcome.derived = limits_of_redrawing(recipe, mix);
  outcome.trials = result.trials;
  outcome.restarts = result.restarts;
  outcome.groups = compare_groups(recipe, mix, outcome.packing);
  const std::vector<bool> redrawn = redrawn_groups(recipe);
  for (std::size_t g = 0; g < redrawn.size(); ++g) outcome.groups[g].redrawn = redrawn[g];
  outcome.target_reached = everything_stands(outcome.groups, ended_full(result.stop));
  return outcome;
}

}  // namespace packstone::recipe
