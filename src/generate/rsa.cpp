#include "packstone/generate/rsa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <string>

#include "generate/ordered_bodies.hpp"
#include "generate/rsa/adsorption.hpp"
#include "generate/rsa/equal_balls.hpp"
#include "generate/rsa/failed_starts.hpp"
#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/pose.hpp"
#include "generate/rsa/standing.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/shuffle.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {
namespace {

using rsa::Adsorption;
using rsa::PlacedBodies;
using rsa::Search;
using rsa::Turning;

void check_options(const Cell& cell, const RsaOptions& options) {
  check_min_gap(cell, options.min_gap, "RsaOptions");
  if (options.max_trials < 1) {
    throw InvalidArgument(
        fmt::format("RsaOptions::max_trials is {}; it must be >= 1", options.max_trials));
  }
  if (options.max_restarts < 0) {
    throw InvalidArgument(
        fmt::format("RsaOptions::max_restarts is {}; it must be >= 0", options.max_restarts));
  }
  if (options.order != RsaOrder::largest_first && options.order != RsaOrder::as_given &&
      options.order != RsaOrder::shuffled) {
    throw InvalidArgument(
        fmt::format("RsaOptions::order is {}; it must be largest_first, as_given or shuffled",
                    static_cast<int>(options.order)));
  }
}

// How a body may be turned by the trials.
Turn turn_of(const OrderedBody& ordered, const RsaOptions& options) {
  return rsa::turning_on_trial(ordered, options) != Turning::none ? Turn::any : Turn::as_given;
}

std::vector<std::int64_t> sequence_of(const std::vector<OrderedBody>& bodies,
                                      const RsaOptions& options) {
  std::vector<std::int64_t> sequence(bodies.size());
  std::iota(sequence.begin(), sequence.end(), 0);
  if (options.order == RsaOrder::largest_first) {
    std::vector<double> volumes;
    volumes.reserve(bodies.size());
    for (const OrderedBody& ordered : bodies) volumes.push_back(volume(ordered.body));
    std::stable_sort(sequence.begin(), sequence.end(), [&](std::int64_t a, std::int64_t b) {
      return volumes[static_cast<std::size_t>(a)] > volumes[static_cast<std::size_t>(b)];
    });
  } else if (options.order == RsaOrder::shuffled) {
    RandomStream random(options.seed, StreamId::rsa_order);
    shuffle(sequence, random);
  }
  return sequence;
}

// Every start has streams of its own; the first one those of the seed.
std::uint64_t key_of_start(std::uint64_t seed, std::int64_t start) {
  if (start == 0) return seed;
  constexpr std::uint64_t no_item = ~std::uint64_t{0};
  return RandomStream(seed, StreamId::rsa_center, no_item, static_cast<std::uint64_t>(start))
      .bits();
}

RsaStop stop_of(Search search) {
  switch (search) {
    case Search::placed:
      return RsaStop::target_reached;
    case Search::no_room:
      return RsaStop::saturated;
    case Search::given_up:
      return RsaStop::given_up;
    case Search::cancelled:
      return RsaStop::cancelled;
    case Search::out_of_time:
      break;
  }
  return RsaStop::out_of_time;
}

// The fullest state so far, in the order in which the bodies were given.
struct Kept {
  double volume = -1.0;
  RsaStop stop = RsaStop::target_reached;
  std::vector<Inclusion> inclusions;
};

// Of `count` bodies placed in the order of `sequence`; at(k) is where and how the k-th stands.
template <class At>
std::vector<Inclusion> in_given_order(std::int64_t count, const std::vector<OrderedBody>& bodies,
                                      const std::vector<std::int64_t>& sequence, const At& at) {
  std::vector<std::int32_t> placed_as(bodies.size(), -1);
  for (std::int64_t k = 0; k < count; ++k) {
    placed_as[static_cast<std::size_t>(sequence[static_cast<std::size_t>(k)])] =
        static_cast<std::int32_t>(k);
  }
  std::vector<Inclusion> inclusions;
  inclusions.reserve(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (placed_as[i] < 0) continue;
    const auto& [center, body] = at(placed_as[i]);
    inclusions.push_back({center, body, bodies[i].group});
  }
  return inclusions;
}

struct StandingBody {
  const Vec3& center;
  const Body& body;
};

bool is_interruption(RsaStop stop) {
  return stop == RsaStop::cancelled || stop == RsaStop::out_of_time;
}

// Many equal spheres or disks, not so few to the cell that a grid of their size would be a waste:
// these have a faster way of their own.
bool are_many_equal_balls(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  constexpr double sparsest = 0.02;  // Volume fraction.
  if (bodies.size() <= rsa::kMostSearchedOneByOne) return false;
  const Body& first = bodies.front().body;
  if (!is_round(kind(first))) return false;
  if (static_cast<double>(bodies.size()) * volume(first) < sparsest * volume(cell)) return false;
  return std::all_of(bodies.begin(), bodies.end(),
                     [&](const OrderedBody& ordered) { return ordered.body == first; });
}

rsa::FailedStarts no_failed_starts(const std::vector<OrderedBody>& bodies) {
  double total = 0.0;
  double largest = 0.0;
  for (const OrderedBody& ordered : bodies) {
    const double v = volume(ordered.body);
    total += v;
    largest = std::max(largest, v);
  }
  return {total, largest};
}

RsaResult pack_equal_balls(const Cell& cell, const std::vector<OrderedBody>& bodies,
                           const std::vector<std::int64_t>& sequence, const RsaOptions& options,
                           const RunContext& run) {
  const Body& ball = bodies.front().body;
  rsa::EqualBallsOrder order{.cell = cell,
                             .radius = circum_radius(ball),
                             .min_gap = options.min_gap,
                             .target = static_cast<std::int64_t>(bodies.size()),
                             .seed = options.seed};
  rsa::FailedStarts failed = no_failed_starts(bodies);
  RsaResult result;
  rsa::EqualBallsRun best;
  for (;; ++order.start) {
    rsa::EqualBallsRun balls = rsa::rsa_equal_balls(order, run);
    const RsaStop stop = balls.stop;
    result.trials += balls.trials;
    result.restarts = static_cast<std::int64_t>(order.start);
    failed.add(static_cast<double>(balls.centers.size()) * volume(ball));
    if (order.start == 0 || balls.centers.size() > best.centers.size()) best = std::move(balls);
    if (is_interruption(stop)) best.stop = stop;
    if (stop == RsaStop::target_reached || is_interruption(stop) ||
        result.restarts == options.max_restarts || failed.hopeless()) {
      break;
    }
  }
  result.stop = best.stop;
  result.packing.cell = cell;
  result.packing.inclusions = in_given_order(
      static_cast<std::int64_t>(best.centers.size()), bodies, sequence, [&](std::int64_t k) {
        return StandingBody{best.centers[static_cast<std::size_t>(k)], ball};
      });
  return result;
}

}  // namespace

std::string_view name(RsaStop stop) noexcept {
  constexpr std::string_view names[] = {"target_reached", "saturated", "given_up", "cancelled",
                                        "out_of_time"};
  return names[static_cast<int>(stop)];
}

RsaResult rsa_pack(const Cell& cell, const std::vector<OrderedBody>& bodies,
                   const RsaOptions& options, RunContext run) {
  check_cell(cell);
  check_options(cell, options);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    check_ordered(cell, bodies[k], static_cast<std::int64_t>(k));
    check_alone(cell, bodies[k], static_cast<std::int64_t>(k), options.min_gap,
                turn_of(bodies[k], options));
  }
  check_room(cell, bodies, options.min_gap);

  const std::vector<std::int64_t> sequence = sequence_of(bodies, options);
  if (are_many_equal_balls(cell, bodies)) {
    return pack_equal_balls(cell, bodies, sequence, options, run);
  }
  const auto count = static_cast<std::int64_t>(bodies.size());
  Adsorption adsorption(cell, options, run, bodies, sequence);
  rsa::FailedStarts failed = no_failed_starts(bodies);
  RsaResult result;
  Kept best;
  for (std::int64_t start = 0;; ++start) {
    adsorption.start(key_of_start(options.seed, start));
    Search search = Search::placed;
    double placed_volume = 0.0;
    for (std::int64_t k = 0; k < count && search == Search::placed;) {
      search =
          adsorption.place_next(bodies, std::span(sequence).subspan(static_cast<std::size_t>(k)));
      for (; k < adsorption.placed().size(); ++k) {
        const std::int64_t item = sequence[static_cast<std::size_t>(k)];
        placed_volume += volume(bodies[static_cast<std::size_t>(item)].body);
      }
      run.report({"adsorbing", static_cast<double>(k) / static_cast<double>(count),
                  placed_volume / volume(cell), k, count});
    }
    if (placed_volume > best.volume) {
      const PlacedBodies& placed = adsorption.placed();
      best = {placed_volume, stop_of(search),
              in_given_order(placed.size(), bodies, sequence, [&](std::int64_t k) {
                const auto i = static_cast<std::int32_t>(k);
                return StandingBody{placed.center(i), placed.body(i)};
              })};
    }
    result.restarts = start;
    failed.add(placed_volume);
    const bool interrupted = is_interruption(stop_of(search));
    if (interrupted) best.stop = stop_of(search);
    if (search == Search::placed || interrupted) break;
    if (start == options.max_restarts || failed.hopeless()) break;
  }
  result.packing.cell = cell;
  result.packing.inclusions = std::move(best.inclusions);
  result.stop = best.stop;
  result.trials = adsorption.trials();
  return result;
}

RsaResult rsa_fill(const Cell& cell, const BodySource& source, const RsaOptions& options,
                   RunContext run) {
  check_cell(cell);
  check_options(cell, options);
  Adsorption adsorption(cell, options, run, {}, {});
  adsorption.start(options.seed);
  RsaResult result;
  result.packing.cell = cell;
  double placed_volume = 0.0;
  Search search = Search::placed;
  for (std::int64_t k = 0; search == Search::placed; ++k) {
    const OrderedBody ordered = source(k);
    check_ordered(cell, ordered, k);
    const Turn turn = turn_of(ordered, options);
    if (k == 0) check_alone(cell, ordered, k, options.min_gap, turn);
    const bool hopeless = k > 0 && why_it_cannot_stand(cell, ordered.body, options.min_gap, turn);
    search = hopeless ? Search::no_room : adsorption.place(ordered, k);
    if (search != Search::placed) break;
    const PlacedBodies& placed = adsorption.placed();
    const auto last = placed.size() - 1;
    result.packing.inclusions.push_back({placed.center(last), placed.body(last), ordered.group});
    placed_volume += volume(ordered.body);
    run.report({"adsorbing", -1.0, placed_volume / volume(cell), k + 1, 0});
  }
  result.stop = stop_of(search);
  result.trials = adsorption.trials();
  return result;
}

}  // namespace packstone
