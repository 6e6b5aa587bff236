#pragma once

/// @file
/// One attempt: from a start to rest, or to where nothing helps.

#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "generate/relaxation/descent.hpp"
#include "generate/relaxation/overlap_energy.hpp"
#include "generate/relaxation/tensor_hold.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/run_context.hpp"

namespace packstone::relaxation {

/// Descends from the poses of `packing` on the energy of relaxation.hpp.
class Attempt {
 public:
  Attempt(const Packing& packing, const RelaxationOptions& options, std::int64_t number,
          int threads);

  /// To the end, or until `run` asks to stop.
  RelaxationStop run(RunContext& run);

  /// Of the state with the least energy.
  [[nodiscard]] Packing packing() const;
  [[nodiscard]] const Energy& energy() const { return best_energy_; }
  /// Adds what it has cost.
  void count_into(RelaxationReport& report) const;
  [[nodiscard]] std::vector<RelaxationSample> history() { return std::move(history_); }

 private:
  enum class Outcome { stepped, stuck };
  static constexpr double kMuch = 0.8, kSome = 0.97;  // What progress leaves of an energy.
  // Counts the steps since the energy was last brought down to `part` of what it was then.
  struct Watch {
    double part;
    double reference = 0.0;
    std::int64_t idle = 0;

    void begin(double energy) { *this = {part, energy, 0}; }
    void look(double energy) {
      ++idle;
      if (energy < part * reference) begin(energy);
    }
  };

  Energy evaluate(Motion& gradient);
  void start_anew();
  Outcome step();
  void find_direction();
  bool try_step(double length, Energy& energy);
  RelaxationStop descend(RunContext& run);
  void keep_best();
  void note();
  void report(RunContext& run);
  bool move_on();
  [[nodiscard]] bool is_slow() const;
  [[nodiscard]] bool is_stuck() const;
  [[nodiscard]] bool at_rest() const { return !(energy_.most_left > 1.0); }

  std::vector<std::int32_t> order_;  // Body k is inclusion order_[k] of the packing given.
  Packing shapes_;                   // In that order.
  const RelaxationOptions& options_;
  int threads_;
  Bodies bodies_;
  std::vector<TensorHold> holds_;
  OverlapEnergy overlap_;
  CurvatureMemory memory_;
  RandomStream random_;

  // Kept from step to step for their memory: fresh pages for all of them would take a sixth of the
  // time of a million bodies.
  std::vector<PosedBody> from_;
  Motion direction_, next_gradient_;

  Motion gradient_;
  Energy energy_;
  Watch slow_{kMuch};
  Watch stuck_{kSome};
  std::int64_t iterations_ = 0;
  std::int64_t relocated_ = 0;
  std::int64_t rounds_ = 0;           // Of relocation, without progress of the least energy.
  double least_at_relocation_ = 0.0;  // Least energy when bodies were last relocated.

  double start_left_ = 1.0;  // Energy::most_left at the start.
  Energy best_energy_;
  std::vector<PosedBody> best_;
  std::vector<RelaxationSample> history_;
  std::int64_t note_every_ = 1;
};

}  // namespace packstone::relaxation
