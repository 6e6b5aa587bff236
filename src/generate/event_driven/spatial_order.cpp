#include "generate/event_driven/spatial_order.hpp"

#include <cstddef>

#include "spatial/curve_order.hpp"

namespace packstone::event_driven {
namespace {

std::vector<std::int32_t> inverse(const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> places(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    places[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  }
  return places;
}

}  // namespace

std::vector<std::int32_t> spatial_order(const Bodies& bodies, const Cell& cell) {
  std::vector<Vec3> centers;
  centers.reserve(bodies.flight.size());
  for (const Flight& flight : bodies.flight) centers.push_back(flight.center);
  return curve_order(centers, cell);
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
