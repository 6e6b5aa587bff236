#pragma once

/// @file
/// Which faces of the cell an inclusion cuts, and which of its periodic images reach into the cell:
/// what a mesher of the cell needs to know.
///
/// With c the center and S the support function of the body (support.hpp), and e_k the unit vector
/// along axis k,
///
///     the body cuts the plane x_k = beta   <=>   |c_k - beta| < S(e_k)                     (1)
///
/// For an ellipsoid this is g-dagger < 0 of E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013)
/// 471-490, equation (23), and their event g-dagger = 0 is equality. A face is part of its plane
/// only; whether the body meets that part is decided by separating_direction(), box_contact.hpp.
///
/// A body that touches a face from one side only does not cut it by (1). In double numbers the two
/// cannot be told apart, so whatever is not proven to stay on one side counts as cutting: nothing
/// that reaches in by more than rounding is missed, and what touches within rounding is listed.

#include <array>
#include <vector>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// Faces of the cell by axis: low at x_k = 0, high at x_k = size[k].
struct CellFaces {
  std::array<bool, 3> low{false, false, false};
  std::array<bool, 3> high{false, false, false};

  [[nodiscard]] constexpr bool any() const {
    return low[0] || low[1] || low[2] || high[0] || high[1] || high[2];
  }
  friend constexpr bool operator==(const CellFaces&, const CellFaces&) = default;
};

/// The planes of the faces that an image of the inclusion cuts, equation (1); `image` in periods.
[[nodiscard]] CellFaces planes_cut(const Cell& cell, const Inclusion& inclusion,
                                   const std::array<int, 3>& image = {0, 0, 0}) noexcept;

/// The faces that an image of the inclusion cuts: those of planes_cut() of which it meets the
/// rectangle (in 2D the edge) itself.
///
/// Matched: image m cuts the high face of a periodic axis if and only if image m - 1 cuts the low
/// one, without exception for rounding.
[[nodiscard]] CellFaces faces_cut(const Cell& cell, const Inclusion& inclusion,
                                  const std::array<int, 3>& image = {0, 0, 0}) noexcept;

/// An image that reaches into the cell.
struct ImageInCell {
  std::array<int, 3> image{0, 0, 0};  ///< Periods along each axis; 0, 0, 0: the inclusion itself.
  CellFaces cuts;                     ///< faces_cut(); never empty for an image other than itself.

  friend constexpr bool operator==(const ImageInCell&, const ImageInCell&) = default;
};

/// The images whose body, not only its bounding box as in images_in_cell(), meets the cell: in
/// lexicographic order, the inclusion itself among them. The center of any other image lies outside
/// the cell, so that its body, which is convex, meets the cell exactly where it cuts a face.
///
/// Cost: some 0.3 to 1.4 us per image whose box meets the cell; bodies longer than the cell have
/// many, see check_images().
[[nodiscard]] std::vector<ImageInCell> images_reaching_in(const Cell& cell,
                                                          const Inclusion& inclusion);

}  // namespace packstone
