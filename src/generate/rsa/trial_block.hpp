#pragma once

/// @file
/// Trials of many bodies at once, so that they wait for the memory together.

#include <cstdint>
#include <vector>

#include "generate/rsa/plain_trials.hpp"
#include "packstone/core/run_context.hpp"

namespace packstone::rsa {

/// The next bodies of the order, each with the first trial that may still be accepted. For bodies
/// that are searched with the grid.
///
/// Bodies that stand never move. So a trial that one of them rejects is rejected for good, whatever
/// is placed before its turn comes, and may be evaluated ahead of its turn. What is left for the
/// turn itself is to compare the trial with the bodies placed since.
///
/// Trials lead to random places, and in large packings most of their time goes into waiting for
/// memory. So each thread keeps the trials of some bodies in flight, takes one after the other a
/// step further, and asks the memory for what its next step will read: O. Kocberber, B. Falsafi,
/// B. Grot, Proc. VLDB Endow. 9 (2015) 252-263.
class TrialBlock {
 public:
  /// A body of the block.
  struct Member {
    PlainTrials trials;
    std::int64_t next = 0;      ///< All trials before this one are rejected.
    std::int32_t clear_of = 0;  ///< Bodies of lower number are known not to reject it.
  };

  explicit TrialBlock(const PlacedBodies& placed) : placed_(placed) {}

  void clear() { members_.clear(); }
  void add(const PlainTrials& trials) { members_.push_back({trials}); }

  [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(members_.size()); }
  [[nodiscard]] const Member& operator[](std::int64_t i) const {
    return members_[static_cast<std::size_t>(i)];
  }

  /// Advances members to the first trial that all bodies that stand let pass, on any number of
  /// threads. A member that would need trial number `end` is left there, and those behind it may be
  /// left anywhere before. So may all, when `run` asks to stop.
  void look_ahead(std::int64_t end, const RunContext& run);

  /// Advances member `i` to the first trial that all bodies that stand let pass. False: that would
  /// be number `end` or a later one.
  bool settle(std::int64_t i, std::int64_t end);

 private:
  class InFlight;

  Member& member(std::int64_t i) { return members_[static_cast<std::size_t>(i)]; }
  void look_ahead(std::int64_t first, std::int64_t last, std::int64_t end, std::int64_t& stuck);

  const PlacedBodies& placed_;
  std::vector<Member> members_;
};

}  // namespace packstone::rsa
