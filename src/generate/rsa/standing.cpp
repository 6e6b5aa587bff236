#include "generate/rsa/standing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::rsa {
namespace {

// Calls visit(shift) for one of each pair +-shift of own images that are not plainly out of reach,
// until it returns false. Returns whether all visits returned true.
template <class Visit>
bool for_own_images(const Cell& cell, double reach, Visit&& visit) {
  int last[3] = {0, 0, 0};
  for (int axis = 0; axis < cell.dimension; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (cell.periodic[a]) last[axis] = static_cast<int>(std::floor(reach / cell.size[a]));
  }
  for (int z = 0; z <= last[2]; ++z) {
    for (int y = z > 0 ? -last[1] : 0; y <= last[1]; ++y) {
      for (int x = z > 0 || y > 0 ? -last[0] : 1; x <= last[0]; ++x) {
        if (!visit(image_shift(cell, {x, y, z}))) return false;
      }
    }
  }
  return true;
}

double own_reach(const Candidate& candidate, double min_gap) {
  return (2.0 * candidate.outline.circum_radius + min_gap) * (1.0 + 1e-12);
}

constexpr char kAxisNames[] = "xyz";

std::optional<std::string> why_walls_refuse(const Cell& cell, const Vec3& half_extents) {
  const CenterBox box = centers_inside_walls(cell, half_extents);
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (box.lo[a] <= box.hi[a]) continue;
    return fmt::format("it is {:.6g} wide along {}, where the walls leave {:.6g}",
                       2.0 * half_extents[a], kAxisNames[a], cell.size[a]);
  }
  return std::nullopt;
}

// Fully periodic, and far too small to meet an own image: the common case, settled at once.
bool is_plainly_small(const Cell& cell, const Body& body, double min_gap) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (!cell.periodic[a]) return false;
    shortest = std::min(shortest, cell.size[a]);
  }
  return 2.0 * circum_radius(body) + min_gap < 0.999 * shortest;
}

}  // namespace

CenterBox centers_inside_walls(const Cell& cell, const Vec3& half_extents) noexcept {
  CenterBox box{{0, 0, 0}, cell.size};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (cell.periodic[a]) continue;
    // Rounded inward, so that center - extent >= 0 and center + extent <= size as computed.
    box.lo[a] = half_extents[a] * (1.0 + 4 * kUnitRoundoff);
    box.hi[a] = (cell.size[a] - half_extents[a]) - 4 * kUnitRoundoff * cell.size[a];
  }
  return box;
}

bool is_inside(const CenterBox& box, const Vec3& center, int dimension) noexcept {
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    if (center[a] < box.lo[a] || center[a] > box.hi[a]) return false;
  }
  return true;
}

bool clears_own_images(const Cell& cell, const Candidate& candidate, double min_gap) {
  return for_own_images(cell, own_reach(candidate, min_gap), [&](const Vec3& shift) {
    return proven_apart(candidate.body, candidate.outline, candidate.body, candidate.outline, shift,
                        min_gap);
  });
}

bool meets_own_image(const Cell& cell, const Candidate& candidate, double min_gap) {
  return !for_own_images(cell, own_reach(candidate, min_gap), [&](const Vec3& shift) {
    return overlap(candidate.body, candidate.body, shift, min_gap) != Verdict::overlapping;
  });
}

std::optional<std::string> why_it_cannot_stand(const Cell& cell, const Body& body, double min_gap,
                                               bool any_turn) {
  if (any_turn) {
    const double radius = in_radius(body);
    const Body ball = cell.dimension == 2 ? Body{Disk{radius}} : Body{Sphere{radius}};
    return why_it_cannot_stand(cell, ball, min_gap, false);
  }
  if (is_plainly_small(cell, body, min_gap)) return std::nullopt;
  const Candidate candidate(body);
  if (auto reason = why_walls_refuse(cell, candidate.half_extents)) return reason;
  if (clears_own_images(cell, candidate, min_gap)) return std::nullopt;
  return fmt::format(
      "it does not keep a gap of more than {:.6g} to its own periodic images in a cell of "
      "{:.6g} x {:.6g}{}",
      min_gap, cell.size.x, cell.size.y,
      cell.dimension == 3 ? fmt::format(" x {:.6g}", cell.size.z) : std::string());
}

}  // namespace packstone::rsa
