#include "packstone/generate/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "generate/option_checks.hpp"
#include "generate/ordered_bodies.hpp"
#include "generate/relaxation/attempt.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"

namespace packstone {
namespace {

using relaxation::Attempt;

template <class Value>
void check_range(const char* field, Value value, bool allowed, const char* range) {
  check_option("RelaxationOptions", field, value, allowed, range);
}

void check_options(const Cell& cell, int groups, const RelaxationOptions& options) {
  check_min_gap(cell, options.min_gap, "RelaxationOptions");
  check_range("inflation", options.inflation, options.inflation > 0.0 && options.inflation <= 0.1,
              "(0, 0.1]");
  check_range("patience", options.patience, options.patience >= 1, ">= 1");
  check_range("relocated_share", options.relocated_share,
              options.relocated_share >= 0.0 && options.relocated_share <= 1.0, "[0, 1]");
  check_range("max_relocations", options.max_relocations, options.max_relocations >= 0, ">= 0");
  check_range("max_restarts", options.max_restarts, options.max_restarts >= 0, ">= 0");
  if (options.turn.empty() || static_cast<int>(options.turn.size()) >= groups) return;
  throw InvalidArgument(
      fmt::format("RelaxationOptions::turn has {} entries; allowed is one for "
                  "each of the {} groups, or none",
                  options.turn.size(), groups));
}

bool is_locked(const RelaxationOptions& options, int group) {
  return !options.turn.empty() &&
         options.turn[static_cast<std::size_t>(group)] == RelaxationTurn::locked;
}

void check_bodies(const Cell& cell, const std::vector<OrderedBody>& bodies,
                  const RelaxationOptions& options) {
  std::int64_t k = 0;
  for (const OrderedBody& ordered : bodies) {
    check_ordered(cell, ordered, k);
    // Turning, a body may come to stand where as given it could not.
    const Turn turn = is_locked(options, ordered.group) ? Turn::as_given : Turn::any;
    check_alone(cell, ordered, k, options.min_gap, turn);
    ++k;
  }
  check_room(cell, bodies, options.min_gap);
}

Vec3 random_center(const Cell& cell, std::size_t item, std::uint64_t seed, std::int64_t attempt) {
  RandomStream random(seed, StreamId::relaxation_centers, item,
                      static_cast<std::uint64_t>(attempt));
  Vec3 center;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    center[a] = wrapped(random.uniform(0.0, cell.size[a]), cell.size[a]);
  }
  return center;
}

// What `start` leaves open is random.
std::vector<Vec3> start_centers(const Cell& cell, std::size_t count,
                                const RelaxationOptions& options, std::int64_t attempt,
                                const RelaxationStart& start) {
  std::vector<Vec3> centers;
  if (start) centers = start(attempt);
  const std::size_t given = std::min(count, centers.size());
  centers.resize(count);
  for (std::size_t i = given; i < count; ++i) {
    centers[i] = random_center(cell, i, options.seed, attempt);
  }
  return centers;
}

// Attempt after attempt; keeps the best.
class Run {
 public:
  Run(const RelaxationOptions& options, RunContext run) : options_(options), run_(std::move(run)) {
    result_.report.energy = std::numeric_limits<double>::infinity();
  }

  // Returns whether there may be another attempt.
  bool attempt(const Packing& start, std::int64_t number) {
    Attempt attempt(start, options_, number, run_.threads());
    const RelaxationStop stop = attempt.run(run_);
    attempt.count_into(result_.report);
    result_.report.restarts = number;
    result_.stop = stop;
    result_.history = attempt.history();
    const bool better = attempt.energy().value < result_.report.energy;
    if (better || stop == RelaxationStop::target_reached) {
      result_.report.energy = attempt.energy().value;
      result_.report.deepest = attempt.energy().deepest;
      result_.packing = attempt.packing();
    }
    return stop == RelaxationStop::stalled;
  }

  RelaxationResult result() { return std::move(result_); }

 private:
  const RelaxationOptions& options_;
  RunContext run_;
  RelaxationResult result_;
};

}  // namespace

std::string_view name(RelaxationStop stop) noexcept {
  switch (stop) {
    case RelaxationStop::target_reached:
      return "target_reached";
    case RelaxationStop::stalled:
      return "stalled";
    case RelaxationStop::jammed:
      return "jammed";
    case RelaxationStop::cancelled:
      return "cancelled";
    case RelaxationStop::out_of_time:
      break;
  }
  return "out_of_time";
}

RelaxationResult relaxation_pack(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                 const RelaxationOptions& options, RunContext run,
                                 const RelaxationStart& start) {
  check_cell(cell);
  check_options(cell, group_count(bodies), options);
  check_bodies(cell, bodies, options);
  Run runs(options, std::move(run));
  for (std::int64_t number = 0; number <= options.max_restarts; ++number) {
    const std::vector<Vec3> centers = start_centers(cell, bodies.size(), options, number, start);
    if (!runs.attempt(packing_at(cell, bodies, centers), number)) break;
  }
  return runs.result();
}

RelaxationResult relax(const Packing& packing, const RelaxationOptions& options, RunContext run) {
  check_well_formed(packing);
  check_options(packing.cell, static_cast<int>(packing.groups.size()), options);
  Run runs(options, std::move(run));
  runs.attempt(packing, 0);
  return runs.result();
}

}  // namespace packstone
