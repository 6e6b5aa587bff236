#include "support/brute_force_check.hpp"

#include <cmath>
#include <limits>

#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::test {
namespace {

// Enough periods that what lies beyond is farther than the nearest image of any pair: the center
// of that one is within half a period along each axis.
int image_reach(const Cell& cell, std::size_t axis, double radii, double min_gap) {
  if (!cell.periodic[axis]) return 0;
  const double nearest = norm(cell.size);
  return 1 + static_cast<int>(std::ceil((2.0 * radii + nearest + min_gap) / cell.size[axis]));
}

void judge(const Inclusion& a, const Inclusion& b, const Vec3& shift, Certificate& verdict,
           std::array<std::int64_t, 2> pair, const std::array<int, 3>& image) {
  const Vec3 r = b.center - a.center + shift;
  const Gap measured = gap(a.body, b.body, r);
  if (measured.value < verdict.smallest_gap) {
    verdict.smallest_gap = measured.value;
    verdict.smallest_gap_error = measured.error;
    verdict.worst_pair = pair;
    verdict.worst_image = image;
  }
  if (decide(a.body, b.body, r, verdict.min_gap).verdict == Verdict::separated) return;
  const bool apart = decide(a.body, b.body, r, 0.0).verdict == Verdict::separated;
  ++(apart ? verdict.gaps_below : verdict.overlaps);
}

bool sticks_out(const Cell& cell, const Inclusion& inclusion) {
  const Vec3 h = half_extents(inclusion.body);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    // 1e-14: rounding, which the random packings of the tests never come near.
    const double over = std::max(h[axis] - inclusion.center[axis],
                                 h[axis] + inclusion.center[axis] - cell.size[axis]);
    if (!cell.periodic[axis] && over > 1e-14) return true;
  }
  return false;
}

}  // namespace

Certificate brute_force_check(const Packing& packing, double min_gap) {
  Certificate verdict;
  verdict.min_gap = min_gap;
  verdict.smallest_gap = std::numeric_limits<double>::infinity();
  verdict.count = static_cast<std::int64_t>(packing.inclusions.size());
  verdict.fraction = fraction(packing);
  const auto& all = packing.inclusions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    verdict.outside_walls += sticks_out(packing.cell, all[i]) ? 1 : 0;
    for (std::size_t j = i; j < all.size(); ++j) {
      const double radii = circum_radius(all[i].body) + circum_radius(all[j].body);
      const int nx = image_reach(packing.cell, 0, radii, min_gap);
      const int ny = image_reach(packing.cell, 1, radii, min_gap);
      const int nz = packing.cell.dimension == 3 ? image_reach(packing.cell, 2, radii, min_gap) : 0;
      for (int x = -nx; x <= nx; ++x) {
        for (int y = -ny; y <= ny; ++y) {
          for (int z = -nz; z <= nz; ++z) {
            const std::array<int, 3> image{x, y, z};
            if (i == j && image <= std::array<int, 3>{0, 0, 0}) continue;
            judge(all[i], all[j], image_shift(packing.cell, image), verdict,
                  {static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)}, image);
          }
        }
      }
    }
  }
  return verdict;
}

}  // namespace packstone::test
