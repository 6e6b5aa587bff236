#pragma once

/// @file
/// One attempt at placing all bodies of a list.

#include <cstdint>
#include <optional>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/advancing_layer.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::advancing_layer {

/// Which bodies come last.
enum class Held {
  sample,    ///< Some of all sizes: sizes stay spread evenly over the height.
  smallest,  ///< Denser.
};

/// Volume of the sample over that of all bodies [-].
inline constexpr double kSampled = 0.03;

/// AdvancingLayerOptions with what was absent chosen for these bodies.
struct Plan {
  double min_gap = 0.0;
  double top_layer = 0.0;
  int candidates = 0;
  int hole_candidates = 0;  ///< The same for bodies that are held back.
  Held held = Held::smallest;
  double held_back = 0.0;         ///< Part of the volume, where the smallest are held back.
  double held_back_growth = 1.0;  ///< Factor on that from attempt to attempt.
  bool close_top = true;
  bool in_order = false;  ///< Bodies are placed in the order given.
  std::uint64_t seed = 0;
};

[[nodiscard]] Plan plan_for(const AdvancingLayerOptions& options,
                            const std::vector<OrderedBody>& bodies);

/// What an attempt has placed.
struct Placement {
  std::vector<std::optional<Vec3>> centers;  ///< By body.
  double placed = 0.0;                       ///< Volume of those that stand [L^3] ([L^2]).
  double missing = 0.0;                      ///< Of those that found no place.
  bool hopeless = false;                     ///< Far more was ordered than there is room for.
  double top = 0.0;  ///< Highest point of those that were not held back [L].
  std::int64_t tests = 0;
  StopRequest stop = StopRequest::none;  ///< Then the rest was not tried.
};

/// Places `bodies` in a random order, what is held back last.
///
/// @param attempt  Number of the attempt: keys the order.
/// @param is_last  Whether to go on when one has found no place; others end there, unless it is
///                 hopeless.
[[nodiscard]] Placement attempt(const Cell& cell, const std::vector<OrderedBody>& bodies,
                                const Plan& plan, std::uint64_t attempt, bool is_last,
                                RunContext& run);

}  // namespace packstone::advancing_layer
