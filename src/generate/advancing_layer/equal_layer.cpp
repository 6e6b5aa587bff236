#include "generate/advancing_layer/equal_layer.hpp"

#include <algorithm>

#include "packstone/geometry/bounds.hpp"

namespace packstone::advancing_layer {
namespace {

// For heaps whose first element is the lowest.
constexpr auto kIsHigher = [](const auto& a, const auto& b) {
  return a.height != b.height ? a.height > b.height : a.number > b.number;
};

}  // namespace

template <int D>
EqualLayer<D>::EqualLayer(const Cell& cell, const Expected& expected, std::vector<double> radii,
                          double min_gap, RandomStream random)
    : cell_(cell),
      radii_(std::move(radii)),
      balls_(cell, expected, min_gap),
      floor_(cell, random),
      heaps_(radii_.size()) {}

template <int D>
std::optional<Vec3> EqualLayer<D>::place(const Body& body, const Search&) {
  const double radius = circum_radius(body);
  const auto which = std::lower_bound(radii_.begin(), radii_.end(), radius) - radii_.begin();
  std::optional<Vec3> center = take_lowest(static_cast<std::size_t>(which));
  if (!center) center = floor_.in_corner(balls_, radius);
  if (!center) center = floor_.anywhere(balls_, radius);
  if (!center) return std::nullopt;
  list_places(balls_.add(*center, radius));
  return center;
}

template <int D>
std::optional<Vec3> EqualLayer<D>::take_lowest(std::size_t which) {
  Heap& heap = heaps_[which];
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), kIsHigher);
    const Vec3 center = heap.back().center;
    heap.pop_back();
    if (balls_.is_clear(center, radii_[which])) return center;
  }
  return std::nullopt;
}

template <int D>
void EqualLayer<D>::list_places(std::int32_t anchor) {
  for (std::size_t which = 0; which < radii_.size(); ++which) {
    balls_.visit_places(anchor, radii_[which], [&](const Vec3& center) {
      heaps_[which].push_back({wrapped(cell_, center), center[kUp], listed_++});
      std::push_heap(heaps_[which].begin(), heaps_[which].end(), kIsHigher);
    });
  }
}

template <int D>
void EqualLayer<D>::list_near(double height) {
  for (std::int32_t anchor = 0; anchor < balls_.size(); ++anchor) {
    if (balls_.is_near(balls_.center(anchor)[kUp], height)) list_places(anchor);
  }
}

template <int D>
void EqualLayer<D>::open_floor() {
  if (!cell_.periodic[kUp]) return;
  balls_.open_floor();
  list_near(0.0);
}

template class EqualLayer<2>;
template class EqualLayer<3>;

}  // namespace packstone::advancing_layer
