#include "generate/rsa/standing.hpp"

#include <array>

#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/structure/images.hpp"

namespace packstone::rsa {

bool is_inside(const CenterBox& box, const Vec3& center, int dimension) noexcept {
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    if (center[a] < box.lo[a] || center[a] > box.hi[a]) return false;
  }
  return true;
}

bool clears_own_images(const Cell& cell, const Candidate& candidate, double min_gap) {
  const Vec3 half = half_extents(candidate.body);
  return for_own_images(cell, half, min_gap, [&](const std::array<int, 3>& image) {
    return proven_apart(candidate.body, candidate.outline, candidate.body, candidate.outline,
                        image_shift(cell, image), min_gap);
  });
}

bool meets_own_image(const Cell& cell, const Candidate& candidate, double min_gap) {
  const Vec3 half = half_extents(candidate.body);
  return !for_own_images(cell, half, min_gap, [&](const std::array<int, 3>& image) {
    return overlap(candidate.body, candidate.body, image_shift(cell, image), min_gap) !=
           Verdict::overlapping;
  });
}

}  // namespace packstone::rsa
