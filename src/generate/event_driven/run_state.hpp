#pragma once

/// @file
/// From a packing in motion to the bodies of the engine and back.

#include <cstdint>

#include "generate/event_driven/bodies.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/structure/moving_packing.hpp"

namespace packstone::event_driven {

/// What a run carries on from block to block beside its bodies; MovingPacking::numbers keeps it.
struct Progressed {
  double growth_rate = 0.0;       ///< As in EventDrivenOptions [-].
  double time = 0.0;              ///< [T]
  double collisions = 0.0;        ///< Since the start.
  double since_slower = 0.0;      ///< Collisions per body since the growth rate was lowered.
  double grown = 0.0;             ///< 1: has the size ordered, equilibrium is being simulated.
  double energy = 0.0;            ///< equilibrium: at its begin.
  double still_collisions = 0.0;  ///< equilibrium: collisions since.
  double virial = 0.0;            ///< equilibrium: since.
  double pressure = 0.0;          ///< Reduced, of the last block; 0: not known.
  double still_time = 0.0;        ///< equilibrium: since.
};

[[nodiscard]] Progressed read_numbers(const MovingPacking& state);
void write_numbers(const Progressed& progressed, MovingPacking& state);

/// The bodies as they stand; growth is left at 0.
[[nodiscard]] Bodies bodies_of(const MovingPacking& state, const EventDrivenOptions& options);

/// Brings centers, orientations, velocities and size factor of `state` to those of `bodies`, whose
/// clocks stand at 0.
void store(const Bodies& bodies, MovingPacking& state);

/// Draws velocities and angular velocities of thermal equilibrium, of variance 1 for each component
/// of the velocity of a body.
void draw_velocities(std::uint64_t seed, const EventDrivenOptions& options, MovingPacking& state);

/// Scales velocities to variance 1, angular velocities likewise, each kind by itself. Returns the
/// energy before over that after.
double rescale_velocities(Bodies& bodies, int dimension);

/// Sum over all bodies.
[[nodiscard]] double total_energy(const Bodies& bodies);

/// Degrees of freedom of all bodies that move at all.
struct Freedom {
  double translation = 0.0;
  double rotation = 0.0;
};
[[nodiscard]] Freedom freedom_of(const Bodies& bodies, int dimension);

}  // namespace packstone::event_driven
