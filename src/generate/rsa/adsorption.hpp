#pragma once

/// @file
/// Places bodies one after another into one cell, each at the first trial that finds it room.

#include <cstdint>
#include <optional>

#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/pose.hpp"
#include "generate/rsa/standing.hpp"
#include "generate/rsa/trial_numbers.hpp"
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

/// Places bodies one after another into one cell.
class Adsorption {
 public:
  /// @param expected  Bodies that will be placed, as far as known.
  Adsorption(const Cell& cell, const RsaOptions& options, const RunContext& run,
             std::int64_t expected);

  /// Forgets all bodies. `key` is that of the random streams of this start.
  void start(std::uint64_t key);

  /// Places body number `item` of the order.
  Search place(const OrderedBody& ordered, std::int64_t item);

  [[nodiscard]] const PlacedBodies& placed() const { return placed_; }
  /// Over all starts.
  [[nodiscard]] std::int64_t trials() const { return trials_; }

 private:
  [[nodiscard]] Vec3 draw_center(TrialNumbers::Row& numbers) const;
  [[nodiscard]] Candidate draw_turned(TrialNumbers::Row& numbers) const;
  [[nodiscard]] bool fits(const Vec3& center, TrialNumbers::Row& numbers, std::int64_t& cost) const;
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
  [[nodiscard]] std::int64_t plain_budget() const;

  const Cell& cell_;
  const RsaOptions& options_;
  const RunContext& run_;
  PlacedBodies placed_;
  std::optional<VacancyList> list_;  // For candidate_ and its like, when plain trials did not do.
  std::optional<VoxelMask> mask_;
  Candidate candidate_;
  std::int64_t item_ = -1;           // Number of candidate_.
  Turning turning_ = Turning::none;  // Of candidate_.
  CenterBox domain_;                 // Where its center may be.
  std::uint64_t key_ = 0;
  std::int64_t trials_ = 0;
  std::int64_t trials_in_row_ = 0;
  std::int64_t list_cost_ = 0;
  std::int64_t usual_list_cost_ = 0;
  int bodies_until_poll_ = 0;
};

}  // namespace packstone::rsa
