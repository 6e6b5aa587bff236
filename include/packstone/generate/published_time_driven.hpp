#pragma once

/// @file
/// The time-driven method of Salnikov, Choi and Karamian-Surville as published, for comparison
/// only.
///
/// **Do not trust what it says of itself.** Its tests of cylinders miss overlaps
/// (published_cylinder_contact.hpp), so that it ends, content, with bodies inside each other; every
/// result carries the verdict of check_packing() beside its own.
/// docs/algorithms/published_time_driven.md counts what is left.
///
/// Spheres and cylinders start at random places, overlaps and all. Overlapping pairs push each
/// other apart with the forces of Table I, under friction and thermostats, until the potential
/// energy, the sum of the squared forces, is gone. All masses are 1, and so is the stiffness: a
/// force is a depth of overlap [L], times force_factor [1/T^2].
///
///     dp/dt = v,   dl/dt = w x l,   dv/dt = sum F - (beta + gamma) v
///     dw/dt = 6 / |l|^2 sum (p_F - p) x F - (beta + gamma) w                                (1)
///     gamma = gamma_B + gamma_NH,   gamma_B = alpha_B (E_kin - N k T / 2)                   (2)
///     d gamma_NH / dt = alpha_NH (E_kin - N k T / 2)                                        (3)
///
/// with N = 3 (spheres) + 5 (cylinders) degrees of freedom; equations (6), (4), (5) of the paper. l
/// is the vector from the center of a cylinder to that of an end. What the print has wrong is
/// repaired unless `literal` is set.
///
/// Reference: V. Salnikov, D. Choi, P. Karamian-Surville, "On efficient and reliable stochastic
/// generation of RVEs for analysis of composites within the framework of homogenization",
/// Comput. Mech. 55 (2015) 127-144, section 4.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/geometry/published_cylinder_contact.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// One line of Table I, at unit stiffness.
struct PublishedForce {
  PublishedContact type = PublishedContact::none;
  Vec3 on_a{};   ///< On the first body; the second one takes the opposite [L].
  Vec3 point{};  ///< Where it applies to both, relative to the center of a [L].
};

/// The forces of a pair: types cd1 to cd3, d1, d2 combine.
class PublishedForces {
 public:
  /// Four disks against a face, four pairs of disks; with parallel axes cc1 besides the former.
  static constexpr std::size_t kMost = 8;

  /// Leaves out what is not finite: the paper divides by 0 here and there.
  void add(const PublishedForce& force) noexcept;
  [[nodiscard]] const PublishedForce* begin() const noexcept { return forces_.data(); }
  [[nodiscard]] const PublishedForce* end() const noexcept { return forces_.data() + count_; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] const PublishedForce& operator[](std::size_t k) const noexcept {
    return forces_[k];
  }

 private:
  std::array<PublishedForce, kMost> forces_{};
  std::size_t count_ = 0;
};

/// Detection by Algorithms 1 to 4, forces by Table I; none where these see no overlap. Bodies are
/// spheres and cylinders. r_ab: center of b minus center of a [L]. `literal`: the printed text,
/// with what it divides by 0 left out; otherwise both are repaired as the docs page lists.
[[nodiscard]] PublishedForces published_forces(const Body& a, const Body& b, const Vec3& r_ab,
                                               bool literal = false) noexcept;

/// How equations (1) are integrated.
enum class TimeDrivenIntegrator {
  velocity_verlet,  ///< Half a kick, drift, half a kick.
  leapfrog,         ///< Velocities half a step behind: kick, drift.
};

/// Options of published_time_driven_pack() and its kin. Name what differs from the defaults. The
/// paper gives none of these values. R is the radius of the ball of mean volume.
struct TimeDrivenOptions {
  /// Algorithms 2 to 4 and Table I as printed, slips and all.
  bool literal = false;

  TimeDrivenIntegrator integrator = TimeDrivenIntegrator::velocity_verlet;

  /// Step of time [T]; two bodies of unit mass that overlap swing at sqrt(2 force_factor) / T. In
  /// (0, 1].
  double time_step = 0.1;

  /// Viscous damping beta [1/T]. >= 0.
  double damping = 1.0;

  /// alpha_B of the Berendsen thermostat, equation (2) [1 / (T R^2 / T^2)]. >= 0; 0: none.
  double berendsen = 0.1;

  /// k T for the Berendsen thermostat [R^2 / T^2]. >= 0; 0 freezes.
  double berendsen_temperature = 0.0;

  /// alpha_NH of the Nose-Hoover thermostat, equation (3) [1 / (T^2 R^2 / T^2)]. >= 0.
  double nose_hoover = 1.0;

  /// k T for the Nose-Hoover thermostat [R^2 / T^2]. >= 0. The paper has one T; with 0 this
  /// thermostat can only freeze, and never reshuffles.
  double nose_hoover_temperature = 0.1;

  /// The run stagnates when this many steps have not brought the energy below its least so far by
  /// the part stagnation_drop. >= 1.
  std::int64_t stagnation_steps = 500;

  /// Part of the energy [-]. In (0, 1).
  double stagnation_drop = 0.5;

  /// How often a run that stagnates goes on with the Nose-Hoover thermostat switched on [-]. >= 0.
  int reshuffles = 3;

  /// How long the thermostat stays on then [steps]. >= 1.
  std::int64_t reshuffle_steps = 500;

  /// Factor on all forces, each time that the energy has halved [-]. >= 1; 1: never.
  double rescale = 2.0;

  /// Most that force_factor becomes [-]. In [1, 1e4]; time_step must then stay below
  /// 1 / sqrt(rescale_limit).
  double rescale_limit = 8.0;

  /// Relaxed once the potential energy per body is below this part of R^2 [-]. >= 0; 0: once there
  /// is none.
  double energy_threshold = 1e-12;

  /// Steps after which a run ends. >= 0.
  std::int64_t max_steps = 20'000;

  /// Steps between two samples of the history. >= 1.
  std::int64_t history_every = 20;

  /// Samples between two that measure the overlap volume, which takes longer than many steps. >= 0;
  /// 0: none does.
  std::int64_t overlap_volume_every = 0;

  /// Points along each edge of the lattice that measures it. Even, in [2, 512].
  int overlap_points = 64;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// Why a run stopped. All of these are ordinary outcomes; none is an exception.
enum class TimeDrivenStop {
  relaxed,        ///< The method sees no overlap any more. There may be some.
  stagnated,      ///< The energy stays where it is, reshuffles used up.
  steps_used_up,  ///< max_steps have passed.
  cancelled,      ///< The run was cancelled.
  out_of_time,    ///< The time limit passed.
};

/// "relaxed", "stagnated", ...
[[nodiscard]] std::string_view name(TimeDrivenStop stop) noexcept;

/// Volume that bodies share, each point counted once less than bodies hold it: what their volumes
/// sum to more than their union.
struct OverlapVolume {
  double value = 0.0;  ///< [L^3]
  double error = 0.0;  ///< Standard error, from the scatter of eight interleaved lattices [L^3].
};

/// Counts the points of a lattice with `points` (even) along each edge, periodic images included.
/// What lies beyond a wall is not seen.
[[nodiscard]] OverlapVolume overlap_volume(const Packing& packing, int points = 64);

/// One line of the history of a run.
struct TimeDrivenSample {
  double time = 0.0;               ///< Since the start [T].
  double potential_energy = 0.0;   ///< Sum of squared forces at unit stiffness [L^2].
  double kinetic_energy = 0.0;     ///< Of masses 1 [L^2 / T^2].
  double force_factor = 1.0;       ///< [1/T^2]
  double friction = 0.0;           ///< gamma of equation (2) [1/T].
  OverlapVolume overlap_volume{};  ///< Zero where it was not measured.
  bool overlap_measured = false;
};

/// What a run produced.
struct TimeDrivenResult {
  Packing packing;  ///< In the order given, with the certificate of check_packing().
  TimeDrivenStop stop = TimeDrivenStop::relaxed;

  // What the method believes.
  double start_energy = 0.0;      ///< Potential energy at the start [L^2].
  double potential_energy = 0.0;  ///< And at the end [L^2].
  double kinetic_energy = 0.0;    ///< At the end [L^2 / T^2].

  // What is true; of walls, Certificate::outside_walls.
  std::int64_t overlaps = 0;  ///< Pairs, with image, that are not proven apart.
  double deepest = 0.0;       ///< Deepest overlap of a pair [L]; 0: none.

  std::int64_t steps = 0;
  int reshuffles = 0;  ///< Times that the Nose-Hoover thermostat was switched on.
  std::vector<TimeDrivenSample> history{};
};

/// More bodies than this are refused.
inline constexpr std::size_t kMostTimeDrivenBodies = 2000;

/// Places spheres and cylinders at random in `cell`, turned as given, and lets them push each other
/// apart. Pairs are looked at in all images, own images included. The paper knows periodic cells
/// only: a wall pushes back, likewise, what crosses it.
///
/// Errors:  throws InvalidArgument, before any work, if the cell is not 3D, a body is of another
///          shape or cannot stand in the cell even alone, there are none or more than
///          kMostTimeDrivenBodies, or an option is out of range.
/// Random:  stream time_driven_centers, keyed by options.seed; the same bits in every run.
/// Cost:    a step looks at every pair: some 0.1 ms for 100 bodies. A disk far flatter than wide
///          asks for a smaller time_step, its moment of inertia being that of its axis alone.
[[nodiscard]] TimeDrivenResult published_time_driven_pack(const Cell& cell,
                                                          const std::vector<OrderedBody>& bodies,
                                                          const TimeDrivenOptions& options = {},
                                                          RunContext run = {});

/// The same from where the inclusions of `start` stand.
[[nodiscard]] TimeDrivenResult published_time_driven_relax(Packing start,
                                                           const TimeDrivenOptions& options = {},
                                                           RunContext run = {});

}  // namespace packstone
