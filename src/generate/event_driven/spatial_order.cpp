#include "generate/event_driven/spatial_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace packstone::event_driven {
namespace {

// Spreads the 21 lowest bits three places apart.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffffU;
  x = (x | x << 32U) & 0x1f00000000ffffU;
  x = (x | x << 16U) & 0x1f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

std::uint64_t place_on_curve(const Vec3& center, const Cell& cell) {
  constexpr double kSteps = 0x1p20;
  std::uint64_t key = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    const double part = center[a] / cell.size[a];
    const double inside = part - std::floor(part);
    key |= spread(static_cast<std::uint64_t>(kSteps * inside)) << a;
  }
  return key;
}

std::vector<std::int32_t> inverse(const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> places(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    places[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  }
  return places;
}

}  // namespace

std::vector<std::int32_t> spatial_order(const Bodies& bodies, const Cell& cell) {
  std::vector<std::uint64_t> key;
  key.reserve(bodies.flight.size());
  for (const Flight& flight : bodies.flight) key.push_back(place_on_curve(flight.center, cell));
  std::vector<std::int32_t> order(bodies.flight.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const std::uint64_t of_a = key[static_cast<std::size_t>(a)];
    const std::uint64_t of_b = key[static_cast<std::size_t>(b)];
    return of_a < of_b || (of_a == of_b && a < b);
  });
  return order;
}

Bodies in_order(const Bodies& bodies, const std::vector<std::int32_t>& order) {
  Bodies result = bodies;
  const auto take = [&](auto& to, const auto& from) {
    for (std::size_t k = 0; k < from.size(); ++k) to[k] = from[static_cast<std::size_t>(order[k])];
  };
  take(result.flight, bodies.flight);
  take(result.spin, bodies.spin);
  take(result.second, bodies.second);
  take(result.form, bodies.form);
  take(result.reach, bodies.reach);
  take(result.inverse_mass, bodies.inverse_mass);
  take(result.inverse_inertia, bodies.inverse_inertia);
  return result;
}

Bodies out_of_order(const Bodies& bodies, const std::vector<std::int32_t>& order) {
  return in_order(bodies, inverse(order));
}

}  // namespace packstone::event_driven
