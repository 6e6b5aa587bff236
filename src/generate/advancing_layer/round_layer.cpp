#include "generate/advancing_layer/round_layer.hpp"

#include <algorithm>

#include "packstone/geometry/bounds.hpp"

namespace packstone::advancing_layer {

template <int D>
RoundLayer<D>::RoundLayer(const Cell& cell, const Expected& expected, double min_gap,
                          RandomStream random)
    : cell_(cell),
      largest_(expected.largest),
      pockets_(cell, expected, min_gap),
      floor_(cell, random) {}

template <int D>
std::optional<Vec3> RoundLayer<D>::place(const Body& body, const Search& search) {
  constexpr double kLow = 4.0;  // Above, the corners of the floor are taken.
  const double radius = circum_radius(body);
  pockets_.find({radius, search.from, search.candidates}, found_);
  std::optional<Vec3> center = lowest_found(radius);
  if (pockets_.balls().top() < kLow * largest_) {
    const auto corner = floor_.in_corner(pockets_.balls(), radius);
    if (corner && (!center || (*corner)[kUp] < (*center)[kUp])) center = corner;
  }
  if (!center && !search.holes) center = floor_.anywhere(pockets_.balls(), radius);
  if (center) pockets_.add(*center, radius);
  return center;
}

template <int D>
std::optional<Vec3> RoundLayer<D>::lowest_found(double radius) {
  std::sort(found_.begin(), found_.end(), [](const Pocket& a, const Pocket& b) {
    return a.center[kUp] != b.center[kUp] ? a.center[kUp] < b.center[kUp] : a.anchor < b.anchor;
  });
  for (const Pocket& pocket : found_) {
    const Vec3 center = wrapped(cell_, pocket.center);
    if (pockets_.balls().is_clear(center, radius)) return center;
  }
  return std::nullopt;
}

template class RoundLayer<2>;
template class RoundLayer<3>;

}  // namespace packstone::advancing_layer
