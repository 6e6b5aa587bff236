#pragma once

/// @file
/// Places bodies one after another into one cell, each at the first trial that finds it room.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/plain_trials.hpp"
#include "generate/rsa/pose.hpp"
#include "generate/rsa/trial_block.hpp"
#include "generate/rsa/trials.hpp"
#include "generate/rsa/vacancy_list.hpp"
#include "generate/rsa/voxel_mask.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/rsa.hpp"

namespace packstone::rsa {

/// How a body is turned by its trials.
[[nodiscard]] Turning turning_on_trial(const OrderedBody& ordered, const RsaOptions& options);

/// How the search for a place for one body ended.
enum class Search { placed, no_room, given_up, cancelled, out_of_time };

/// How many bodies are placed together, where they are many. It has no part in where they come to
/// stand.
struct BlockSizes {
  std::int64_t least = 256;  ///< Fewer are placed one by one.
  std::int64_t share = 32;   ///< One body for so many that stand: few of a block meet each other.
  std::int64_t most = 16384;
  /// After a block that ended early, as near saturation, so many are placed one by one; twice as
  /// many each time that it happens again.
  std::int64_t pause = 256;
};

/// Places bodies one after another into one cell.
class Adsorption {
 public:
  /// For `bodies` placed in this order; or any, where `order` is empty.
  Adsorption(const Cell& cell, const RsaOptions& options, const RunContext& run,
             const std::vector<OrderedBody>& bodies, std::span<const std::int64_t> order,
             const BlockSizes& blocks = {});

  /// Forgets all bodies. `key` is that of the random streams of this start.
  void start(std::uint64_t key);

  /// Places body number `item` of the order.
  Search place(const OrderedBody& ordered, std::int64_t item);

  /// Places the next of `bodies` in the order `rest`, or several at once: to the bit what place()
  /// does for one after another. Tells by placed().size() how many.
  Search place_next(const std::vector<OrderedBody>& bodies, std::span<const std::int64_t> rest);

  [[nodiscard]] const PlacedBodies& placed() const { return placed_; }
  /// Over all starts.
  [[nodiscard]] std::int64_t trials() const { return trials_; }

 private:
  [[nodiscard]] bool has_list_for(const Body& body, Turning turning) const;
  Search place_block(const std::vector<OrderedBody>& bodies, std::span<const std::int64_t> items);
  [[nodiscard]] std::int64_t trials_never_given_up() const;
  template <class Draw>
  Search try_centers(const TrialNumbers& numbers, std::int64_t budget, const Draw& draw);
  Search search_without_list();
  Search try_anywhere(std::int64_t budget);
  bool prepare_mask();
  Search try_open_voxels();
  [[nodiscard]] std::int64_t mask_budget() const;
  Search try_vacancies(std::int64_t item);
  template <class Draw, class Trial>
  Search split_and_try(const Draw& draw, const Trial& trial);
  template <class Accept>
  Search conclude(const TrialRun& outcome, Accept&& accept);
  [[nodiscard]] std::int64_t trial_budget() const;
  [[nodiscard]] std::int64_t plain_budget(Turning turning) const;

  const Cell& cell_;
  const RsaOptions& options_;
  const RunContext& run_;
  PlacedBodies placed_;
  std::optional<VacancyList> list_;  // For on_trial_ and its like, when plain trials did not do.
  std::optional<VoxelMask> mask_;
  BodyOnTrial on_trial_;
  std::int64_t item_ = -1;  // Number of on_trial_.
  std::uint64_t key_ = 0;
  std::int64_t trials_ = 0;
  std::int64_t trials_in_row_ = 0;
  std::int64_t list_cost_ = 0;
  std::int64_t usual_list_cost_ = 0;
  int bodies_until_poll_ = 0;
  BlockSizes blocks_;
  std::int64_t pause_ = 0;  // Bodies to be placed one by one before the next block.
  std::int64_t next_pause_ = 0;
  TrialBlock block_;  // Of placed_.
};

}  // namespace packstone::rsa
