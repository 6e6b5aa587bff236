#include "recipe/rsa_start.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/geometry/measures.hpp"
#include "recipe/choose_method.hpp"
#include "recipe/rod_order.hpp"
#include "recipe/run_rsa.hpp"

namespace packstone::recipe {
namespace {

// How far from what random sequential adsorption surely reaches a start stays, so that it takes
// little of the time. Trials with long rods are cheap, and overlaps of these go away the more
// easily the fewer there are. What counts for them is how many of those that stand one would meet:
// six, of which crowding() takes a root of what one excludes, in volumes of its own.
double easy_crowding(const std::vector<OrderedBody>& bodies) {
  constexpr double kOfOthers = 2.0 / 3.0, kOfLongRods = 1.8, kShort = 2.0, kLong = 20.0;
  const std::optional<RodOrder> rods = rod_order(bodies);
  if (!rods) return kOfOthers;
  const double part = std::clamp((rods->aspect - kShort) / (kLong - kShort), 0.0, 1.0);
  const double x = rods->aspect;
  const double of_rods = kOfLongRods / std::pow(1.0 + 0.25 * x, 0.2);
  // What two spherocylinders exclude, over pi D^3 / 2 (L. Onsager, Ann. N. Y. Acad. Sci. 51 (1949)
  // 627-659), at random over as they are.
  const double at_random = x * x + 4.0 * x + 8.0 / 3.0;
  const double as_are = x * x * rods->crossing + 4.0 * x + 8.0 / 3.0;
  return (kOfOthers + part * (of_rods - kOfOthers)) * (at_random / as_are);
}

double fraction_of(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += volume(b.body);
  return sum / volume(cell);
}

}  // namespace

double start_factor(const Recipe& recipe, const std::vector<OrderedBody>& bodies,
                    const std::optional<double>& ordered, double most) {
  const double all = fraction_of(recipe.cell, bodies);
  const auto factor_at = [&](double fraction) {
    return std::min(1.0, std::pow(fraction / all, 1.0 / recipe.cell.dimension));
  };
  if (ordered) return factor_at(*ordered);
  const double easy = easy_crowding(bodies);
  const auto is_easy = [&](double factor) {
    const std::vector<OrderedBody> smaller = scaled(bodies, factor);
    return crowding(recipe.cell, smaller, recipe.min_gap, recipe.rsa.order) <= easy;
  };
  double high = factor_at(most);
  if (is_easy(high)) return high;
  // Gaps do not shrink with the bodies: below some size nothing is won.
  double low = 0.1 * high;
  for (int k = 0; k < 8; ++k) {
    const double middle = 0.5 * (low + high);
    (is_easy(middle) ? low : high) = middle;
  }
  return low;
}

SmallerPlaced place_smaller(const Recipe& recipe, const std::vector<OrderedBody>& bodies,
                            double factor, bool ordered, std::uint64_t seed,
                            const RunContext& run) {
  constexpr std::int64_t kMostTrials = 10'000;
  constexpr double kSmaller = 0.95;
  constexpr int kMostTries = 20;
  RsaOptions options = rsa_options(recipe);
  options.redraw_orientation.clear();
  options.seed = seed;
  if (!ordered) {
    options.max_trials = std::min(options.max_trials, kMostTrials);
    options.max_restarts = 0;
  }
  SmallerPlaced result;
  for (int k = 0; k < kMostTries; ++k, factor *= kSmaller) {
    result = {rsa_pack(recipe.cell, scaled(bodies, factor), options, run), factor};
    const RsaStop stop = result.rsa.stop;
    if (ordered || (stop != RsaStop::given_up && stop != RsaStop::saturated)) break;
  }
  return result;
}

}  // namespace packstone::recipe
