#include "recipe/rsa_start.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/geometry/measures.hpp"
#include "recipe/choose_method.hpp"
#include "recipe/run_rsa.hpp"

namespace packstone::recipe {
namespace {

// How far below what random sequential adsorption surely reaches a start stays, so that it takes
// little of the time.
constexpr double kEasyCrowding = 2.0 / 3.0;

double fraction_of(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += volume(b.body);
  return sum / volume(cell);
}

std::vector<OrderedBody> scaled_bodies(std::vector<OrderedBody> bodies, double factor) {
  for (OrderedBody& b : bodies) b.body = scaled(b.body, factor);
  return bodies;
}

}  // namespace

double start_factor(const Recipe& recipe, const std::vector<OrderedBody>& bodies,
                    const std::optional<double>& ordered, double most) {
  const double all = fraction_of(recipe.cell, bodies);
  const auto factor_at = [&](double fraction) {
    return std::min(1.0, std::pow(fraction / all, 1.0 / recipe.cell.dimension));
  };
  if (ordered) return factor_at(*ordered);
  double factor = factor_at(most);
  // Gaps do not shrink with the bodies: below some size nothing is won.
  for (int k = 0; k < 20; ++k, factor *= 0.9) {
    const std::vector<OrderedBody> smaller = scaled_bodies(bodies, factor);
    if (crowding(recipe.cell, smaller, recipe.min_gap, recipe.rsa.order) <= kEasyCrowding) break;
  }
  return factor;
}

RsaResult place_smaller(const Recipe& recipe, std::vector<OrderedBody> bodies, double factor,
                        std::uint64_t seed, const RunContext& run) {
  RsaOptions options = rsa_options(recipe);
  options.redraw_orientation.clear();
  options.seed = seed;
  return rsa_pack(recipe.cell, scaled_bodies(std::move(bodies), factor), options, run);
}

}  // namespace packstone::recipe
