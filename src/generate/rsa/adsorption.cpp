#include "generate/rsa/adsorption.hpp"

#include <algorithm>
#include <limits>

#include "packstone/core/random.hpp"

namespace packstone::rsa {
namespace {

Search as_search(StopRequest request) {
  return request == StopRequest::cancelled ? Search::cancelled : Search::out_of_time;
}

constexpr std::int64_t kNoBudget = std::numeric_limits<std::int64_t>::max();

// What trials may cost: anywhere, as a part of what the mask will; in the mask, as a multiple of
// plain_budget(). Measured: the times of small packings are flat around these.
constexpr double kPlainPerMask = 0.6;
constexpr double kFixedInMask = 3.0;
constexpr double kTurnedInMask = 30.0;  // Lists of poses that turn thin out slowly.

std::int64_t part_of(std::int64_t cost, double part) {
  return static_cast<std::int64_t>(part * static_cast<double>(cost));
}

}  // namespace

Turning turning_on_trial(const OrderedBody& ordered, const RsaOptions& options) {
  const auto group = static_cast<std::size_t>(ordered.group);
  const auto& redrawn = options.redraw_orientation;
  return turning_of(ordered.body, group < redrawn.size() && redrawn[group]);
}

Adsorption::Adsorption(const Cell& cell, const RsaOptions& options, const RunContext& run,
                       const std::vector<OrderedBody>& bodies, std::span<const std::int64_t> order,
                       const BlockSizes& blocks)
    : cell_(cell),
      options_(options),
      run_(run),
      placed_(cell, options.min_gap, bodies, order),
      blocks_(blocks),
      block_(placed_) {}

void Adsorption::start(std::uint64_t key) {
  key_ = key;
  placed_.clear();
  list_.reset();
  mask_.reset();
  pause_ = 0;
  next_pause_ = blocks_.pause;
}

Search Adsorption::place(const OrderedBody& ordered, std::int64_t item) {
  // Most bodies stand after a few trials, so that reading the clock for each would be felt.
  if (bodies_until_poll_-- == 0) {
    bodies_until_poll_ = 7;
    if (const StopRequest stop = run_.stop_request(); stop != StopRequest::none) {
      return as_search(stop);
    }
  }
  const Turning turning = turning_on_trial(ordered, options_);
  const Body body = in_standard_pose(ordered.body, turning);
  const bool same = has_list_for(body, turning);
  if (!same) list_.reset();
  if (item_ < 0 || on_trial_.candidate.body != body || on_trial_.turning != turning ||
      placed_.needs_extents()) {
    on_trial_ = BodyOnTrial(placed_, body, turning);
  }
  trials_in_row_ = 0;
  item_ = item;
  if (!same) {
    const Search search = search_without_list();
    if (search != Search::no_room) return search;
    const bool exact = mask_ && is_ball(on_trial_.candidate.outline);
    list_.emplace(placed_, on_trial_.candidate, on_trial_.turning, exact ? &*mask_ : nullptr);
  }
  return try_vacancies(item);
}

Search Adsorption::place_next(const std::vector<OrderedBody>& bodies,
                              std::span<const std::int64_t> rest) {
  const std::int64_t item = rest.front();
  const OrderedBody& next = bodies[static_cast<std::size_t>(item)];
  const std::int64_t size =
      std::min({std::ssize(rest), placed_.size() / blocks_.share, blocks_.most});
  const Turning turning = turning_on_trial(next, options_);
  if (pause_ > 0 || size < blocks_.least || !placed_.uses_grid() ||
      has_list_for(in_standard_pose(next.body, turning), turning)) {
    pause_ = std::max<std::int64_t>(pause_ - 1, 0);
    return place(next, item);
  }
  return place_block(bodies, rest.first(static_cast<std::size_t>(size)));
}

// Ends before the first body whose plain trials might be given up: place() does it all over, and
// from there on the rest of the block may have to go another way.
Search Adsorption::place_block(const std::vector<OrderedBody>& bodies,
                               std::span<const std::int64_t> items) {
  list_.reset();
  block_.clear();
  for (const std::int64_t item : items) {
    const OrderedBody& ordered = bodies[static_cast<std::size_t>(item)];
    const Turning turning = turning_on_trial(ordered, options_);
    const BodyOnTrial body(placed_, in_standard_pose(ordered.body, turning), turning);
    block_.add(PlainTrials(body, key_, item));
  }
  const std::int64_t end = trials_never_given_up();
  block_.look_ahead(end, run_);
  if (const StopRequest stop = run_.stop_request(); stop != StopRequest::none) {
    return as_search(stop);
  }
  for (std::int64_t i = 0; i < block_.size(); ++i) {
    if (!block_.settle(i, end)) {
      pause_ = next_pause_;
      next_pause_ *= 2;
      const std::int64_t item = items[static_cast<std::size_t>(i)];
      return place(bodies[static_cast<std::size_t>(item)], item);
    }
    const auto& [trials, accepted, clear_of] = block_[i];
    TrialNumbers::Row row = trials.numbers.trial(accepted);
    const Vec3 center = wrapped(cell_, trials.body.draw_center(row));
    placed_.add(trials.body.draw_turned(placed_, row), center);
    trials_ += accepted + 1;
  }
  next_pause_ = blocks_.pause;
  return Search::placed;
}

// Trials that try_anywhere() would certainly evaluate for any of the next bodies, as long as no
// list of vacancies is needed.
std::int64_t Adsorption::trials_never_given_up() const {
  constexpr std::int64_t patience = 4096;
  const std::int64_t within_budget =
      kTrialsPerBlock *
      (plain_budget(Turning::none) / (kTrialsPerBlock * BodyOnTrial::kMostCostInGrid) + 1);
  return std::min({within_budget, options_.max_trials, patience});
}

bool Adsorption::has_list_for(const Body& body, Turning turning) const {
  return list_ && list_->turning() == turning && list_->body() == body;
}

// Trials at the centers that `draw` gives. Search::no_room here only means that they have cost
// enough.
template <class Draw>
Search Adsorption::try_centers(const TrialNumbers& numbers, std::int64_t budget, const Draw& draw) {
  const auto trial = [&](std::int64_t k, std::int64_t& cost) {
    TrialNumbers::Row row = numbers.trial(k);
    const Vec3 center = draw(row);
    return on_trial_.fits(placed_, center, row, cost);
  };
  const TrialRun outcome = run_trials(trials_in_row_, options_.max_trials, budget, run_, trial);
  return conclude(outcome, [&](std::int64_t k) {
    TrialNumbers::Row row = numbers.trial(k);
    const Vec3 center = wrapped(cell_, draw(row));
    placed_.add(on_trial_.draw_turned(placed_, row), center);
  });
}

Search Adsorption::try_anywhere(std::int64_t budget) {
  const TrialNumbers numbers(key_, StreamId::rsa_center, static_cast<std::uint64_t>(item_));
  return try_centers(numbers, budget,
                     [&](TrialNumbers::Row& row) { return on_trial_.draw_center(row); });
}

Search Adsorption::try_open_voxels() {
  mask_->notice_placed();
  if (mask_->size() == 0) return Search::no_room;
  const TrialNumbers numbers(key_, StreamId::rsa_voxel, static_cast<std::uint64_t>(item_));
  return try_centers(numbers, mask_budget(),
                     [&](TrialNumbers::Row& row) { return mask_->draw(row); });
}

// The mask for the candidate: that of the last body where it has the same inscribed ball.
bool Adsorption::prepare_mask() {
  const double ball = on_trial_.candidate.outline.in_radius;
  if (placed_.uses_grid()) {
    mask_.reset();
  } else if (!mask_ || !mask_->serves(ball, on_trial_.domain)) {
    mask_.emplace(placed_, ball, on_trial_.domain);
  }
  return mask_.has_value();
}

Search Adsorption::search_without_list() {
  Search search = try_anywhere(0);
  if (search != Search::no_room) return search;
  if (!prepare_mask()) return try_anywhere(plain_budget(on_trial_.turning));
  search = try_anywhere(part_of(mask_->expected_cost(), kPlainPerMask));
  return search == Search::no_room ? try_open_voxels() : search;
}

Search Adsorption::try_vacancies(std::int64_t item) {
  const TrialNumbers numbers(key_, StreamId::rsa_voxel, static_cast<std::uint64_t>(item));
  const auto draw = [&](std::int64_t k) { return list_->draw(numbers.trial(k)); };
  const auto trial = [&](std::int64_t k, std::int64_t& cost) { return list_->fits(draw(k), cost); };
  const Search search = split_and_try(draw, trial);
  if (list_cost_ > 0) usual_list_cost_ = (3 * usual_list_cost_ + list_cost_) / 4;
  list_cost_ = 0;
  return search;
}

template <class Draw, class Trial>
Search Adsorption::split_and_try(const Draw& draw, const Trial& trial) {
  while (list_->size() > 0) {
    const std::int64_t budget = list_->can_split() ? trial_budget() : kNoBudget;
    const TrialRun outcome = run_trials(trials_in_row_, options_.max_trials, budget, run_, trial);
    const Search search = conclude(outcome, [&](std::int64_t k) {
      const VacancyList::Pose pose = draw(k);
      placed_.add(list_->turned(pose), wrapped(cell_, pose.center));
      list_->add_last_placed();
    });
    if (search != Search::no_room) return search;
    list_cost_ += list_->split(run_);
    if (const StopRequest stop = run_.stop_request(); stop != StopRequest::none) {
      return as_search(stop);
    }
  }
  return Search::no_room;
}

template <class Accept>
Search Adsorption::conclude(const TrialRun& outcome, Accept&& accept) {
  trials_ += outcome.tried;
  trials_in_row_ += outcome.tried;
  if (outcome.accepted >= 0) {
    accept(outcome.accepted);
    return Search::placed;
  }
  if (outcome.stop != StopRequest::none) return as_search(outcome.stop);
  return trials_in_row_ >= options_.max_trials ? Search::given_up : Search::no_room;
}

// Trials before the next split get as much as the split will cost, times the part of the cells
// that splits keep: where splitting thins the list fast, trials can wait. Balls split so cheaply,
// and so surely come to a proof, that a quarter of it is best. As long as the list holds most
// poses and is cheap to split, or more than the mask does, it offers nothing that was not tried.
std::int64_t Adsorption::trial_budget() const {
  const std::int64_t split = list_->expected_split_cost();
  if (list_->part() > 0.5 && split < plain_budget(on_trial_.turning) / 4) return 0;
  if (on_trial_.turning == Turning::none && mask_ && list_->part() > mask_->part()) return 0;
  const double worth = is_ball(on_trial_.candidate.outline) ? 0.25 : 1.0;
  return part_of(split, worth * list_->kept_by_last_split());
}

// Balls: what it costs to make a list from the mask.
std::int64_t Adsorption::mask_budget() const {
  const std::int64_t plain = plain_budget(on_trial_.turning);
  if (on_trial_.turning != Turning::none) return part_of(plain, kTurnedInMask);
  if (!is_ball(on_trial_.candidate.outline)) return part_of(plain, kFixedInMask);
  return mask_->size() * (Cost::trial + placed_.size() * Cost::pair);
}

// Plain trials may cost half of what a list of vacancies is likely to: a mean over those that
// were needed so far, or a guess. So the two together cost little more than the better one.
std::int64_t Adsorption::plain_budget(Turning turning) const {
  if (usual_list_cost_ > 0) return usual_list_cost_ / 2;
  const std::int64_t per_body = turning == Turning::none ? 2000 : 12000;
  return per_body * (10 + std::int64_t{placed_.size()});
}

}  // namespace packstone::rsa
