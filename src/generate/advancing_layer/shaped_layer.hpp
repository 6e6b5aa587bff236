#pragma once

/// @file
/// Bodies of any shape that stand.
///
/// Holes and hollows are found by a ball in place of the body, among balls inscribed in those that
/// stand (inscribed_balls.hpp); there the body is put, pushed out of what it overlaps, or lifted if
/// that fails, and let down. So the balls only say where to look, and all contacts are those of the
/// true bodies.

#include <cstdint>
#include <vector>

#include "generate/advancing_layer/layer.hpp"
#include "generate/advancing_layer/pockets.hpp"
#include "generate/advancing_layer/settling.hpp"
#include "packstone/core/random.hpp"

namespace packstone::advancing_layer {

/// @tparam D  Dimension of the cell.
template <int D>
class ShapedLayer final : public Layer {
 public:
  ShapedLayer(const Cell& cell, const Expected& expected, std::int64_t bodies, double min_gap,
              RandomStream random);

  std::optional<Vec3> place(const Body& body, const Search& search) override;
  [[nodiscard]] double top() const override { return top_; }
  [[nodiscard]] std::int64_t tests() const override { return pockets_.balls().tests(); }
  void open_floor() override {
    pockets_.open_floor();
    settling_.open_floor();
  }

 private:
  static constexpr std::size_t kUp = D - 1;

  // The ball in place of a body.
  struct Guide {
    double radius;
    int level;
  };
  // Pockets that are one and the same: found_[first], ..., found_[last - 1].
  struct Start {
    std::size_t first, last;
  };

  [[nodiscard]] Guide guide_of(const Body& body) const;
  void list_starts(const Guide& guide, const Search& search);
  // Each lowers lowest_.
  void try_pockets(const Mover& mover, const Guide& guide, const Search& search);
  void try_columns(const Mover& mover);

  bool settle_from(const Mover& mover, const Vec3& start, int lifts);
  [[nodiscard]] double lowest_height() const;
  void add(const Body& body, const Mover& mover, const Vec3& center);

  Cell cell_;
  Pockets<D> pockets_;
  Settling<D> settling_;
  typename Settling<D>::Workspace work_;
  RandomStream random_;
  double least_guide_;
  std::vector<Pocket> found_;
  std::vector<Start> starts_;
  std::optional<Vec3> lowest_;  // Where the body would rest, clear for certain.
  std::int64_t standing_ = 0;
  double top_ = 0.0;
};

}  // namespace packstone::advancing_layer
