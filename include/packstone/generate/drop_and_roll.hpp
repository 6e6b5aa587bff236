#pragma once

/// @file
/// Optimized dropping and rolling: let each ball fall k times, keep the lowest of its places.
///
/// A ball of radius R is let go above a random column. It falls until it touches one that stands,
/// and rolls down about it: its center c moves on the circle of radius rho = R + r about the center
/// of the other, or, held by two in 3D, on the circle on which their spheres of radii rho_1, rho_2
/// meet. With m the middle of the circle, h its radius, e_1 its uphill direction and e_2 across,
///
///     c(t) = m + h (cos t e_1 + sin t e_2),    t from its present value upward                (1)
///
/// until it meets a further ball of center q and reach rho_q, where w = q - m,
///
///     2 h (cos t w.e_1 + sin t w.e_2) = h^2 + w^2 - rho_q^2                                   (2)
///
/// or a wall or the floor, or until a contact no longer carries it. Which of the contacts n_i
/// (unit, toward the ball) carry is decided by where gravity g leads among them:
///
///     v = g + sum lambda_i n_i,   v.n_i >= 0,   lambda_i >= 0,   lambda_i v.n_i = 0           (3)
///
/// The ball rests where v = 0: on two in the plane, three in space, walls counted, or on the floor.
/// Where no contact carries it falls again.

#include <cstdint>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/constructive.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone {

/// Options of drop_and_roll_pack() and its kin. Name what differs from the defaults.
struct DropAndRollOptions {
  /// Times that each ball is dropped; the lowest place is taken [-]. In [1, 10000].
  int drops = 4;

  /// Least surface-to-surface gap between two balls [L]; none is kept to walls. >= 0.
  double min_gap = 0.0;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// Drops the disks or spheres `bodies` into `cell`, in the order given.
///
/// Good for: loose heaps as gravity makes them, from any law of sizes, quickly; a comparator.
/// Not for:  the densest packings. Balls reach only what is accessible from above, holes stay.
///
/// Contacts are left open by 1e-12 of the sum of the radii and a few roundings of a coordinate of
/// the cell, so that every pair is provably apart.
///
/// Errors:  throws InvalidArgument, before any work, if an option is out of range, a body is
///          neither disk nor sphere or cannot stand in the cell even alone, or the cell is periodic
///          along the vertical axis.
/// Random:  stream drop_and_roll, keyed by options.seed; body k takes item k.
/// Cost:    some 1 us per drop in 2D, 4 us in 3D, with little regard to the number of bodies.
/// @post    check_packing(result.packing, {.min_gap = options.min_gap}) passes.
///
/// Reference: K. Hitti, M. Bernacki, Appl. Math. Model. 37 (2013) 5715-5722, as described by D. N.
/// Ilin, M. Bernacki, MATEC Web of Conferences 80 (2016) 02004.
[[nodiscard]] ConstructiveResult drop_and_roll_pack(const Cell& cell,
                                                    const std::vector<OrderedBody>& bodies,
                                                    const DropAndRollOptions& options = {},
                                                    RunContext run = {});

/// The same from an endless supply, until the first ball that has no position. One that could not
/// stand in the cell even alone ends the run too, unless it is the first: that is refused.
[[nodiscard]] ConstructiveResult drop_and_roll_fill(const Cell& cell, const BodySource& source,
                                                    const DropAndRollOptions& options = {},
                                                    RunContext run = {});

}  // namespace packstone
