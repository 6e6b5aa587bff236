#include "generate/rsa/trial_block.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#include "packstone/core/parallel.hpp"

namespace packstone::rsa {

// The trial of one member on its way through the steps of PlacedBodies.
class TrialBlock::InFlight {
 public:
  InFlight() = default;
  InFlight(const PlacedBodies& placed, Member& member) : placed_(&placed), member_(&member) {
    begin();
  }

  // Takes the next step. False: there is none, the member has its trial or has come to `end`.
  // `view` is not used where the grid is searched.
  bool advance(std::int64_t end, PlacedBodies::View& view) {
    const PlainTrials& trials = member_->trials;
    const Outline& outline = trials.body.candidate.outline;
    switch (step_) {
      case Step::look_at_home:
        if (!placed_->look_at_home(outline, center_)) return reject(end);
        placed_->expect_look_around(outline, center_);
        step_ = Step::look_around;
        return true;
      case Step::look_around:
        if (!placed_->look_around(outline, center_, view, cost_)) return reject(end);
        placed_->expect_search(trials.body.candidate.half_extents, center_);
        step_ = Step::search;
        return true;
      case Step::search:
        break;
    }
    TrialNumbers::Row row = trials.behind_center(member_->next);
    if (!trials.body.fits_closely(*placed_, center_, view, row, cost_)) return reject(end);
    member_->clear_of = placed_->size();
    return false;
  }

 private:
  enum class Step { look_at_home, look_around, search };

  void begin() {
    center_ = member_->trials.center(member_->next);
    placed_->expect_look_at_home(center_);
    step_ = Step::look_at_home;
  }

  bool reject(std::int64_t end) {
    if (++member_->next == end) return false;
    begin();
    return true;
  }

  const PlacedBodies* placed_ = nullptr;
  Member* member_ = nullptr;
  Vec3 center_;
  Step step_ = Step::look_at_home;
  std::int64_t cost_ = 0;  // Nobody asks for it.
};

void TrialBlock::look_ahead(std::int64_t end, const RunContext& run) {
  constexpr std::int64_t grain = 64;
  // The first member found to come to `end`: what stands behind it is not asked for any more.
  std::atomic<std::int64_t> first_stuck = size();
  parallel_for(size(), run.threads(), grain, [&](std::int64_t from, std::int64_t to) {
    for (; from < to && from < first_stuck.load(); from += grain) {
      if (run.stop_request() != StopRequest::none) return;
      std::int64_t stuck = size();
      look_ahead(from, std::min(from + grain, to), end, stuck);
      std::int64_t known = first_stuck.load();
      while (stuck < known && !first_stuck.compare_exchange_weak(known, stuck)) {
      }
    }
  });
}

// The same for some members, on one thread; `stuck` becomes the lowest one that came to `end`.
void TrialBlock::look_ahead(std::int64_t first, std::int64_t last, std::int64_t end,
                            std::int64_t& stuck) {
  constexpr std::size_t most = 8;
  PlacedBodies::View view{};
  std::array<InFlight, most> flights;
  std::array<std::int64_t, most> members;
  std::size_t count = 0;
  const auto start_next = [&](std::size_t k) {
    while (first < last && first < stuck) {
      const std::int64_t i = first++;
      if (member(i).next >= end) {
        stuck = std::min(stuck, i);
        continue;
      }
      flights[k] = InFlight(placed_, member(i));
      members[k] = i;
      return true;
    }
    return false;
  };
  while (count < most && start_next(count)) ++count;
  while (count > 0) {
    for (std::size_t k = 0; k < count;) {
      if (members[k] < stuck && flights[k].advance(end, view)) {
        ++k;
        continue;
      }
      if (member(members[k]).next >= end) stuck = std::min(stuck, members[k]);
      if (start_next(k)) continue;
      --count;
      flights[k] = flights[count];
      members[k] = members[count];
    }
  }
}

bool TrialBlock::settle(std::int64_t i, std::int64_t end) {
  // The member whose turn comes soon.
  constexpr std::int64_t ahead = 4;
  if (i + ahead < size()) {
    const Member& soon = member(i + ahead);
    placed_.expect_search(soon.trials.body.candidate.half_extents, soon.trials.center(soon.next));
  }
  Member& current = member(i);
  for (; current.next < end; ++current.next, current.clear_of = 0) {
    std::int64_t cost = 0;
    TrialNumbers::Row row = current.trials.numbers.trial(current.next);
    const Vec3 center = current.trials.body.draw_center(row);
    if (current.trials.body.fits(placed_, center, row, cost, current.clear_of)) return true;
  }
  return false;
}

}  // namespace packstone::rsa
