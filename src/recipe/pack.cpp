#include "packstone/recipe/pack.hpp"

#include <ctime>
#include <limits>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/version.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/images.hpp"
#include "recipe/choose_method.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/estimate.hpp"
#include "recipe/run_constructive.hpp"
#include "recipe/run_event_driven.hpp"
#include "recipe/run_relaxation.hpp"
#include "recipe/run_rsa.hpp"
#include "recipe/run_time_driven.hpp"

namespace packstone {
namespace {

using recipe::MethodChoice;

void certify(const Recipe& recipe, const RunContext& run, PackOutcome& outcome) {
  // Not interrupted: whatever was reached is worth a certificate only when the check is complete.
  const RunContext whole = RunContext{}.threads(run.threads());
  outcome.packing.certificate = check_packing(outcome.packing, {.min_gap = recipe.min_gap}, whole);
  if (outcome.packing.certificate->passed()) return;
  outcome.deepest_crossing = deepest_crossing(outcome.packing);
  // Of a relaxation that has not come to its end the certificate says what still overlaps, and of
  // published advancing layers what their circles have missed.
  if (outcome.published_layer) outcome.target_reached = false;
  const bool relaxed = outcome.relaxation || outcome.time_driven || outcome.published_layer;
  if (relaxed && !outcome.target_reached) return;
  outcome.target_reached = false;
  outcome.stop = "check_failed";
}

RunContext within_time(const Recipe& recipe, RunContext run) {
  if (!recipe.time_limit) return run;
  return run.time_limit(*recipe.time_limit);
}

void check_recipe(const Recipe& recipe) {
  check_cell(recipe.cell);
  if (recipe.groups.empty()) throw InvalidArgument("groups: none given; allowed is 1 or more");
  if (const auto reason = why_no_least_gap(recipe.cell, recipe.min_gap)) {
    throw InvalidArgument("packing.min_gap = " + number_text(recipe.min_gap) + "; " + *reason);
  }
  if (recipe.time_limit && !(*recipe.time_limit > 0.0)) {
    throw InvalidArgument("time_limit = " + std::to_string(*recipe.time_limit) +
                          "; allowed is > 0");
  }
}

// Processor time [s]. With one thread that of the calling thread, beside which others may work.
double processor_time(int threads) {
  timespec now{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// One run of a recipe: what was drawn, who is to pack it, and since when.
class Run {
 public:
  Run(const Recipe& recipe, RunContext run, double seconds_before)
      : recipe_(recipe),
        threads_(run.threads()),
        start_(processor_time(threads_) - seconds_before) {
    recipe::for_recipe(recipe, [&] { check_recipe(recipe); });
    run_ = within_time(recipe, std::move(run));
    mix_ = recipe::draw_mix(recipe);
  }

  // Chooses the method; refuses what is impossible.
  const PackPlan& plan() {
    choice_ = recipe::for_recipe(recipe_, [&] { return recipe::choose_method(recipe_, mix_); });
    recipe::refuse_impossible(recipe_, mix_, choice_.method);
    recipe::refuse_unsuited(recipe_, choice_.method);
    plan_ = recipe::plan_of(recipe_, mix_, choice_);
    return plan_;
  }

  // As planned.
  PackOutcome from_the_start(const Checkpointing& checkpointing) {
    return recipe::for_recipe(recipe_, [&] {
      if (choice_.method == PackMethod::rsa) return recipe::run_rsa(recipe_, mix_, run_);
      if (choice_.method == PackMethod::relaxation) return relaxed(checkpointing);
      if (choice_.method == PackMethod::time_driven) {
        return recipe::run_time_driven(recipe_, mix_, run_);
      }
      if (recipe::is_constructive(choice_.method)) {
        return recipe::run_constructive(recipe_, mix_, choice_.method, run_);
      }
      return recipe::run_event_driven(recipe_, mix_, run_, named(checkpointing));
    });
  }

  // By relaxation, or where that stalls and the choice was left to us, by growth.
  PackOutcome relaxed(const Checkpointing& checkpointing) {
    constexpr std::int64_t kFewRestarts = 3;
    constexpr std::int64_t kAny = std::numeric_limits<std::int64_t>::max();
    PackOutcome outcome =
        recipe::run_relaxation(recipe_, mix_, run_, choice_.may_grow ? kFewRestarts : kAny);
    if (!choice_.may_grow || outcome.stop != name(RelaxationStop::stalled)) return outcome;
    choice_ = {PackMethod::event_driven, "auto: relaxations stalled"};
    return recipe::run_event_driven(recipe_, mix_, run_, named(checkpointing));
  }

  PackOutcome from(MovingPacking checkpoint, const Checkpointing& checkpointing) {
    choice_ = {PackMethod::event_driven, "from a checkpoint"};
    recipe::refuse_impossible(recipe_, mix_, choice_.method);
    return recipe::for_recipe(recipe_, [&] {
      return recipe::continue_event_driven(recipe_, mix_, std::move(checkpoint), run_,
                                           named(checkpointing));
    });
  }

  // Adds what does not depend on the method.
  PackOutcome finish(PackOutcome outcome) const {
    outcome.packing.groups = recipe::group_names(recipe_);
    outcome.method = name(choice_.method);
    outcome.method_reason = choice_.reason;
    outcome.plan = plan_;
    outcome.derived.insert(outcome.derived.begin(), mix_.derived.begin(), mix_.derived.end());
    outcome.seconds = seconds();
    certify(recipe_, run_, outcome);
    if (recipe::is_constructive(choice_.method) && !outcome.packing.inclusions.empty()) {
      outcome.density = measure_density(outcome.packing, {}, RunContext{}.threads(threads_));
    }
    outcome.packing.provenance = provenance(outcome.stop, outcome.seconds);
    return outcome;
  }

 private:
  [[nodiscard]] double seconds() const { return processor_time(threads_) - start_; }

  [[nodiscard]] Provenance provenance(const std::string& stop, double seconds_so_far) const {
    return {.method = std::string(name(choice_.method)),
            .stop = stop,
            .version = std::string(version()),
            .seed = recipe_.seed,
            .seconds = seconds_so_far,
            .recipe_json = recipe_to_json(recipe_)};
  }

  // States on the way leave with the names of their groups and with their origin.
  [[nodiscard]] Checkpointing named(const Checkpointing& checkpointing) const {
    if (!checkpointing.write) return checkpointing;
    return {checkpointing.every_seconds, [&](const MovingPacking& state) {
              MovingPacking complete = state;
              complete.packing.groups = recipe::group_names(recipe_);
              complete.packing.provenance = provenance("checkpoint", seconds());
              checkpointing.write(complete);
            }};
  }

  const Recipe& recipe_;
  RunContext run_;
  int threads_;
  double start_;
  InclusionMix mix_;
  MethodChoice choice_;
  PackPlan plan_;
};

}  // namespace

PackOutcome pack(const Recipe& recipe, RunContext run, const Checkpointing& checkpointing,
                 const PlanCallback& on_plan) {
  Run one(recipe, std::move(run), 0.0);
  const PackPlan& plan = one.plan();
  if (on_plan) on_plan(plan);
  return one.finish(one.from_the_start(checkpointing));
}

PackPlan plan_pack(const Recipe& recipe) { return Run(recipe, {}, 0.0).plan(); }

PackOutcome resume_pack(const Recipe& recipe, MovingPacking checkpoint, RunContext run,
                        const Checkpointing& checkpointing) {
  const auto& provenance = checkpoint.packing.provenance;
  Run one(recipe, std::move(run), provenance ? provenance->seconds : 0.0);
  return one.finish(one.from(std::move(checkpoint), checkpointing));
}

}  // namespace packstone
