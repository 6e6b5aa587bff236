#pragma once

/// @file
/// Bodies of any shape that stand.
///
/// Holes and hollows are found by a ball in place of the body, among balls inscribed in those that
/// stand (inscribed_balls.hpp); there the body is put, pushed out of what it overlaps, or lifted if
/// that fails, and let down. So the balls only say where to look, and all contacts are those of the
/// true bodies.
///
/// What one place comes to is independent of all others, so that several threads can try some at
/// once. They are tried in batches of a fixed size: what is known when a batch begins, and so the
/// result, does not depend on how many threads there are.

#include <array>
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
              RandomStream random, int threads);

  std::optional<Vec3> place(const Body& body, const Search& search) override;
  [[nodiscard]] double top() const override { return top_; }
  [[nodiscard]] std::int64_t tests() const override { return pockets_.tests(); }
  void open_floor() override {
    pockets_.open_floor();
    settling_.open_floor();
  }

 private:
  static constexpr std::size_t kUp = D - 1;

  static constexpr std::size_t kBatch = 12;
  using Workspace = typename Settling<D>::Workspace;

  // Pockets that are one and the same: found_[first], ..., found_[last - 1].
  struct Start {
    std::size_t first, last;
  };
  using Outcome = typename Settling<D>::Outcome;
  struct Trial {
    Vec3 center;
    Outcome outcome;
  };

  void list_starts(double guide, const Search& search);
  // Each fills places_.
  void try_pockets(const Mover& mover, double guide, const Search& search);
  void try_columns(const Mover& mover);

  void try_batch(const Mover& mover, std::size_t begin, std::size_t end, int lifts);
  Trial settle_from(const Mover& mover, const Vec3& start, int lifts, double known,
                    Workspace& work) const;
  [[nodiscard]] double lowest_place() const;
  std::optional<Vec3> lowest_clear(const Mover& mover);
  void add(const Body& body, const Mover& mover, const Vec3& center);

  Cell cell_;
  Pockets<D> pockets_;
  Settling<D> settling_;
  RandomStream random_;
  int threads_;
  std::vector<Pocket> found_;
  std::vector<Start> starts_;
  std::array<Trial, kBatch> trials_;
  std::array<Workspace, kBatch> works_;  // One by trial.
  std::vector<Vec3> places_;             // Where the body would come to rest.
  std::int64_t standing_ = 0;
  double top_ = 0.0;
};

}  // namespace packstone::advancing_layer
