#pragma once

/// @file
/// Which method is to make a packing, and why.

#include <optional>
#include <string>
#include <vector>

#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Who places the inclusions.
struct MethodChoice {
  PackMethod method = PackMethod::rsa;  ///< Not automatic.
  std::string reason;                   ///< For people.
  /// relaxation: where a few attempts stall, event-driven dynamics may take over.
  bool may_grow = false;
  /// crowding() of the bodies, where it was asked for.
  std::optional<double> crowded = {};
};

/// The method ordered, or the one whose goal is not the target, or the one that suits the bodies
/// drawn: random sequential adsorption where it surely places all of them; a relaxation up to a
/// crowding of 3.2, and above that for rods of aspect 5 or more, and where orientations are ordered
/// that event-driven dynamics would have to lock; event-driven dynamics otherwise.
///
/// Throws InvalidGroup when bodies in motion are ordered and the count of a group is open.
[[nodiscard]] MethodChoice choose_method(const Recipe& recipe, const InclusionMix& mix);

/// How hard it is for random sequential adsorption to place `bodies`, in the order given or largest
/// first, each with half of `min_gap` [L] around it: up to 1 it surely does, 1 being a fraction of
/// 0.30 of equal spheres and 0.45 of equal disks.
///
/// Body k of volume V, surface S and mean curvature integral M, turned at random, is kept off by
/// one of those before it, j, from the volume
///
///     E_jk = V_j + V_k + (S_j M_k + M_j S_k) / (4 pi),  in the plane A_j + A_k + P_j P_k / (2 pi)
///
/// on the mean (T. Kihara, Rev. Mod. Phys. 25 (1953) 831-843). What counts is the sum of these over
/// the volume that those before leave free, over (E_kk / (2^d V_k))^(1/5): that power makes the
/// measure at saturation alike, within a tenth, for rods and plates of aspects from 0.05 to 30 and
/// ellipses up to 20, and 1 some four fifths of the fraction at which they saturate.
[[nodiscard]] double crowding(const Cell& cell, const std::vector<OrderedBody>& bodies,
                              double min_gap, RsaOrder order);

/// The volume of all bodies, each with half of `min_gap` [L] around it, over that of the cell [-].
[[nodiscard]] double fraction_with_gaps(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                        double min_gap);

}  // namespace packstone::recipe
