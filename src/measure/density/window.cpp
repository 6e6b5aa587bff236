#include "measure/density/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/density/sums.hpp"
#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/clipped_volume.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

using density::kUnbounded;

std::size_t axes_of(const Cell& cell) { return static_cast<std::size_t>(cell.dimension); }

struct Covered {
  CompensatedSum volume;
  CompensatedSum error;
};

// The shifts by whole periods, along one axis, with which a body may reach into the window.
struct Shifts {
  int first = 0;
  int last = 0;
};

// What a body has in the window, over all its images.
class WindowSum {
 public:
  WindowSum(const Cell& cell, const Window& window) : cell_(cell), window_(window) {
    for (std::size_t a = 0; a < axes_of(cell); ++a) {
      whole_period_[a] = cell.periodic[a] && window.hi[a] - window.lo[a] >= cell.size[a];
    }
  }

  void add(const Inclusion& inclusion, Covered& covered) const {
    const Vec3 half = half_extents(inclusion.body);
    std::array<Shifts, 3> shifts{};
    for (std::size_t a = 0; a < axes_of(cell_); ++a) shifts[a] = shifts_along(inclusion, half, a);
    for (int x = shifts[0].first; x <= shifts[0].last; ++x) {
      for (int y = shifts[1].first; y <= shifts[1].last; ++y) {
        for (int z = shifts[2].first; z <= shifts[2].last; ++z) {
          add_image(inclusion.body, inclusion.center + image_shift(cell_, {x, y, z}), half,
                    covered);
        }
      }
    }
  }

 private:
  [[nodiscard]] Shifts shifts_along(const Inclusion& inclusion, const Vec3& half,
                                    std::size_t a) const {
    if (!cell_.periodic[a] || whole_period_[a]) return {};
    const double c = inclusion.center[a], length = cell_.size[a];
    return {static_cast<int>(std::ceil((window_.lo[a] - half[a] - c) / length)),
            static_cast<int>(std::floor((window_.hi[a] + half[a] - c) / length))};
  }

  void add_image(const Body& body, const Vec3& center, const Vec3& half, Covered& covered) const {
    Vec3 lo, hi;
    int cuts = 0;
    double displaced = 0.0;
    for (std::size_t a = 0; a < axes_of(cell_); ++a) {
      lo[a] = whole_period_[a] ? -kUnbounded : window_.lo[a] - center[a];
      hi[a] = whole_period_[a] ? kUnbounded : window_.hi[a] - center[a];
      if (lo[a] >= half[a] || hi[a] <= -half[a]) return;
      if (lo[a] <= -half[a] && hi[a] >= half[a]) continue;
      ++cuts;
      displaced += displacement(a) / half[a];
    }
    covered.volume.add(volume_in_box(body, lo, hi));
    covered.error.add(volume(body) * (relative_error(cuts) + displaced));
  }

  // The relative coordinates of two sides come from three roundings each, and no section of a
  // convex body is larger than three times its volume over its width.
  [[nodiscard]] double displacement(std::size_t a) const {
    return 9 * kUnitRoundoff * (std::abs(window_.lo[a]) + cell_.size[a]);
  }

  // Of what a body has in a window that cuts it across so many axes.
  [[nodiscard]] double relative_error(int cuts) const {
    constexpr double kRounding = 8 * kUnitRoundoff;
    if (cuts == 0) return kRounding;
    if (cell_.dimension == 2) return kClippedAreaError;
    return cuts == 1 ? kVolumeBelowError : kVolumeInBoxError;
  }

  const Cell& cell_;
  const Window& window_;
  std::array<bool, 3> whole_period_{false, false, false};
};

double volume_of(const Window& window, std::size_t axes) {
  double product = 1.0;
  for (std::size_t a = 0; a < axes; ++a) product *= window.hi[a] - window.lo[a];
  return product;
}

void check_window(const Cell& cell, const Window& window) {
  for (std::size_t a = 0; a < axes_of(cell); ++a) {
    const double lo = window.lo[a], hi = window.hi[a];
    const std::string given = std::string("window: along ") + "xyz"[a] + " it reaches from " +
                              number_text(lo) + " to " + number_text(hi);
    if (!(lo < hi) || !std::isfinite(hi - lo)) {
      throw InvalidArgument(given + "; allowed are finite numbers, the second above the first");
    }
    if (cell.periodic[a] && hi - lo > cell.size[a]) {
      throw InvalidArgument(given + "; allowed is at most a period, " + number_text(cell.size[a]));
    }
    if (!cell.periodic[a] && (lo < 0.0 || hi > cell.size[a])) {
      throw InvalidArgument(given + "; allowed between the walls is [0, " +
                            number_text(cell.size[a]) + "]");
    }
  }
}

}  // namespace

namespace density {

Place place_beside(const Cell& cell, const Window& window, const Vec3& center, const Vec3& half,
                   std::size_t skipped) noexcept {
  Place place = Place::inside;
  for (std::size_t a = 0; a < axes_of(cell); ++a) {
    if (a == skipped || cell.periodic[a]) continue;
    const double lo = center[a] - half[a], hi = center[a] + half[a];
    if (hi <= window.lo[a] || lo >= window.hi[a]) return Place::outside;
    if (lo < window.lo[a] || hi > window.hi[a]) place = Place::cut;
  }
  return place;
}

WindowFraction fraction_in(const Packing& packing, const Window& window, int threads) {
  const WindowSum sum(packing.cell, window);
  const Covered covered = sum_in_blocks(
      static_cast<std::int64_t>(packing.inclusions.size()), threads, Covered{},
      [&](std::int64_t i, Covered& part) {
        sum.add(packing.inclusions[static_cast<std::size_t>(i)], part);
      },
      [](Covered& total, const Covered& part) {
        total.volume.add(part.volume.value());
        total.error.add(part.error.value());
      });
  const double room = volume_of(window, axes_of(packing.cell));
  return {covered.volume.value() / room, covered.error.value() / room};
}

}  // namespace density

WindowFraction fraction_in_window(const Packing& packing, const Window& window,
                                  const RunContext& run) {
  check_well_formed(packing);
  check_images(packing);
  check_window(packing.cell, window);
  return density::fraction_in(packing, window, run.threads());
}

}  // namespace packstone
