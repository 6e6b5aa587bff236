#pragma once

/// @file
/// What stands, as the method sees it: where does the next body come to lie?

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::advancing_layer {

/// Items of the stream advancing_layer; the attempt is the trial.
inline constexpr std::uint64_t kOrderItem = 0;   ///< In which order bodies are placed.
inline constexpr std::uint64_t kHeightItem = 1;  ///< From where up holes are looked for.
inline constexpr std::uint64_t kFloorItem = 2;   ///< Where on the floor the first bodies are laid.

/// How to look for a place.
struct Search {
  double from = 0.0;   ///< Height from which to look upward [L].
  int candidates = 1;  ///< Places to compare; the lowest is taken.
  bool holes = false;  ///< Look for holes anywhere, not for the next place in the layer.
};

/// Bodies that stand in a cell.
class Layer {
 public:
  virtual ~Layer() = default;

  /// Places the body; returns its center, in the cell, or nothing where none was found.
  virtual std::optional<Vec3> place(const Body& body, const Search& search) = 0;
  /// Height of the highest top so far, at most that of the cell [L].
  [[nodiscard]] virtual double top() const = 0;
  /// Positions on anchors looked for.
  [[nodiscard]] virtual std::int64_t tests() const = 0;
  /// Along a period, takes the floor away.
  virtual void open_floor() = 0;
};

/// A layer for these bodies, empty. `attempt` keys its random numbers beside `seed`.
[[nodiscard]] std::unique_ptr<Layer> make_layer(const Cell& cell,
                                                const std::vector<OrderedBody>& bodies,
                                                double min_gap, std::uint64_t seed,
                                                std::uint64_t attempt);

/// The balls that stand for a body where a place for it is looked for: radius of one that is about
/// as large [L].
[[nodiscard]] double guide_radius(const Body& body);

}  // namespace packstone::advancing_layer
