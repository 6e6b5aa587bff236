#pragma once

/// @file
/// The energy of bodies that overlap, equation (1) of relaxation.hpp, and its gradient.

#include <cstdint>
#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "generate/relaxation/near_pairs.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::relaxation {

/// The energy of one state.
struct Energy {
  double value = 0.0;      ///< [L^2]
  double deepest = 0.0;    ///< Greatest depth [L].
  double most_left = 0.0;  ///< Greatest depth over what may be left of it: at most 1 at rest [-].
  std::int64_t contacts = 0;  ///< Pairs, own images and walls that push.
};

/// Two bodies that push each other, or one and a wall or its own image.
struct Push {
  std::int32_t a = 0;
  std::int32_t b = -1;  ///< Negative: a wall.
  double depth = 0.0;   ///< [L]
};

/// Computes energies. Pairs are looked at by any number of threads; sums are taken in one order.
class OverlapEnergy {
 public:
  OverlapEnergy(const Cell& cell, int threads) : cell_(cell), threads_(threads), pairs_(cell) {}

  /// The energy; sets `gradient`, of the size of a motion. Near pairs are found anew when needed.
  Energy operator()(const Bodies& bodies, Motion& gradient);

  /// Who pushed whom when the energy was last computed.
  [[nodiscard]] std::vector<Push> pushes() const;

  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
  [[nodiscard]] std::int64_t searches() const { return searches_; }

 private:
  struct Contact {
    Push push;
    double allowed = 0.0;  // Depth that may be left [L].
    Vec3 force;            // Gradient by the center of a.
    Vec3 turn_a, turn_b;   // Gradients by the turns, in units of the motion.
  };
  using Contacts = std::vector<Contact>;

  void find_pairs(const Bodies& bodies);
  void look_at_pairs(const Bodies& bodies, std::size_t chunk, Contacts& contacts);
  void look_at_walls(const Bodies& bodies, std::size_t i, Contacts& contacts) const;
  static void add(const Bodies& bodies, const Contact& contact, Motion& gradient, Energy& energy);

  Cell cell_;
  int threads_;
  NearPairs pairs_;
  double margin_ = 0.0;             // Of the near pairs, in the mean over the widths of bodies [L].
  std::int64_t since_search_ = 0;   // Evaluations.
  std::vector<Contacts> contacts_;  // Of each chunk of bodies.
  std::int64_t evaluations_ = 0;
  std::int64_t searches_ = 0;
};

}  // namespace packstone::relaxation
