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

// What trials may cost, as parts of what the next means will cost. Measured: the times of small
// packings are flat around these.
constexpr double kPlainPerMask = 0.6;
constexpr double kFixedPerList = 3.0;
constexpr double kTurnedPerList = 30.0;  // Lists of poses that turn thin out slowly.

std::int64_t part_of(std::int64_t cost, double part) {
  return static_cast<std::int64_t>(part * static_cast<double>(cost));
}

// The same rod about another axis: all else of its outline stays.
template <class Rod>
Candidate turned_rod(const Candidate& candidate, Rod rod, const Vec3& axis) {
  rod.axis = axis;
  Candidate turned;
  turned.body = rod;
  turned.outline = candidate.outline;
  turned.outline.axis = axis;
  return turned;
}

}  // namespace

Turning turning_on_trial(const OrderedBody& ordered, const RsaOptions& options) {
  const auto group = static_cast<std::size_t>(ordered.group);
  const auto& redrawn = options.redraw_orientation;
  return turning_of(ordered.body, group < redrawn.size() && redrawn[group]);
}

Adsorption::Adsorption(const Cell& cell, const RsaOptions& options, const RunContext& run,
                       std::int64_t expected)
    : cell_(cell), options_(options), run_(run), placed_(cell, options.min_gap, expected) {}

void Adsorption::start(std::uint64_t key) {
  key_ = key;
  placed_.clear();
  list_.reset();
  mask_.reset();
}

Search Adsorption::place(const OrderedBody& ordered, std::int64_t item) {
  // Most bodies stand after a few trials, so that reading the clock for each would be felt.
  if (bodies_until_poll_-- == 0) {
    bodies_until_poll_ = 7;
    if (const StopRequest stop = run_.stop_request(); stop != StopRequest::none) {
      return as_search(stop);
    }
  }
  turning_ = turning_on_trial(ordered, options_);
  const Body body = in_standard_pose(ordered.body, turning_);
  const bool same = list_ && list_->turning() == turning_ && list_->body() == body;
  if (!same) list_.reset();
  if (candidate_.body != body || item_ < 0 || placed_.needs_extents()) {
    candidate_ = Candidate(body, placed_.needs_extents());
  }
  const double r = candidate_.outline.in_radius;
  domain_ = centers_inside_walls(
      cell_, turning_ == Turning::none ? candidate_.half_extents : Vec3{r, r, r});
  if (cell_.dimension == 2) domain_.lo.z = domain_.hi.z = 0.0;
  trials_in_row_ = 0;
  item_ = item;
  if (!same) {
    const Search search = search_without_list();
    if (search != Search::no_room) return search;
    const bool exact = mask_ && is_ball(candidate_.outline);
    list_.emplace(placed_, candidate_, turning_, exact ? &*mask_ : nullptr);
  }
  return try_vacancies(item);
}

// A center anywhere.
inline Vec3 Adsorption::draw_center(TrialNumbers::Row& numbers) const {
  const Vec3 &lo = domain_.lo, &hi = domain_.hi;
  const double u = numbers.uniform(), v = numbers.uniform(), w = numbers.uniform();
  return {std::min(lo.x + (hi.x - lo.x) * u, hi.x), std::min(lo.y + (hi.y - lo.y) * v, hi.y),
          std::min(lo.z + (hi.z - lo.z) * w, hi.z)};
}

Candidate Adsorption::draw_turned(TrialNumbers::Row& numbers) const {
  if (turning_ == Turning::none) return candidate_;
  if (!placed_.needs_extents() && turning_ == Turning::of_axis) {
    if (const auto* cylinder = std::get_if<Cylinder>(&candidate_.body)) {
      return turned_rod(candidate_, *cylinder, axis_at_random(numbers));
    }
  }
  return Candidate(turned_at_random(candidate_.body, turning_, numbers), placed_.needs_extents());
}

bool Adsorption::fits(const Vec3& center, TrialNumbers::Row& numbers, std::int64_t& cost) const {
  cost += Cost::trial;
  PlacedBodies::View view;
  if (!placed_.look_around(candidate_.outline, center, view, cost)) return false;
  if (turning_ == Turning::none) {
    return placed_.leaves_room_for(candidate_, center, view, cost);
  }
  const Candidate turned = draw_turned(numbers);
  cost += Cost::trial;
  return placed_.leaves_room_for(turned, center, view, cost) &&
         is_inside(centers_inside_walls(cell_, turned.half_extents), center, cell_.dimension) &&
         clears_own_images(cell_, turned, options_.min_gap);
}

// Trials at the centers that `draw` gives. Search::no_room here only means that they have cost
// enough.
template <class Draw>
Search Adsorption::try_centers(const TrialNumbers& numbers, std::int64_t budget, const Draw& draw) {
  const auto trial = [&](std::int64_t k, std::int64_t& cost) {
    TrialNumbers::Row row = numbers.trial(k);
    const Vec3 center = draw(row);
    return fits(center, row, cost);
  };
  const TrialRun outcome = run_trials(trials_in_row_, options_.max_trials, budget, run_, trial);
  return conclude(outcome, [&](std::int64_t k) {
    TrialNumbers::Row row = numbers.trial(k);
    const Vec3 center = wrapped(cell_, draw(row));
    placed_.add(draw_turned(row), center);
  });
}

Search Adsorption::try_anywhere(std::int64_t budget) {
  const TrialNumbers numbers(key_, StreamId::rsa_center, static_cast<std::uint64_t>(item_));
  return try_centers(numbers, budget, [&](TrialNumbers::Row& row) { return draw_center(row); });
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
  const double ball = candidate_.outline.in_radius;
  if (placed_.uses_grid()) {
    mask_.reset();
  } else if (!mask_ || !mask_->serves(ball, domain_)) {
    mask_.emplace(placed_, ball, domain_);
  }
  return mask_.has_value();
}

Search Adsorption::search_without_list() {
  Search search = try_anywhere(0);
  if (search != Search::no_room) return search;
  if (!prepare_mask()) return try_anywhere(plain_budget());
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
// poses and is cheap to split, it offers nothing that plain trials did not.
std::int64_t Adsorption::trial_budget() const {
  const std::int64_t split = list_->expected_split_cost();
  if (list_->part() > 0.5 && split < plain_budget() / 4) return 0;
  if (turning_ == Turning::none && mask_ && list_->part() > mask_->part()) return 0;
  const double worth = is_ball(candidate_.outline) ? 0.25 : 1.0;
  return part_of(split, worth * list_->kept_by_last_split());
}

std::int64_t Adsorption::mask_budget() const {
  if (turning_ != Turning::none) return part_of(plain_budget(), kTurnedPerList);
  if (!is_ball(candidate_.outline)) return part_of(plain_budget(), kFixedPerList);
  return mask_->size() * (Cost::trial + placed_.size() * Cost::pair);
}

// Plain trials may cost half of what a list of vacancies is likely to: a mean over those that
// were needed so far, or a guess. So the two together cost little more than the better one.
std::int64_t Adsorption::plain_budget() const {
  if (usual_list_cost_ > 0) return usual_list_cost_ / 2;
  const std::int64_t per_body = turning_ == Turning::none ? 2000 : 12000;
  return per_body * (10 + std::int64_t{placed_.size()});
}

}  // namespace packstone::rsa
