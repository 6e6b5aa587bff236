#include "packstone/generate/relaxed_growth.hpp"

#include <cmath>
#include <utility>

#include "generate/option_checks.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

void check_range(const char* field, double value, bool allowed, const char* range) {
  check_option("RelaxedGrowthOptions", field, value, allowed, range);
}

void check_options(const RelaxedGrowthOptions& options) {
  check_range("start_factor", options.start_factor,
              options.start_factor > 0.0 && std::isfinite(options.start_factor), "> 0");
  check_range("first_step", options.first_step,
              options.first_step > 0.0 && options.first_step <= 1.0, "(0, 1]");
  check_range("least_step", options.least_step,
              options.least_step > 0.0 && options.least_step <= options.first_step,
              "(0, first_step]");
}

Packing scaled_packing(Packing packing, double factor) {
  for (Inclusion& inclusion : packing.inclusions) inclusion.body = scaled(inclusion.body, factor);
  return packing;
}

void add(const RelaxationReport& report, RelaxationReport& sum) {
  sum.restarts += report.restarts;
  sum.iterations += report.iterations;
  sum.evaluations += report.evaluations;
  sum.neighbor_searches += report.neighbor_searches;
  sum.relocated += report.relocated;
}

// Relaxation after relaxation; keeps the last state at rest.
class Growth {
 public:
  Growth(const Cell& cell, const RelaxedGrowthOptions& options, RunContext run)
      : cell_(cell), options_(options), run_(std::move(run)) {}

  // Smaller and smaller, until they come to rest for the first time. Returns whether they do.
  bool begin(const std::vector<OrderedBody>& bodies, const RelaxationStart& start) {
    constexpr int kMostHalvings = 20;
    double factor = options_.start_factor;
    for (int k = 0; k <= kMostHalvings; ++k, factor *= factor_of(0.5)) {
      take(relaxation_pack(cell_, scaled(bodies, factor), options_.relaxation, run_, start),
           factor);
      if (result_.at_rest) return true;
      if (result_.stop != RelaxationStop::stalled) return false;
    }
    return false;
  }

  // Ends with the reason in result_.stop.
  void grow() {
    double step = options_.first_step;
    while (step >= options_.least_step) {
      const double factor = factor_of(1.0 + step);
      RelaxationResult next =
          relax(scaled_packing(result_.packing, factor), options_.relaxation, run_);
      const RelaxationStop stop = next.stop;
      if (stop == RelaxationStop::stalled) step *= 0.5;
      take(std::move(next), result_.size_factor * factor);
      if (stop == RelaxationStop::cancelled || stop == RelaxationStop::out_of_time) return;
    }
    result_.stop = RelaxationStop::jammed;
  }

  RelaxedGrowthResult result() { return std::move(result_); }

 private:
  // Of lengths, for one of volumes; of areas in the plane.
  [[nodiscard]] double factor_of(double volumes) const {
    return std::pow(volumes, 1.0 / cell_.dimension);
  }

  // What is not at rest replaces nothing that is.
  void take(RelaxationResult next, double size_factor) {
    const bool at_rest = next.stop == RelaxationStop::target_reached;
    add(next.report, result_.report);
    result_.stop = next.stop;
    result_.history = std::move(next.history);
    if (result_.at_rest && !at_rest) return;
    result_.at_rest = at_rest;
    result_.packing = std::move(next.packing);
    result_.size_factor = size_factor;
    result_.report.energy = next.report.energy;
    result_.report.deepest = next.report.deepest;
  }

  Cell cell_;
  const RelaxedGrowthOptions& options_;
  RunContext run_;
  RelaxedGrowthResult result_;
};

}  // namespace

RelaxedGrowthResult grow_relaxed(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                 const RelaxedGrowthOptions& options, RunContext run,
                                 const RelaxationStart& start) {
  check_cell(cell);
  check_options(options);
  Growth growth(cell, options, std::move(run));
  if (growth.begin(bodies, start)) growth.grow();
  return growth.result();
}

}  // namespace packstone
