#include "measure/density/profile.hpp"

#include <algorithm>
#include <cmath>

#include "measure/density/sums.hpp"
#include "measure/density/window.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/clipped_volume.hpp"

namespace packstone::density {
namespace {

// Volumes per slab.
struct SlabSums {
  std::vector<double> whole;
  std::vector<double> window;
};

void add(std::vector<double>& total, const std::vector<double>& part) {
  for (std::size_t i = 0; i < total.size(); ++i) total[i] += part[i];
}

// A slab, shifted by whole periods; only what is periodic goes on beyond the last one.
struct ShiftedSlab {
  std::size_t index = 0;
  double shift = 0.0;
};

// Distributes bodies over slabs.
class Slabs {
 public:
  Slabs(const Cell& cell, std::size_t axis, const std::vector<double>& edges,
        const std::optional<Window>& window)
      : cell_(cell), axis_(axis), edges_(edges), window_(window) {}

  void add(const Inclusion& inclusion, SlabSums& sums) const {
    const Vec3 half = half_extents(inclusion.body);
    const double center = inclusion.center[axis_], top = center + half[axis_];
    const Place place =
        window_ ? place_beside(cell_, *window_, inclusion.center, half, axis_) : Place::outside;
    std::optional<ShiftedSlab> slab = slab_at(center - half[axis_]);
    double hi = edges_[slab->index] + slab->shift;
    double below = volume_below(inclusion.body, axis_, hi - center);
    while (slab && hi < top) {
      const double lo = hi;
      hi = edges_[slab->index + 1] + slab->shift;
      const double below_lo = below;
      below = volume_below(inclusion.body, axis_, hi - center);
      sums.whole[slab->index] += below - below_lo;
      if (place == Place::inside) sums.window[slab->index] += below - below_lo;
      if (place == Place::cut) sums.window[slab->index] += part_in_window(inclusion, lo, hi);
      slab = next(*slab);
    }
  }

 private:
  // The slab that holds x, or the first one where x is below them all.
  [[nodiscard]] ShiftedSlab slab_at(double x) const {
    const double length = edges_.back();
    const double shift = cell_.periodic[axis_] ? length * std::floor(x / length) : 0.0;
    const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, x - shift);
    return {static_cast<std::size_t>(above - edges_.begin()) - 1, shift};
  }

  [[nodiscard]] std::optional<ShiftedSlab> next(const ShiftedSlab& slab) const {
    if (slab.index + 2 < edges_.size()) return ShiftedSlab{slab.index + 1, slab.shift};
    if (!cell_.periodic[axis_]) return std::nullopt;
    return ShiftedSlab{0, slab.shift + edges_.back()};
  }

  // Of a body that the window cuts beside the slab from lo to hi.
  [[nodiscard]] double part_in_window(const Inclusion& inclusion, double lo, double hi) const {
    Vec3 from, to;
    for (std::size_t a = 0; a < 3; ++a) {
      from[a] = cell_.periodic[a] ? -kUnbounded : window_->lo[a] - inclusion.center[a];
      to[a] = cell_.periodic[a] ? kUnbounded : window_->hi[a] - inclusion.center[a];
    }
    from[axis_] = lo - inclusion.center[axis_];
    to[axis_] = hi - inclusion.center[axis_];
    return volume_in_box(inclusion.body, from, to);
  }

  const Cell& cell_;
  std::size_t axis_;
  const std::vector<double>& edges_;
  const std::optional<Window>& window_;
};

// Volumes to fractions of slabs with this section [L^2], in 2D [L].
void divide(std::vector<double>& volumes, const std::vector<double>& edges, double section) {
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    volumes[i] /= section * (edges[i + 1] - edges[i]);
  }
}

double section_across(std::size_t axis, int dimension, const Vec3& edges) {
  double section = 1.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    if (a != axis) section *= edges[a];
  }
  return section;
}

// The marks, without those that all but coincide with the one before or with the last.
std::vector<double> distinct(const std::vector<double>& marks) {
  const double least = 1e-9 * (marks.back() - marks.front());
  std::vector<double> kept{marks.front()};
  for (const double mark : marks) {
    if (mark - kept.back() > least && marks.back() - mark > least) kept.push_back(mark);
  }
  kept.push_back(marks.back());
  return kept;
}

}  // namespace

std::vector<double> slab_edges(const std::vector<double>& marks, double width, double empty_above) {
  const std::vector<double> ends = distinct(marks);
  std::vector<double> edges{ends.front()};
  for (std::size_t m = 0; m + 1 < ends.size(); ++m) {
    const double length = ends[m + 1] - ends[m];
    constexpr double kRounding = 1e-9;
    const auto slabs =
        ends[m] >= empty_above ? 1.0 : std::max(1.0, std::ceil(length / width * (1.0 - kRounding)));
    for (double i = 1.0; i < slabs; i += 1.0) edges.push_back(ends[m] + length * (i / slabs));
    edges.push_back(ends[m + 1]);
  }
  return edges;
}

DensityProfile profile_along(const Packing& packing, std::size_t axis, std::vector<double> edges,
                             const std::optional<Window>& window, int threads) {
  const Cell& cell = packing.cell;
  const Slabs slabs(cell, axis, edges, window);
  const std::vector<double> empty(edges.size() - 1, 0.0);
  SlabSums sums = sum_in_blocks(
      static_cast<std::int64_t>(packing.inclusions.size()), threads,
      SlabSums{empty, window ? empty : std::vector<double>{}},
      [&](std::int64_t i, SlabSums& part) {
        slabs.add(packing.inclusions[static_cast<std::size_t>(i)], part);
      },
      [](SlabSums& total, const SlabSums& part) {
        add(total.whole, part.whole);
        add(total.window, part.window);
      });
  divide(sums.whole, edges, section_across(axis, cell.dimension, cell.size));
  if (window) {
    divide(sums.window, edges, section_across(axis, cell.dimension, window->hi - window->lo));
  }
  return {static_cast<int>(axis), std::move(edges), std::move(sums.whole), std::move(sums.window)};
}

}  // namespace packstone::density
