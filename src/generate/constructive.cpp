#include "packstone/generate/constructive.hpp"

#include <fmt/format.h>

#include "generate/constructive/placing.hpp"
#include "packstone/core/error.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {

std::string_view name(ConstructiveStop stop) noexcept {
  constexpr std::string_view names[] = {"target_reached", "full", "cancelled", "out_of_time"};
  return names[static_cast<int>(stop)];
}

namespace constructive {

void check_floor(const Cell& cell, std::string_view method) {
  const std::size_t up = vertical_axis(cell);
  if (!cell.periodic[up]) return;
  throw InvalidArgument(
      fmt::format("{}: Cell::periodic[{}] is true; it must be false, as bodies are laid upon a "
                  "floor across {}",
                  method, up, "xyz"[up]));
}

Order order_of(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap,
               std::string_view stage) {
  return {cell, [&bodies](std::int64_t k) { return bodies[static_cast<std::size_t>(k)]; },
          static_cast<std::int64_t>(bodies.size()), min_gap, stage};
}

std::optional<ConstructiveStop> stop_before(const Order& order, std::int64_t k,
                                            const RunContext& run) {
  if (order.wanted > 0 && k == order.wanted) return ConstructiveStop::target_reached;
  switch (run.stop_request()) {
    case StopRequest::cancelled:
      return ConstructiveStop::cancelled;
    case StopRequest::out_of_time:
      return ConstructiveStop::out_of_time;
    case StopRequest::none:
      break;
  }
  return std::nullopt;
}

bool is_too_large(const Order& order, std::int64_t k, const Body& body) {
  return order.wanted == 0 && k > 0 &&
         why_it_cannot_stand(order.cell, body, order.min_gap, Turn::as_given).has_value();
}

}  // namespace constructive
}  // namespace packstone
