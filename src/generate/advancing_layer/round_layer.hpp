#pragma once

/// @file
/// Disks or spheres that stand.

#include <vector>

#include "generate/advancing_layer/floor_places.hpp"
#include "generate/advancing_layer/layer.hpp"
#include "generate/advancing_layer/pockets.hpp"

namespace packstone::advancing_layer {

/// @tparam D  Dimension of the cell.
template <int D>
class RoundLayer final : public Layer {
 public:
  RoundLayer(const Cell& cell, const Expected& expected, double min_gap, RandomStream random);

  std::optional<Vec3> place(const Body& body, const Search& search) override;
  [[nodiscard]] double top() const override { return pockets_.balls().top(); }
  [[nodiscard]] std::int64_t tests() const override { return pockets_.balls().tests(); }
  void open_floor() override { pockets_.open_floor(); }

 private:
  static constexpr std::size_t kUp = D - 1;

  std::optional<Vec3> lowest_found(double radius);

  Cell cell_;
  double largest_;
  Pockets<D> pockets_;
  FloorPlaces<D> floor_;
  std::vector<Pocket> found_;
};

}  // namespace packstone::advancing_layer
