#pragma once

/// @file
/// The weighted points that a power diagram is made of.

#include <array>
#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::laguerre {

/// An image of the box: whole periods along each axis.
using Image = std::array<int, 3>;

constexpr Image operator+(const Image& a, const Image& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
constexpr Image operator-(const Image& a, const Image& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
constexpr Image operator-(const Image& a) { return {-a[0], -a[1], -a[2]}; }

/// A weighted point. Its power at x is |x - at|^2 - weight.
struct Site {
  Vec3 at;              ///< Inside the box along periodic axes [L].
  double weight = 0.0;  ///< [L^2]
  std::int32_t owner = 0;
  Image home{};  ///< Periods taken off: in the piece that its owner is, it stands at at + home.
};

/// `at` brought into the box.
inline Site wrapped_site(const Cell& box, const Vec3& at, double weight, std::int32_t owner) {
  Site site{wrapped(box, at), weight, owner, {}};
  for (std::size_t a = 0; a < static_cast<std::size_t>(box.dimension); ++a) {
    if (!box.periodic[a]) continue;
    site.home[a] = static_cast<int>(std::lround((at[a] - site.at[a]) / box.size[a]));
  }
  return site;
}

/// What bounds a power cell: another site, or a wall.
struct Plane {
  std::int32_t site = 0;  ///< Index, or -1 - (2 axis + side) of a wall.
  Image image{};          ///< Periods by which the site is shifted.
  Vec3 to;                ///< From the site of the cell to this one; of a wall its normal [L].

  [[nodiscard]] bool is_wall() const { return site < 0; }
  [[nodiscard]] int wall() const { return -1 - site; }
};

}  // namespace packstone::laguerre
