#pragma once

/// @file
/// How rods are: what decides how densely they pack.

#include <optional>
#include <utility>
#include <vector>

#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// How rods are, where all bodies are rods.
struct RodOrder {
  double aspect = 0.0;    ///< Mean length over mean diameter [-].
  double crossing = 1.0;  ///< <|sin gamma|> over pi / 4, that of random directions [-].
};
[[nodiscard]] std::optional<RodOrder> rod_order(const std::vector<OrderedBody>& bodies);

/// Radius and half length of a cylinder or spherocylinder [L].
[[nodiscard]] std::pair<double, double> rod_sizes(const Body& body);

}  // namespace packstone::recipe
