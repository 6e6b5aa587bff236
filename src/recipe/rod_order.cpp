#include "recipe/rod_order.hpp"

#include <algorithm>
#include <numbers>

#include "packstone/geometry/bounds.hpp"

namespace packstone::recipe {
namespace {

using std::numbers::pi;

// Mean |sin| of the angle between two axes, over all pairs of some of the bodies.
double mean_crossing(const std::vector<OrderedBody>& bodies) {
  constexpr std::size_t kSome = 200;
  const std::size_t count = std::min(kSome, bodies.size());
  std::vector<Vec3> axes;
  for (std::size_t k = 0; k < count; ++k) {
    axes.push_back(*symmetry_axis(bodies[k * bodies.size() / count].body));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) sum += norm(cross(axes[i], axes[j]));
  }
  return count < 2 ? 0.25 * pi : sum / (0.5 * static_cast<double>(count * (count - 1)));
}

}  // namespace

std::pair<double, double> rod_sizes(const Body& body) {
  if (const auto* rod = std::get_if<Cylinder>(&body)) return {rod->radius, rod->half_length};
  const auto& rod = std::get<Spherocylinder>(body);
  return {rod.radius, rod.half_length};
}

std::optional<RodOrder> rod_order(const std::vector<OrderedBody>& bodies) {
  double radii = 0.0, half_lengths = 0.0;
  for (const OrderedBody& ordered : bodies) {
    if (!is_rod(kind(ordered.body))) return std::nullopt;
    const auto [radius, half_length] = rod_sizes(ordered.body);
    radii += radius;
    half_lengths += half_length;
  }
  if (bodies.empty()) return std::nullopt;
  return RodOrder{half_lengths / radii, mean_crossing(bodies) / (0.25 * pi)};
}

}  // namespace packstone::recipe
