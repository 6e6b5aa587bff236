#include "recipe/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "packstone/core/number_text.hpp"
#include "packstone/geometry/measures.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/rod_order.hpp"

namespace packstone::recipe {
namespace {

using std::numbers::pi;

// Aspect x, and the fraction times x up to which rods of random directions come to rest before
// neighbors line up: up to 3 by growth, from 5 on by relaxation. Between these, linear.
constexpr std::array<std::pair<double, double>, 6> kRods{
    {{1.0, 0.72}, {3.0, 1.92}, {5.0, 3.0}, {10.0, 4.6}, {20.0, 6.2}, {50.0, 7.0}}};

double ceiling_at_random(double aspect) {
  if (aspect <= kRods.front().first) return kRods.front().second;
  const auto* const above = std::find_if(kRods.begin() + 1, kRods.end(),
                                         [&](const auto& p) { return aspect <= p.first; });
  if (above == kRods.end()) return kRods.back().second / aspect;
  const auto& [x0, f0] = *(above - 1);
  const auto& [x1, f1] = *above;
  return (f0 + (f1 - f0) * (aspect - x0) / (x1 - x0)) / aspect;
}

// Of rods, where a single aspect says how they pack.
std::optional<double> ceiling_of_rods(const std::vector<OrderedBody>& bodies) {
  constexpr double kWidest = 1.5;  // Over the thinnest.
  const auto by_radius = [](const OrderedBody& a, const OrderedBody& b) {
    return rod_sizes(a.body).first < rod_sizes(b.body).first;
  };
  const auto [thin, thick] = std::minmax_element(bodies.begin(), bodies.end(), by_radius);
  const RodOrder rods = *rod_order(bodies);
  const bool flat = kind(bodies.front().body) == ShapeKind::cylinder && rods.aspect < 1.0;
  const double thinnest = rod_sizes(thin->body).first, thickest = rod_sizes(thick->body).first;
  if (thickest > kWidest * thinnest || flat) return std::nullopt;
  // Contacts of ends know no directions: of short rods they are most.
  constexpr double kLong = 20.0;
  const double part = std::min(1.0, rods.aspect / kLong);
  return std::min(ceiling_at_random(rods.aspect) / std::pow(rods.crossing, part),
                  pi / std::sqrt(12.0));
}

bool all_equal(const std::vector<OrderedBody>& bodies) {
  constexpr double kRounding = 1e-9;
  const auto alike = [](double a, double b) { return std::abs(a - b) <= kRounding * b; };
  const Body& first = bodies.front().body;
  return std::all_of(bodies.begin(), bodies.end(), [&](const OrderedBody& b) {
    return alike(volume(b.body), volume(first)) && alike(surface(b.body), surface(first));
  });
}

// Microseconds for a body, of balls, other bodies without edges, rods: measured with one thread at
// middle fractions.
struct Costs {
  double balls, smooth, rods;
};
constexpr Costs kAdsorption{5.0, 10.0, 25.0};
constexpr Costs kRelaxation{3.0, 15.0, 30.0};
constexpr Costs kGrowth{8.0, 25.0, 400.0};
constexpr Costs kJamming{2e3, 5e4, 1e6};
constexpr Costs kRelaxedJamming{5e4, 1e5, 1e5};
constexpr Costs kCollision{1.0, 4.0, 15.0};
// In the plane, and in space.
constexpr Costs kFlatLayer{15.0, 500.0, 500.0};
constexpr Costs kLayer{200.0, 4e3, 1e4};
constexpr Costs kDropping{10.0, 10.0, 10.0};
constexpr Costs kPublishedLayer{40.0, 3e3, 3e3};

// Of all bodies, in seconds.
double total(const Costs& costs, const std::vector<OrderedBody>& bodies) {
  double sum = 0.0;
  for (const OrderedBody& ordered : bodies) {
    const ShapeKind shape = kind(ordered.body);
    sum += is_round(shape) ? costs.balls : is_rod(shape) ? costs.rods : costs.smooth;
  }
  return 1e-6 * sum;
}

// The crowding of equal spheres at 0.64.
constexpr double kMostCrowded = 4.2;

// How near to the densest random packing the order is: at 1 there is no way on.
double nearness(const PackPlan& plan, double crowded) {
  const double known = plan.reachable ? plan.fraction / *plan.reachable : 0.0;
  return std::max(known, std::min(crowded / kMostCrowded, 0.95));
}

std::optional<double> growth_seconds(const Recipe& recipe, const InclusionMix& mix, double near) {
  const EventDrivenSettings& settings = recipe.event_driven;
  if (settings.goal == EventDrivenGoal::densest) return total(kJamming, mix.bodies);
  if (near >= 1.0) return std::nullopt;
  const double growth = total(kGrowth, mix.bodies) / (1.0 - near);
  if (settings.goal == EventDrivenGoal::target) return growth;
  return growth + settings.collisions_per_body * total(kCollision, mix.bodies);
}

std::optional<double> seconds_for(const Recipe& recipe, const InclusionMix& mix, PackMethod method,
                                  double crowded, double near) {
  switch (method) {
    case PackMethod::rsa:
      if (crowded <= 1.0) return total(kAdsorption, mix.bodies);
      break;
    case PackMethod::relaxation:
      if (is_any_size(recipe, method)) return total(kRelaxedJamming, mix.bodies);
      if (near < 1.0) return total(kRelaxation, mix.bodies) / (1.0 - near);
      break;
    case PackMethod::advancing_layer:
      return total(recipe.cell.dimension == 2 ? kFlatLayer : kLayer, mix.bodies);
    case PackMethod::drop_and_roll:
      return total(kDropping, mix.bodies);
    case PackMethod::published_advancing_layer:
      return total(kPublishedLayer, mix.bodies);
    case PackMethod::event_driven:
      return growth_seconds(recipe, mix, near);
    default:
      break;
  }
  return std::nullopt;
}

std::string warning_for(const PackPlan& plan, PackMethod method, double crowded) {
  constexpr double kSaturated = 1.4;  // crowding of equal spheres at 0.38
  if (method == PackMethod::rsa && crowded > kSaturated) {
    return "rsa never moves what it placed, and saturates before such a fraction; method = "
           "\"auto\" goes further";
  }
  if (method == PackMethod::rsa || !plan.reachable || plan.fraction <= *plan.reachable) return "";
  return "fraction " + number_text(plan.fraction, 3) + " is above the " +
         number_text(*plan.reachable, 3) +
         " that random packings of such inclusions are known to reach; they get there in order, "
         "as in a crystal, or not at all";
}

}  // namespace

std::optional<double> random_ceiling(const std::vector<OrderedBody>& bodies) {
  if (bodies.empty()) return std::nullopt;
  const ShapeKind shape = kind(bodies.front().body);
  const bool one_kind = std::all_of(bodies.begin(), bodies.end(),
                                    [&](const OrderedBody& b) { return kind(b.body) == shape; });
  if (!one_kind) return std::nullopt;
  if (is_rod(shape)) return ceiling_of_rods(bodies);
  if (!all_equal(bodies)) return std::nullopt;
  switch (shape) {
    case ShapeKind::sphere:
      return 0.64;
    case ShapeKind::disk:
      return 0.84;
    case ShapeKind::ellipse:
      return 0.90;
    default:
      return 0.74;
  }
}

PackPlan plan_of(const Recipe& recipe, const InclusionMix& mix, const MethodChoice& choice) {
  PackPlan plan;
  plan.method = name(choice.method);
  plan.method_reason = choice.reason;
  plan.count = static_cast<std::int64_t>(mix.bodies.size());
  plan.fraction = fraction_with_gaps(recipe.cell, mix.bodies, recipe.min_gap);
  const bool open =
      std::find(mix.open_count.begin(), mix.open_count.end(), true) != mix.open_count.end();
  if (open) return plan;
  plan.reachable = random_ceiling(mix.bodies);
  const double crowded =
      choice.crowded ? *choice.crowded
                     : (crowding(recipe.cell, mix.bodies, recipe.min_gap, recipe.rsa.order));
  const double near = nearness(plan, crowded);
  plan.seconds = seconds_for(recipe, mix, choice.method, crowded, near);
  if (!is_any_size(recipe, choice.method)) {
    plan.warning = warning_for(plan, choice.method, crowded);
  }
  return plan;
}

}  // namespace packstone::recipe
