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
  const bool same = list_ && list_->turning() == turning && list_->body() == ordered.body;
  if (!same) list_.reset();
  candidate_ = Candidate(ordered.body, placed_.needs_extents());
  trials_in_row_ = 0;
  if (!same) {
    const Search plain = try_anywhere(turning, item);
    if (plain != Search::no_room) return plain;
    list_.emplace(placed_, candidate_, turning);
  }
  return try_vacancies(item);
}

// A center anywhere.
Vec3 Adsorption::draw_center(const CenterBox& box, TrialNumbers::Row numbers) const {
  Vec3 center{0, 0, 0};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell_.dimension); ++axis) {
    const double length = box.hi[axis] - box.lo[axis];
    center[axis] = std::min(box.lo[axis] + length * numbers.uniform(), box.hi[axis]);
  }
  return wrapped(cell_, center);
}

Candidate Adsorption::draw_turned(Turning turning, std::int64_t item, std::int64_t k) const {
  RandomStream random(key_, StreamId::rsa_orientation, static_cast<std::uint64_t>(item),
                      static_cast<std::uint64_t>(k));
  return Candidate(turned_at_random(candidate_.body, turning, random), placed_.needs_extents());
}

// Search::no_room here only means that plain trials have cost enough.
Search Adsorption::try_anywhere(Turning turning, std::int64_t item) {
  const bool turns = turning != Turning::none;
  const double r = candidate_.outline.in_radius;
  const auto box = centers_inside_walls(cell_, turns ? Vec3{r, r, r} : candidate_.half_extents);
  const TrialNumbers numbers(key_, StreamId::rsa_center, static_cast<std::uint64_t>(item));
  const auto trial = [&](std::int64_t k, std::int64_t& cost) {
    cost += Cost::trial;
    const Vec3 center = draw_center(box, numbers.trial(k));
    PlacedBodies::Nearby nearby;
    if (!placed_.look_around(candidate_.outline, center, nearby, cost)) return false;
    if (!turns) return placed_.leaves_room_for(candidate_, center, nearby, cost);
    const double ball = candidate_.outline.in_radius;
    if (!placed_.ball_leaves_room(ball, center, nearby, cost)) return false;
    const Candidate turned = draw_turned(turning, item, k);
    cost += Cost::trial;
    return placed_.leaves_room_for(turned, center, nearby, cost) &&
           is_inside(centers_inside_walls(cell_, turned.half_extents), center, cell_.dimension) &&
           clears_own_images(cell_, turned, options_.min_gap);
  };
  const TrialRun outcome = run_trials(0, options_.max_trials, plain_budget(turning), run_, trial);
  return conclude(outcome, [&](std::int64_t k) {
    const Vec3 center = draw_center(box, numbers.trial(k));
    placed_.add(turns ? draw_turned(turning, item, k) : candidate_, center);
  });
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
  if (list_->part() > 0.5 && split < plain_budget(list_->turning()) / 4) return 0;
  const double worth = is_ball(candidate_.outline) ? 0.25 : 1.0;
  return static_cast<std::int64_t>(worth * static_cast<double>(split) *
                                   list_->kept_by_last_split());
}

// Plain trials may cost half of what a list of vacancies is likely to: a mean over those that
// were needed so far, or a guess. So the two together cost little more than the better one.
std::int64_t Adsorption::plain_budget(Turning turning) const {
  if (usual_list_cost_ > 0) return usual_list_cost_ / 2;
  const std::int64_t per_body = turning == Turning::none ? 1000 : 6000;
  return per_body * (10 + std::int64_t{placed_.size()});
}

}  // namespace packstone::rsa
