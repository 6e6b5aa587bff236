#pragma once

/// @file
/// What the modes of bench_event_driven share. Their lines: "# ..." is for people; all others begin
/// with the name of the mode and hold words and numbers parted by blanks, "-" where there is none.

#include <cstdint>
#include <string>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "timing.hpp"

namespace packstone::benchmarks {

/// Largest memory of this process so far [MB]; 0 where the system does not tell.
[[nodiscard]] long peak_megabytes();

/// Slope of the straight line through (ln x, ln y) of least squares; 0 for less than two points.
[[nodiscard]] double log_slope(const std::vector<double>& x, const std::vector<double>& y);

/// `value` by a fmt specification such as "9.4f"; "-" of the same width where it is not positive.
[[nodiscard]] std::string or_dash(double value, const char* specification, int width);

/// A run and the verdict on it.
struct Growth {
  EventDrivenResult result;
  double seconds = 0.0;  ///< Processor time of the run alone [s].
  bool passed = false;   ///< check_packing(), called here.
  std::uint64_t hash = 0;
};

/// Packs with one thread, until limit_s [s] of processor time are gone.
[[nodiscard]] Growth grow(const Cell& cell, const std::vector<OrderedBody>& bodies,
                          const EventDrivenOptions& options, double limit_s = 1e9);

/// Some seeds of one order.
struct GrowthStatistics {
  std::vector<double> seconds;
  std::vector<double> collisions;
  int reached = 0;         ///< Runs that reached the target with a certificate that passed.
  std::uint64_t hash = 0;  ///< Of all runs.

  void add(const Growth& growth);
  [[nodiscard]] double slowest() const;
};

/// A fluid at equilibrium.
struct Fluid {
  EventDrivenResult result;
  double seconds = 0.0;  ///< Processor time of the last stretch alone [s].
};

/// Grows `bodies` to the sizes ordered, lets them collide 50 times each, and goes on for
/// `collisions_per_body` from there, which is what is measured and timed.
[[nodiscard]] Fluid equilibrium(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                double collisions_per_body, std::uint64_t seed);

// The modes. Each prints and returns whether all packings passed.
bool run_table_2(int seeds);
bool run_figures(int seeds);
bool run_curves(int seeds, int most);
bool run_scaling(std::int64_t largest);
bool run_rates(int seeds);
bool run_densest(double seconds, const std::string& only, std::uint64_t seed);
bool run_physics(int realizations);
bool run_alignment(int realizations);
bool run_reference(int seeds, double limit_s);

}  // namespace packstone::benchmarks
