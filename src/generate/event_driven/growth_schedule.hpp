#pragma once

/// @file
/// How fast bodies grow, from block to block of events, and when growing on is of no use.
///
/// Growth rates are d(size factor)/dt times the mean radius, over the thermal velocity [-].

#include "generate/event_driven/run_state.hpp"
#include "packstone/generate/event_driven.hpp"

namespace packstone::event_driven {

/// What a block of events has brought.
struct BlockGain {
  double log_fraction = 0.0;  ///< By which the logarithm of the fraction has risen [-].
  double collisions = 0.0;    ///< Per body.
  double growth_rate = 0.0;   ///< Of the block.
  double pressure = 0.0;      ///< Reduced.
};

/// The rates of a run whose bodies fill the fraction `full` at size factor 1.
class GrowthSchedule {
 public:
  GrowthSchedule(const EventDrivenOptions& options, double full, int dimension)
      : options_(options), full_(full), dimension_(dimension) {}

  /// Up to this size factor the gas is dilute: hardly any bodies meet, and they may grow faster.
  [[nodiscard]] double dilute_until() const;

  /// Collisions per body of the next block.
  [[nodiscard]] double block_collisions(const Progressed& at) const;

  /// Growth rate of the next block, from a size factor on.
  [[nodiscard]] double rate(const Progressed& at, double size) const;

  /// Sets the growth rate of `at` to what comes after a block. Returns whether the bodies are
  /// jammed.
  bool slow_down(Progressed& at, const BlockGain& gain) const;

 private:
  const EventDrivenOptions& options_;
  double full_;
  int dimension_;
};

}  // namespace packstone::event_driven
