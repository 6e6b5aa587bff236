#include "recipe/run_constructive.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/shuffle.hpp"
#include "packstone/geometry/measures.hpp"
#include "recipe/compare_groups.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/open_supply.hpp"

namespace packstone::recipe {
namespace {

[[noreturn]] void refuse(const Recipe& recipe, PackMethod method, const std::string& why) {
  const auto place = recipe.places.find("packing.method");
  throw InvalidArgument((place != recipe.places.end()
                             ? place->second
                             : "packing.method = \"" + std::string(name(method)) + "\"") +
                        "; " + why);
}

bool is_open(const InclusionMix& mix) {
  return std::find(mix.open_count.begin(), mix.open_count.end(), true) != mix.open_count.end();
}

// Bodies are placed in their order, and groups shall mix.
std::vector<OrderedBody> shuffled(std::vector<OrderedBody> bodies, std::uint64_t seed) {
  RandomStream random(seed, StreamId::constructive_order);
  shuffle(bodies, random);
  return bodies;
}

double total_volume(const std::vector<OrderedBody>& bodies) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += volume(b.body);
  return sum;
}

// How many bodies of the open group there will be, roughly.
std::int64_t expected_open(const Recipe& recipe, const std::vector<OrderedBody>& counted) {
  constexpr std::int64_t kSample = 1000;
  OpenSupply open(recipe, {}, 0);
  double sample = 0.0;
  for (std::int64_t k = 0; k < kSample; ++k) sample += volume(open(k).body);
  const double reached = recipe.cell.dimension == 2 ? 0.8 : 0.58;
  const double left = reached * volume(recipe.cell) - total_volume(counted);
  return static_cast<std::int64_t>(std::max(0.0, left) / sample * static_cast<double>(kSample));
}

// pack(bodies) or fill(supply), whichever the recipe asks for.
template <class Pack, class Fill>
auto place(const Recipe& recipe, const InclusionMix& mix, const Pack& pack, const Fill& fill) {
  std::vector<OrderedBody> bodies = shuffled(mix.bodies, recipe.seed);
  if (!is_open(mix)) return pack(bodies);
  const std::int64_t among = expected_open(recipe, bodies);
  OpenSupply supply(recipe, std::move(bodies), among);
  return fill([&supply](std::int64_t k) { return supply(k); });
}

AdvancingLayerResult by_advancing_layer(const Recipe& recipe, const InclusionMix& mix,
                                        const RunContext& run) {
  const AdvancingLayerSettings& settings = recipe.advancing_layer;
  const AdvancingLayerOptions options{.min_gap = recipe.min_gap,
                                      .top_layer = settings.top_layer,
                                      .candidates = settings.candidates,
                                      .held_back = settings.held_back,
                                      .close_top = settings.close_top,
                                      .max_restarts = settings.max_restarts,
                                      .seed = recipe.seed};
  return place(
      recipe, mix,
      [&](const auto& bodies) { return advancing_layer_pack(recipe.cell, bodies, options, run); },
      [&](const auto& supply) { return advancing_layer_fill(recipe.cell, supply, options, run); });
}

ConstructiveResult by_dropping(const Recipe& recipe, const InclusionMix& mix,
                               const RunContext& run) {
  const DropAndRollOptions options{
      .drops = recipe.drop_and_roll.drops, .min_gap = recipe.min_gap, .seed = recipe.seed};
  return place(
      recipe, mix,
      [&](const auto& bodies) { return drop_and_roll_pack(recipe.cell, bodies, options, run); },
      [&](const auto& supply) { return drop_and_roll_fill(recipe.cell, supply, options, run); });
}

PublishedLayerResult by_published_layer(const Recipe& recipe, const InclusionMix& mix,
                                        const RunContext& run) {
  const PublishedLayerOptions options{.spacing = recipe.published_advancing_layer.spacing,
                                      .top_layer = recipe.published_advancing_layer.top_layer};
  return place(
      recipe, mix,
      [&](const auto& bodies) {
        return published_advancing_layer_pack(recipe.cell, bodies, options, run);
      },
      [&](const auto& supply) {
        return published_advancing_layer_fill(recipe.cell, supply, options, run);
      });
}

// Where so much came last that the sizes are no longer spread evenly over the height.
std::string grading_sentence(const Recipe& recipe, double held_back) {
  constexpr double kMuch = 0.1;
  if (held_back <= kMuch || recipe.advancing_layer.held_back) return "";
  return "to place so much, the smallest inclusions, " + number_text(100.0 * held_back, 2) +
         " % by volume, came last: what the holes did not take of them gathers below the top; a "
         "smaller fraction spreads them evenly";
}

// Where the list ends far below the ceiling.
std::string empty_top_sentence(const Recipe& recipe, const AdvancingLayerResult& result) {
  constexpr double kMuch = 0.1;  // Over the height of the cell.
  const double height = recipe.cell.size[vertical_axis(recipe.cell)];
  if (result.stop != ConstructiveStop::target_reached || result.top >= (1.0 - kMuch) * height) {
    return "";
  }
  return "bodies are laid as densely as they come to lie, from the floor up: this order ends at " +
         number_text(result.top, 3) + " of the height " + number_text(height, 3) +
         ", and the cell is empty above; method = \"relaxation\" spreads so few evenly";
}

PackOutcome outcome_of(const Recipe& recipe, const InclusionMix& mix, ConstructiveResult result) {
  PackOutcome outcome;
  outcome.packing = std::move(result.packing);
  outcome.stop = name(result.stop);
  outcome.trials = result.tested;
  outcome.restarts = result.restarts;
  outcome.groups = compare_groups(recipe, mix, outcome.packing);
  outcome.target_reached = everything_stands(outcome.groups, result.stop == ConstructiveStop::full);
  return outcome;
}

}  // namespace

void refuse_unsuited(const Recipe& recipe, PackMethod method) {
  const bool drops = method == PackMethod::drop_and_roll;
  const bool published = method == PackMethod::published_advancing_layer;
  if (!drops && !published) return;
  for (const InclusionGroup& group : recipe.groups) {
    const bool flat = dimension(group.shape) == 2;
    if (drops ? is_round(group.shape) : flat) continue;
    refuse(recipe, method,
           std::string("it takes ") + (drops ? "disks and spheres" : "disks and ellipses") +
               ", and group \"" + group.name + "\" has the shape " +
               std::string(name(group.shape)) + "; method = \"advancing-layer\" takes every shape");
  }
  const std::size_t up = vertical_axis(recipe.cell);
  if (recipe.cell.periodic[up]) {
    refuse(recipe, method,
           std::string("it lays bodies upon a floor: allowed are cells with cell.periodic = false "
                       "along ") +
               "xyz"[up]);
  }
  if (published && recipe.min_gap > 0.0) refuse(recipe, method, "it keeps no packing.min_gap");
}

PackOutcome run_constructive(const Recipe& recipe, const InclusionMix& mix, PackMethod method,
                             const RunContext& run) {
  if (method == PackMethod::advancing_layer) {
    AdvancingLayerResult result = by_advancing_layer(recipe, mix, run);
    const std::string sentences[] = {grading_sentence(recipe, result.held_back),
                                     empty_top_sentence(recipe, result)};
    PackOutcome outcome = outcome_of(recipe, mix, std::move(result));
    for (const std::string& sentence : sentences) {
      if (!sentence.empty()) outcome.derived.push_back(sentence);
    }
    return outcome;
  }
  if (method == PackMethod::drop_and_roll) {
    return outcome_of(recipe, mix, by_dropping(recipe, mix, run));
  }
  PublishedLayerResult result = by_published_layer(recipe, mix, run);
  const PublishedLayerOutcome published{result.overlaps, result.first_row, result.pairs_tried};
  PackOutcome outcome = outcome_of(recipe, mix, std::move(result));
  outcome.published_layer = published;
  return outcome;
}

}  // namespace packstone::recipe
