#include "generate/relaxation/attempt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "generate/relaxation/relocation.hpp"
#include "spatial/curve_order.hpp"

namespace packstone::relaxation {
namespace {

std::vector<std::int32_t> order_of(const Packing& packing) {
  std::vector<Vec3> centers;
  centers.reserve(packing.inclusions.size());
  for (const Inclusion& inclusion : packing.inclusions) centers.push_back(inclusion.center);
  return curve_order(centers, packing.cell);
}

Packing in_order(const Packing& packing, const std::vector<std::int32_t>& order) {
  Packing result = packing;
  for (std::size_t k = 0; k < order.size(); ++k) {
    result.inclusions[k] = packing.inclusions[static_cast<std::size_t>(order[k])];
  }
  return result;
}

}  // namespace

Attempt::Attempt(const Packing& packing, const RelaxationOptions& options, std::int64_t number,
                 int threads)
    : order_(order_of(packing)),
      shapes_(in_order(packing, order_)),
      options_(options),
      threads_(threads),
      bodies_(bodies_of(shapes_, options)),
      holds_(tensor_holds(bodies_, shapes_, options)),
      overlap_(packing.cell, threads),
      memory_(threads),
      random_(options.seed, StreamId::relaxation_places, static_cast<std::uint64_t>(number)) {
  best_energy_.value = std::numeric_limits<double>::infinity();
  least_at_relocation_ = best_energy_.value;
}

Energy Attempt::evaluate(Motion& gradient) {
  const Energy energy = overlap_(bodies_, gradient);
  for (TensorHold& hold : holds_) {
    hold.look(bodies_);
    hold.project(bodies_, gradient);
  }
  return energy;
}

void Attempt::start_anew() {
  memory_.clear();
  energy_ = evaluate(gradient_);
  slow_.begin(energy_.value);
  stuck_.begin(energy_.value);
}

void Attempt::find_direction() {
  memory_.find_direction(gradient_, direction_);
  for (const TensorHold& hold : holds_) hold.project(bodies_, direction_);
}

// From `from_`, along the direction.
bool Attempt::try_step(double length, Energy& energy) {
  move(bodies_, from_, direction_, length);
  for (const TensorHold& hold : holds_) {
    if (!hold.restore(bodies_)) return false;
  }
  energy = evaluate(next_gradient_);
  return true;
}

// One step of the descent, as long as it lowers the energy (L. Armijo, Pacific J. Math. 16 (1966)
// 1-3).
Attempt::Outcome Attempt::step() {
  constexpr double kDecrease = 1e-4;
  constexpr int kMostHalvings = 12;
  find_direction();
  const double slope = inner_product(gradient_, direction_, threads_);
  double length = 1.0 / std::max(1.0, relative_step(bodies_, direction_));
  from_ = bodies_.posed;
  Energy energy;
  for (int halving = 0; slope < 0.0 && halving < kMostHalvings; ++halving, length *= 0.5) {
    if (!try_step(length, energy)) continue;
    if (!(energy.value <= energy_.value + kDecrease * length * slope)) continue;
    memory_.add(length, direction_, gradient_, next_gradient_);
    std::swap(gradient_, next_gradient_);
    energy_ = energy;
    return Outcome::stepped;
  }
  bodies_.posed = from_;
  if (memory_.empty()) return Outcome::stuck;
  memory_.clear();
  energy_ = evaluate(gradient_);
  slow_.idle += 10;
  stuck_.idle += 10;
  return Outcome::stepped;
}

void Attempt::keep_best() {
  if (!(energy_.value < best_energy_.value) && !at_rest()) return;
  best_energy_ = energy_;
  best_ = bodies_.posed;
}

void Attempt::note() {
  constexpr std::size_t kMostLines = 1000;
  if (iterations_ % note_every_ != 0) return;
  history_.push_back({iterations_, energy_.value, energy_.deepest, energy_.contacts});
  if (history_.size() < kMostLines) return;
  for (std::size_t k = 0; k < kMostLines / 2; ++k) history_[k] = history_[2 * k];
  history_.resize(kMostLines / 2);
  note_every_ *= 2;
}

// Depths shrink by a factor in so many steps: what is done is told by their logarithm.
void Attempt::report(RunContext& run) {
  constexpr double kAlmost = 0.999;
  const double all = std::log(std::max(start_left_, 1.0 + 1e-9));
  const double left = std::log(std::max(energy_.most_left, 1.0));
  const double done = std::clamp(1.0 - left / all, 0.0, kAlmost);
  run.report({"relaxing", done, fraction(shapes_), 0, 0});
}

// Early on the next round of relocation brings more than the rest of a descent; where rounds have
// not helped, descents are given longer.
bool Attempt::is_slow() const { return slow_.idle > options_.patience * (1 + rounds_ / 3); }

bool Attempt::is_stuck() const { return stuck_.idle > 3 * options_.patience; }

// Moves some bodies elsewhere. False: there is none to be moved, or that has not helped.
bool Attempt::move_on() {
  if (std::min(best_energy_.value, energy_.value) < kSome * least_at_relocation_) rounds_ = 0;
  if (rounds_ >= options_.max_relocations || options_.relocated_share == 0.0) return false;
  ++rounds_;
  keep_best();
  least_at_relocation_ = std::min(least_at_relocation_, best_energy_.value);
  evaluate(gradient_);
  const std::int64_t moved =
      relocate(bodies_, shapes_.cell, overlap_.pushes(), options_.relocated_share, random_);
  relocated_ += moved;
  if (moved == 0) return false;
  start_anew();
  return true;
}

RelaxationStop Attempt::run(RunContext& run) {
  start_anew();
  note();
  const RelaxationStop stop = descend(run);
  keep_best();
  return stop;
}

RelaxationStop Attempt::descend(RunContext& run) {
  start_left_ = energy_.most_left;
  while (!at_rest()) {
    report(run);
    const StopRequest request = run.stop_request();
    if (request == StopRequest::cancelled) return RelaxationStop::cancelled;
    if (request == StopRequest::out_of_time) return RelaxationStop::out_of_time;
    const Outcome outcome = step();
    ++iterations_;
    note();
    slow_.look(energy_.value);
    stuck_.look(energy_.value);
    const bool stuck = is_stuck() || outcome == Outcome::stuck;
    if (at_rest() || !(stuck || is_slow())) continue;
    if (!move_on() && stuck) return RelaxationStop::stalled;
  }
  return RelaxationStop::target_reached;
}

Packing Attempt::packing() const {
  Bodies bodies = bodies_;
  bodies.posed = best_;
  const Packing ordered = packing_of(bodies, shapes_);
  Packing result = ordered;
  for (std::size_t k = 0; k < order_.size(); ++k) {
    result.inclusions[static_cast<std::size_t>(order_[k])] = ordered.inclusions[k];
  }
  return result;
}

void Attempt::count_into(RelaxationReport& report) const {
  report.iterations += iterations_;
  report.evaluations += overlap_.evaluations();
  report.neighbor_searches += overlap_.searches();
  report.relocated += relocated_;
}

}  // namespace packstone::relaxation
