#pragma once

/// @file
/// The loop that constructive methods share: body after body, until one has no position.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/constructive.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::constructive {

/// Throws InvalidArgument unless the cell has a floor and a ceiling. `method` begins the message.
void check_floor(const Cell& cell, std::string_view method);

/// The bodies to place.
struct Order {
  const Cell& cell;
  BodySource source;
  std::int64_t wanted = 0;   ///< How many there are; 0: endless.
  double min_gap = 0.0;      ///< [L]
  std::string_view stage{};  ///< For reports of progress.
};

/// The order of a list, which must outlive it.
[[nodiscard]] Order order_of(const Cell& cell, const std::vector<OrderedBody>& bodies,
                             double min_gap, std::string_view stage);

/// Why the next body is not to be placed at all; nothing if it is.
[[nodiscard]] std::optional<ConstructiveStop> stop_before(const Order& order, std::int64_t k,
                                                          const RunContext& run);

/// Can the cell not hold body k of an endless supply, though it held the first one?
[[nodiscard]] bool is_too_large(const Order& order, std::int64_t k, const Body& body);

/// How many bodies there will be, as far as those up to body k tell, of volume `volume_so_far`.
[[nodiscard]] inline std::int64_t expected_count(const Order& order, std::int64_t k,
                                                 double volume_so_far) {
  if (order.wanted > 0) return order.wanted;
  return static_cast<std::int64_t>(volume(order.cell) / volume_so_far * static_cast<double>(k + 1));
}

/// Fills `result`. check(ordered, k) throws for what may not be placed; place(body, k, expected)
/// gives the center, inside the cell, or nothing where the body has no position, `expected` being
/// expected_count().
template <class Check, class Place>
void place_in_order(const Order& order, RunContext& run, ConstructiveResult& result, Check&& check,
                    Place&& place) {
  result.packing.cell = order.cell;
  double placed_volume = 0.0;
  for (std::int64_t k = 0;; ++k) {
    if (const auto stop = stop_before(order, k, run)) {
      result.stop = *stop;
      return;
    }
    const OrderedBody ordered = order.source(k);
    if (order.wanted == 0) check(ordered, k);
    placed_volume += volume(ordered.body);
    const std::optional<Vec3> center =
        is_too_large(order, k, ordered.body)
            ? std::nullopt
            : place(ordered.body, k, expected_count(order, k, placed_volume));
    if (!center) {
      result.stop = ConstructiveStop::full;
      return;
    }
    result.packing.inclusions.push_back({*center, ordered.body, ordered.group});
    const double done =
        order.wanted == 0 ? -1.0 : static_cast<double>(k + 1) / static_cast<double>(order.wanted);
    run.report({order.stage, done, placed_volume / volume(order.cell), k + 1, order.wanted});
  }
}

}  // namespace packstone::constructive
