#include "packstone/generate/drop_and_roll.hpp"

#include <fmt/format.h>

#include <optional>

#include "generate/constructive/placing.hpp"
#include "generate/drop_and_roll/pile.hpp"
#include "generate/option_checks.hpp"
#include "generate/ordered_bodies.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {
namespace {

void check_request(const Cell& cell, const DropAndRollOptions& options) {
  check_cell(cell);
  constructive::check_floor(cell, "drop_and_roll");
  check_option("DropAndRollOptions", "drops", options.drops,
               options.drops >= 1 && options.drops <= 10'000, "[1, 10000]");
  check_min_gap(cell, options.min_gap, "DropAndRollOptions");
}

void check_ball(const Cell& cell, const OrderedBody& ordered, std::int64_t k) {
  check_ordered(cell, ordered, k);
  const ShapeKind shape = kind(ordered.body);
  if (!is_round(shape)) {
    throw InvalidArgument(
        fmt::format("body {} is a {}; drop_and_roll takes disks and spheres", k, name(shape)));
  }
}

/// Places balls one by one.
class Dropping {
 public:
  Dropping(const Cell& cell, const DropAndRollOptions& options)
      : cell_(cell), options_(options), pile_(cell, options.min_gap) {}

  /// How many balls there will be.
  void expect(std::int64_t count) { pile_.expect(count); }

  /// The lowest of the places that ball k reaches; the first one of equals.
  std::optional<Vec3> place(double radius, std::int64_t k) {
    RandomStream random(options_.seed, StreamId::drop_and_roll, static_cast<std::uint64_t>(k));
    const std::size_t up = vertical_axis(cell_);
    std::optional<Vec3> lowest;
    for (int drop = 0; drop < options_.drops; ++drop) {
      const auto place = pile_.drop(random_column(radius, random), radius);
      if (place && (!lowest || (*place)[up] < (*lowest)[up])) lowest = place;
    }
    tested_ += options_.drops;
    if (lowest) pile_.add(*lowest, radius);
    return lowest;
  }

  [[nodiscard]] std::int64_t tested() const { return tested_; }

 private:
  [[nodiscard]] Vec3 random_column(double radius, RandomStream& random) const {
    const CenterBox box = pile_.centers(radius);
    Vec3 column;
    for (std::size_t a = 0; a < vertical_axis(cell_); ++a) {
      column[a] = random.uniform(box.lo[a], box.hi[a]);
    }
    return column;
  }

  const Cell& cell_;
  const DropAndRollOptions& options_;
  rolling::Pile pile_;
  std::int64_t tested_ = 0;
};

ConstructiveResult run_order(const constructive::Order& order, const DropAndRollOptions& options,
                             RunContext& run) {
  ConstructiveResult result;
  Dropping dropping(order.cell, options);
  constructive::place_in_order(
      order, run, result,
      [&](const OrderedBody& ordered, std::int64_t k) {
        check_ball(order.cell, ordered, k);
        if (k == 0) check_alone(order.cell, ordered, k, order.min_gap, Turn::as_given);
      },
      [&](const Body& body, std::int64_t k, std::int64_t expected) {
        dropping.expect(expected);
        return dropping.place(circum_radius(body), k);
      });
  result.tested = dropping.tested();
  return result;
}

}  // namespace

ConstructiveResult drop_and_roll_pack(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                      const DropAndRollOptions& options, RunContext run) {
  check_request(cell, options);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto number = static_cast<std::int64_t>(k);
    check_ball(cell, bodies[k], number);
    check_alone(cell, bodies[k], number, options.min_gap, Turn::as_given);
  }
  ConstructiveResult result;
  if (bodies.empty()) {
    result.packing.cell = cell;
    return result;
  }
  check_room(cell, bodies, options.min_gap);
  return run_order(constructive::order_of(cell, bodies, options.min_gap, "dropping"), options, run);
}

ConstructiveResult drop_and_roll_fill(const Cell& cell, const BodySource& source,
                                      const DropAndRollOptions& options, RunContext run) {
  check_request(cell, options);
  return run_order({cell, source, 0, options.min_gap, "dropping"}, options, run);
}

}  // namespace packstone
