#pragma once

/// @file
/// Disks or spheres of one radius, or of very few, that stand.
///
/// For a ball of given radius every place where it may rest is known: what a new ball makes of them
/// is found on its own surface alone, and what it takes away is found out when its turn comes. So
/// the lowest place of all costs no more than the first one.

#include <vector>

#include "generate/advancing_layer/floor_places.hpp"
#include "generate/advancing_layer/layer.hpp"
#include "generate/advancing_layer/standing_balls.hpp"

namespace packstone::advancing_layer {

/// @tparam D  Dimension of the cell.
template <int D>
class EqualLayer final : public Layer {
 public:
  /// @param radii  All radii that will come, ascending [L].
  EqualLayer(const Cell& cell, const Expected& expected, std::vector<double> radii, double min_gap,
             RandomStream random);

  std::optional<Vec3> place(const Body& body, const Search& search) override;
  [[nodiscard]] double top() const override { return balls_.top(); }
  [[nodiscard]] std::int64_t tests() const override { return balls_.tests(); }
  void open_floor() override;

 private:
  static constexpr std::size_t kUp = D - 1;

  struct Place {
    Vec3 center;  // In the cell.
    double height;
    std::int64_t number;  // In the order of finding; decides between equals.
  };
  using Heap = std::vector<Place>;

  std::optional<Vec3> take_lowest(std::size_t which);
  void list_places(std::int32_t anchor);
  void list_near(double height);

  Cell cell_;
  std::vector<double> radii_;
  StandingBalls<D> balls_;
  FloorPlaces<D> floor_;
  std::vector<Heap> heaps_;  // By radius.
  std::int64_t listed_ = 0;
};

}  // namespace packstone::advancing_layer
