#pragma once

/// @file
/// Which periodic images of an inclusion matter: those that reach into the cell, and those that it
/// may meet itself.

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// The images, in periods along each axis, whose bounding box meets the cell (or comes within
/// 1e-12 of its own size of that), in lexicographic order; {0, 0, 0} is always among them. Bodies
/// longer than the cell have many: see check_images(). Those whose body itself meets the cell are
/// images_reaching_in(), face_crossings.hpp.
[[nodiscard]] std::vector<std::array<int, 3>> images_in_cell(const Cell& cell,
                                                             const Inclusion& inclusion);

/// Bodies longer than this many periods, or with boxes that meet more images of their own, are
/// refused: to look at those alone would be long work.
inline constexpr double kMostPeriods = 500;
inline constexpr double kMostOwnImages = 1e6;

/// Why a body of these half extents [L] is refused, a sentence about "it"; nothing if it is not.
[[nodiscard]] std::optional<std::string> why_too_many_own_images(const Cell& cell,
                                                                 const Vec3& half_extents);

/// Refuses what would be endless work to list: throws InvalidArgument, "inclusion 7: it is ...",
/// when a body of the packing has too many own images. The second form is for one inclusion whose
/// half extents [L] are known.
void check_images(const Packing& packing);
void check_images(const Cell& cell, std::size_t inclusion, const Vec3& half_extents);

/// Why no two inclusions can be ordered to keep `min_gap` [L]: "allowed are numbers >= 0 and below
/// 1, ..."; nothing if they can. Whatever stands has no more than one period to its own image.
[[nodiscard]] std::optional<std::string> why_no_least_gap(const Cell& cell, double min_gap);

/// Calls visit(image) for one of each pair +-image of own images, in periods along each axis, whose
/// box of half edges `half_extents` may come within `gap` of that of the body itself, until it
/// returns false. Returns whether all visits returned true.
template <class Visit>
bool for_own_images(const Cell& cell, const Vec3& half_extents, double gap, Visit&& visit) {
  constexpr double kRounding = 1.0 + 1e-12;
  std::array<int, 3> last{0, 0, 0};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (!cell.periodic[axis]) continue;
    const double reach = (2.0 * half_extents[axis] + gap) * kRounding;
    last[axis] = static_cast<int>(std::floor(reach / cell.size[axis]));
  }
  for (int z = 0; z <= last[2]; ++z) {
    for (int y = z > 0 ? -last[1] : 0; y <= last[1]; ++y) {
      for (int x = z > 0 || y > 0 ? -last[0] : 1; x <= last[0]; ++x) {
        if (!visit(std::array<int, 3>{x, y, z})) return false;
      }
    }
  }
  return true;
}

}  // namespace packstone
