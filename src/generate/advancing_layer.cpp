#include "packstone/generate/advancing_layer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "generate/advancing_layer/attempt.hpp"
#include "generate/option_checks.hpp"
#include "generate/ordered_bodies.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {
namespace {

using advancing_layer::attempt;
using advancing_layer::Held;
using advancing_layer::kSampled;
using advancing_layer::Placement;
using advancing_layer::Plan;
using advancing_layer::plan_for;

void check_request(const Cell& cell, const AdvancingLayerOptions& options) {
  constexpr const char* kName = "AdvancingLayerOptions";
  check_cell(cell);
  check_min_gap(cell, options.min_gap, kName);
  check_option(kName, "top_layer", options.top_layer,
               options.top_layer >= 2.0 && std::isfinite(options.top_layer), ">= 2");
  const int candidates = options.candidates.value_or(1);
  check_option(kName, "candidates", candidates, candidates >= 1, ">= 1");
  const double held = options.held_back.value_or(0.0);
  check_option(kName, "held_back", held, held >= 0.0 && held <= 1.0, "[0, 1]");
  check_option(kName, "max_restarts", options.max_restarts, options.max_restarts >= 0, ">= 0");
}

void check_bodies(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto number = static_cast<std::int64_t>(k);
    check_ordered(cell, bodies[k], number);
    check_alone(cell, bodies[k], number, min_gap, Turn::as_given);
  }
  check_room(cell, bodies, min_gap);
}

ConstructiveStop stop_of(const Placement& placement) {
  if (placement.stop == StopRequest::cancelled) return ConstructiveStop::cancelled;
  if (placement.stop == StopRequest::out_of_time) return ConstructiveStop::out_of_time;
  return placement.missing > 0.0 ? ConstructiveStop::full : ConstructiveStop::target_reached;
}

AdvancingLayerResult result_of(const Cell& cell, const std::vector<OrderedBody>& bodies,
                               const Placement& placement) {
  AdvancingLayerResult result;
  result.packing.cell = cell;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!placement.centers[k]) continue;
    result.packing.inclusions.push_back({*placement.centers[k], bodies[k].body, bodies[k].group});
  }
  result.top = placement.top;
  result.stop = stop_of(placement);
  return result;
}

// The first attempt that places all, or the last one.
AdvancingLayerResult place_all(const Cell& cell, const std::vector<OrderedBody>& bodies, Plan plan,
                               std::int64_t max_restarts, RunContext& run) {
  constexpr double kMostHeld = 0.3;  // More was never denser.
  std::int64_t tests = 0;
  for (std::int64_t k = 0;; ++k) {
    const bool is_last = k == max_restarts;
    const Placement placed =
        attempt(cell, bodies, plan, static_cast<std::uint64_t>(k), is_last, run);
    tests += placed.tests;
    const bool done = placed.missing == 0.0 || placed.hopeless || is_last;
    if (!done && placed.stop == StopRequest::none) {
      if (plan.held == Held::smallest) {
        plan.held_back =
            std::max(plan.held_back, std::min(kMostHeld, plan.held_back * plan.held_back_growth));
      }
      plan.held = Held::smallest;
      continue;
    }
    AdvancingLayerResult result = result_of(cell, bodies, placed);
    result.tested = tests;
    result.restarts = k;
    result.held_back = plan.held == Held::sample ? kSampled : plan.held_back;
    return result;
  }
}

// The first bodies of a supply.
class Prefix {
 public:
  Prefix(const Cell& cell, const BodySource& source, double min_gap)
      : cell_(cell), source_(source), min_gap_(min_gap) {}

  // As many as come nearest to this volume, one at least; fewer where one could not stand at all.
  std::vector<OrderedBody> of_volume(double wanted) {
    while (ends_.empty() || (ends_.back() < wanted && !ended_)) draw();
    const auto past = std::lower_bound(ends_.begin(), ends_.end(), wanted);
    const auto count = std::max<std::ptrdiff_t>(1, past - ends_.begin());
    return {drawn_.begin(), drawn_.begin() + count};
  }

 private:
  void draw() {
    const auto k = static_cast<std::int64_t>(drawn_.size());
    const OrderedBody next = source_(k);
    check_ordered(cell_, next, k);
    const auto why = why_it_cannot_stand(cell_, next.body, min_gap_, Turn::as_given);
    if (why && k == 0) check_alone(cell_, next, k, min_gap_, Turn::as_given);
    ended_ = why.has_value();
    if (ended_) return;
    ends_.push_back((ends_.empty() ? 0.0 : ends_.back()) + volume(next.body));
    drawn_.push_back(next);
  }

  const Cell& cell_;
  const BodySource& source_;
  double min_gap_;
  std::vector<OrderedBody> drawn_;
  std::vector<double> ends_;  // Volume of the bodies up to and with each.
  bool ended_ = false;
};

// One run over more bodies than there is room for, until the first that finds no place.
AdvancingLayerResult fill_open(const Cell& cell, Prefix& prefix,
                               const AdvancingLayerOptions& options, RunContext& run) {
  const std::vector<OrderedBody> bodies = prefix.of_volume(volume(cell));
  Plan plan = plan_for(options, bodies);
  plan.in_order = true;
  return place_all(cell, bodies, plan, 0, run);
}

// Looks for the number of bodies that all find a place.
AdvancingLayerResult fill_closed(const Cell& cell, Prefix& prefix,
                                 const AdvancingLayerOptions& options, RunContext& run) {
  constexpr int kMostRuns = 8;
  // A single order that fails says little, and more restarts hold back more.
  constexpr std::int64_t kFewRestarts = 1;
  constexpr double kNarrow = 1e-3;
  constexpr double kStep = 0.01;
  // Volume of the supply over that of the cell: what all fits, and what does not.
  double fits = 0.0;
  double fails = 1.0;
  double next = cell.dimension == 2 ? 0.85 : 0.65;
  AdvancingLayerResult best;
  best.packing.cell = cell;
  std::int64_t tested = 0;
  for (int k = 0; k < kMostRuns && fails - fits > kNarrow; ++k) {
    const std::vector<OrderedBody> bodies = prefix.of_volume(next * volume(cell));
    AdvancingLayerResult result = place_all(cell, bodies, plan_for(options, bodies),
                                            std::min(kFewRestarts, options.max_restarts), run);
    tested += result.tested;
    const double placed = fraction(result.packing);
    const ConstructiveStop stop = result.stop;
    const bool all = stop == ConstructiveStop::target_reached;
    if (all || fits == 0.0) best = std::move(result);
    best.restarts = k;
    best.stop = all ? ConstructiveStop::full : stop;
    if (best.stop != ConstructiveStop::full) break;
    (all ? fits : fails) = next;
    next = fits == 0.0    ? std::min(placed, next - 2.0 * kNarrow)
           : fails == 1.0 ? fits + kStep
                          : 0.5 * (fits + fails);
  }
  best.tested = tested;
  return best;
}

}  // namespace

AdvancingLayerResult advancing_layer_pack(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                          const AdvancingLayerOptions& options, RunContext run) {
  check_request(cell, options);
  check_bodies(cell, bodies, options.min_gap);
  if (bodies.empty()) {
    AdvancingLayerResult nothing;
    nothing.packing.cell = cell;
    return nothing;
  }
  return place_all(cell, bodies, plan_for(options, bodies), options.max_restarts, run);
}

AdvancingLayerResult advancing_layer_fill(const Cell& cell, const BodySource& source,
                                          const AdvancingLayerOptions& options, RunContext run) {
  check_request(cell, options);
  Prefix prefix(cell, source, options.min_gap);
  return options.close_top ? fill_closed(cell, prefix, options, run)
                           : fill_open(cell, prefix, options, run);
}

}  // namespace packstone
