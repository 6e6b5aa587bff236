#include "packstone/recipe/pack.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/version.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/images.hpp"
#include "recipe/draw_mix.hpp"

namespace packstone {
namespace {

RsaOptions rsa_options(const Recipe& recipe) {
  return {.min_gap = recipe.min_gap,
          .order = recipe.rsa.order,
          .redraw_orientation = recipe::redrawn_groups(recipe),
          .max_trials = recipe.rsa.max_trials,
          .max_restarts = recipe.rsa.max_restarts,
          .seed = recipe.seed};
}

// The bodies of the mix, then those of the open group, drawn in blocks.
class Supply {
 public:
  Supply(const Recipe& recipe, std::vector<OrderedBody> first, int open_group)
      : recipe_(recipe), first_(std::move(first)), open_group_(open_group) {}

  OrderedBody operator()(std::int64_t k) {
    const auto fixed = static_cast<std::int64_t>(first_.size());
    if (k < fixed) return first_[static_cast<std::size_t>(k)];
    const std::int64_t block = (k - fixed) / kBlock;
    if (block != block_) {
      drawn_ = draw_open_group(recipe_.cell, recipe_.groups[static_cast<std::size_t>(open_group_)],
                               open_group_, block * kBlock, kBlock, recipe_.seed);
      block_ = block;
    }
    return drawn_[static_cast<std::size_t>((k - fixed) % kBlock)];
  }

 private:
  static constexpr std::int64_t kBlock = 1024;

  const Recipe& recipe_;
  std::vector<OrderedBody> first_;
  int open_group_;
  std::int64_t block_ = -1;
  std::vector<OrderedBody> drawn_;
};

RsaResult run_rsa(const Recipe& recipe, const InclusionMix& mix, const RunContext& run) {
  const RsaOptions options = rsa_options(recipe);
  const auto open = std::find(mix.open_count.begin(), mix.open_count.end(), true);
  if (open == mix.open_count.end()) return rsa_pack(recipe.cell, mix.bodies, options, run);
  if (const double radius = recipe::saturating_radius(recipe); radius > 0.0) {
    return rsa_saturate(recipe.cell, radius, options, run);
  }
  std::vector<OrderedBody> first = mix.bodies;
  if (recipe.rsa.order == RsaOrder::largest_first) {
    std::stable_sort(first.begin(), first.end(), [](const OrderedBody& a, const OrderedBody& b) {
      return volume(a.body) > volume(b.body);
    });
  }
  const int open_group = static_cast<int>(open - mix.open_count.begin());
  Supply supply(recipe, std::move(first), open_group);
  return rsa_fill(
      recipe.cell, [&supply](std::int64_t k) { return supply(k); }, options, run);
}

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

std::vector<GroupOutcome> compare(const Recipe& recipe, const InclusionMix& mix,
                                  const Packing& packing) {
  const std::size_t count = recipe.groups.size();
  const std::vector<bool> redrawn = recipe::redrawn_groups(recipe);
  const auto ordered_tensors = tensors(mix.bodies, count);
  const auto reached_tensors = tensors(packing.inclusions, count);
  const double space = volume(recipe.cell);
  std::vector<GroupOutcome> outcomes(count);
  for (std::size_t g = 0; g < count; ++g) {
    outcomes[g].name = recipe.groups[g].name;
    outcomes[g].redrawn = !redrawn.empty() && redrawn[g];
    outcomes[g].ordered_tensor = ordered_tensors[g];
    outcomes[g].tensor = reached_tensors[g];
    if (reached_tensors[g]) {
      outcomes[g].order = orientation_order(*reached_tensors[g], recipe.cell.dimension);
    }
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
  for (GroupOutcome& outcome : outcomes) {
    // A group is of one shape: all of its inclusions have an axis, or none has.
    if (outcome.order) outcome.random_order = random_order(outcome.count, recipe.cell.dimension);
  }
  return outcomes;
}

// Whether everything with a count stands, and an open group ended because no more was found to fit.
bool everything_stands(const std::vector<GroupOutcome>& groups, RsaStop stop) {
  bool open = false;
  for (const GroupOutcome& group : groups) {
    if (group.ordered_count && group.count < *group.ordered_count) return false;
    open = open || !group.ordered_count;
  }
  return !open || stop == RsaStop::saturated || stop == RsaStop::given_up ||
         stop == RsaStop::target_reached;
}

void certify(const Recipe& recipe, const RunContext& run, PackOutcome& outcome) {
  // Not interrupted: whatever was reached is worth a certificate only when the check is complete.
  const RunContext whole = RunContext{}.threads(run.threads());
  outcome.packing.certificate = check_packing(outcome.packing, {.min_gap = recipe.min_gap}, whole);
  if (outcome.packing.certificate->passed()) return;
  outcome.target_reached = false;
  outcome.stop = "check_failed";
}

RunContext within_time(const Recipe& recipe, RunContext run) {
  if (!recipe.time_limit) return run;
  // A limit beyond a century is none; the clock could not hold it.
  constexpr double kCentury = 3e9;
  const std::chrono::duration<double> limit(std::min(*recipe.time_limit, kCentury));
  const auto end =
      RunContext::Clock::now() + std::chrono::duration_cast<RunContext::Clock::duration>(limit);
  return run.deadline(std::min(end, run.deadline()));
}

void check_recipe(const Recipe& recipe) {
  check_cell(recipe.cell);
  if (recipe.groups.empty()) throw InvalidArgument("groups: none given; allowed is 1 or more");
  if (const auto reason = why_no_least_gap(recipe.cell, recipe.min_gap)) {
    throw InvalidArgument("packing.min_gap = " + number_text(recipe.min_gap) + "; " + *reason);
  }
  if (recipe.time_limit && !(*recipe.time_limit > 0.0)) {
    throw InvalidArgument("time_limit = " + std::to_string(*recipe.time_limit) +
                          "; allowed is > 0");
  }
}

// What the summary says of groups whose saturation cannot be proven.
std::vector<std::string> limits_of_redrawing(const Recipe& recipe, const InclusionMix& mix) {
  const std::vector<bool> redrawn = recipe::redrawn_groups(recipe);
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

PackOutcome pack(const Recipe& recipe, RunContext run) {
  recipe::for_recipe(recipe, [&] { check_recipe(recipe); });
  run = within_time(recipe, run);
  const std::clock_t start = std::clock();
  const InclusionMix mix = recipe::draw_mix(recipe);
  RsaResult result = recipe::for_recipe(recipe, [&] { return run_rsa(recipe, mix, run); });

  PackOutcome outcome;
  outcome.packing = std::move(result.packing);
  outcome.packing.groups.clear();
  for (const InclusionGroup& group : recipe.groups) outcome.packing.groups.push_back(group.name);
  outcome.method = "rsa";
  outcome.method_reason =
      recipe.method == PackMethod::rsa ? "as ordered" : "auto: it places every shape";
  outcome.stop = name(result.stop);
  outcome.derived = mix.derived;
  for (std::string& sentence : limits_of_redrawing(recipe, mix)) {
    outcome.derived.push_back(std::move(sentence));
  }
  outcome.trials = result.trials;
  outcome.restarts = result.restarts;
  outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  outcome.groups = compare(recipe, mix, outcome.packing);
  outcome.target_reached = everything_stands(outcome.groups, result.stop);
  certify(recipe, run, outcome);
  outcome.packing.provenance = Provenance{.method = outcome.method,
                                          .stop = outcome.stop,
                                          .version = std::string(version()),
                                          .seed = recipe.seed,
                                          .seconds = outcome.seconds,
                                          .recipe_json = recipe_to_json(recipe)};
  return outcome;
}

}  // namespace packstone
