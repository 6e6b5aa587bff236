#include "generate/advancing_layer/layer.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "generate/advancing_layer/equal_layer.hpp"
#include "generate/advancing_layer/round_layer.hpp"
#include "generate/advancing_layer/shaped_layer.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/equal_ball.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::advancing_layer {
namespace {

// Balls that stand for a body of the least spacing, roughly.
double balls_of(const Body& body) {
  return is_round(kind(body)) ? 1.0 : 1.0 + 3.0 * circum_radius(body) / in_radius(body);
}

Expected expected_of(const std::vector<OrderedBody>& bodies) {
  Expected expected;
  expected.smallest = guide_radius(bodies.front().body);
  double sum = 0.0, balls = 0.0;
  for (const OrderedBody& ordered : bodies) {
    const double guide = guide_radius(ordered.body);
    expected.smallest = std::min(expected.smallest, guide);
    expected.largest = std::max({expected.largest, guide, in_radius(ordered.body)});
    sum += volume(ordered.body);
    balls += balls_of(ordered.body);
  }
  expected.typical = equal_ball_radius(dimension(kind(bodies.front().body)),
                                       sum / static_cast<double>(bodies.size()));
  expected.count = static_cast<std::int64_t>(balls);
  return expected;
}

// All radii, ascending, where there are very few; none otherwise.
std::vector<double> few_radii(const std::vector<OrderedBody>& bodies) {
  constexpr std::size_t kFew = 3;
  std::set<double> radii;
  for (const OrderedBody& ordered : bodies) {
    radii.insert(circum_radius(ordered.body));
    if (radii.size() > kFew) return {};
  }
  return {radii.begin(), radii.end()};
}

template <int D>
std::unique_ptr<Layer> layer_in(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                double min_gap, const RandomStream& random) {
  const Expected expected = expected_of(bodies);
  const bool round = std::all_of(bodies.begin(), bodies.end(),
                                 [](const OrderedBody& b) { return is_round(kind(b.body)); });
  if (round) {
    std::vector<double> radii = few_radii(bodies);
    if (radii.empty()) return std::make_unique<RoundLayer<D>>(cell, expected, min_gap, random);
    return std::make_unique<EqualLayer<D>>(cell, expected, std::move(radii), min_gap, random);
  }
  return std::make_unique<ShapedLayer<D>>(cell, expected, static_cast<std::int64_t>(bodies.size()),
                                          min_gap, random);
}

}  // namespace

double guide_radius(const Body& body) {
  if (is_round(kind(body))) return circum_radius(body);
  constexpr double kPart = 0.8;
  return kPart * equal_ball_radius(dimension(kind(body)), volume(body));
}

std::unique_ptr<Layer> make_layer(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                  double min_gap, std::uint64_t seed, std::uint64_t attempt) {
  const RandomStream random(seed, StreamId::advancing_layer, kFloorItem, attempt);
  return cell.dimension == 2 ? layer_in<2>(cell, bodies, min_gap, random)
                             : layer_in<3>(cell, bodies, min_gap, random);
}

}  // namespace packstone::advancing_layer
