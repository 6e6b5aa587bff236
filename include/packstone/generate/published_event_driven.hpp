#pragma once

/// @file
/// The event-driven method of Ghossein and Levesque as published, for comparison only.
///
/// **Do not pack with it.** Collisions are looked for at equal samples of time, so that some are
/// missed whatever is repaired; what it made has to be checked. Slow on purpose: every step looks
/// at every pair. docs/algorithms/published_event_driven.md counts what goes wrong.
///
/// Ellipsoids start as points in a periodic cell, fly and turn at constant velocities, collide and
/// grow, until they have the sizes ordered. Algorithm by algorithm:
///
///     1   published_event_driven_pack      7   published_face_function
///     2   published_moved                  8   published_face_time
///     3-5 published_ellipsoid_contact.hpp  9   published_impact
///     6   published_contact_time           10  the images of published_event_driven_pack
///
/// Each slip of the paper has a switch of its own, PublishedOptions, printed or corrected. What the
/// paper leaves open is filled in as follows:
///
///   roots      "all roots" are those between n equal samples of the time during which the bounding
///              spheres meet, refined by TOMS 748 (Brent's method with inverse cubic steps).
///   start      the matrices are singular at size 0: bodies start at start_size.
///   images     a body has an image for every set of planes x_k = m L that it crosses; centers are
///              not wrapped, so that nothing changes when one passes such a plane. Only one of the
///              pairs that differ by a common shift is kept.
///   end        no root is looked for after the moment at which the bodies would fill the cell.
///
/// Reference: E. Ghossein, M. Levesque, "Random generation of periodic hard ellipsoids based on
/// molecular dynamics: A computationally-efficient algorithm", J. Comput. Phys. 253 (2013) 471-490.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/geometry/published_ellipsoid_contact.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Options of published_event_driven_pack() and its parts. Name what differs from the defaults.
struct PublishedOptions {
  /// Table 1, where it judges neighborhoods; see published_relation().
  PublishedForm table = PublishedForm::corrected;

  /// Equation (32a). Printed: the largest growth rates of the two semi-axes, in every direction.
  /// Corrected: the speeds at which the two surfaces grow along the normal.
  PublishedForm growth_speed = PublishedForm::corrected;

  /// Lines 4 and 37 of Algorithm 6 (and 6 and 22 of Algorithm 8). Printed: a pair that was skipped,
  /// or without a root, is not looked at again before one of its velocities changes. Corrected: it
  /// carries the time up to which it is known not to collide, and is looked at again from there; so
  /// no root is looked for beyond the next event.
  PublishedForm skipped_pairs = PublishedForm::corrected;

  /// Roots at which eta_1 rises, where bodies part. Printed: collisions as well, among them the one
  /// just dealt with. Corrected: none; and samples start where a touching pair has parted.
  PublishedForm parting_roots = PublishedForm::corrected;

  /// Samples n of an interval of time [-]. >= 1.
  int samples = 30;

  /// Factor mu of the neighborhoods [-]. >= 1.
  double neighborhood = 1.2;

  /// Growth rate of the longest semi-axis of all [cell edges per unit of time]; the other sizes
  /// stay in proportion. > 0. Components of the first velocities are uniform in (-1, 1): cell
  /// edges, and radians, per unit of time.
  double growth_rate = 0.1;

  /// Size at the start over that ordered [-]. In (0, 1).
  double start_size = 1e-3;

  /// Collisions and face crossings after which a run ends. >= 0.
  std::int64_t max_events = 100'000;

  /// Key of every random stream of the run.
  std::uint64_t seed = 0;
};

/// An ellipsoid that flies, turns and grows.
struct MovingEllipsoid {
  Vec3 center{};             ///< [L]
  Quaternion orientation{};  ///< Body frame to cell frame, unit.
  Vec3 velocity{};           ///< [L/T]
  Vec3 angular_velocity{};   ///< In the cell frame [rad/T].
  Vec3 semi_axes{1, 1, 1};   ///< Now [L] > 0.
  Vec3 growth{};             ///< Of each semi-axis [L/T] >= 0.

  friend constexpr bool operator==(const MovingEllipsoid&, const MovingEllipsoid&) = default;
};

/// Its body as it stands.
[[nodiscard]] constexpr Ellipsoid body_of(const MovingEllipsoid& moving) noexcept {
  return {moving.semi_axes, moving.orientation};
}

/// Algorithm 2: where it is `dt` later, equations (8) to (11). The angular velocity stays, which is
/// free motion for bodies of revolution that do not spin, and a simplification for others.
[[nodiscard]] MovingEllipsoid published_moved(const MovingEllipsoid& moving, double dt) noexcept;

/// When two bodies touch from outside for the first time, or nothing if no such time is found up to
/// `horizon` [T], > 0: equations (15) and (16), Algorithm 5, lines 19 to 29 of Algorithm 6. Of the
/// options, parting_roots and samples count. May miss a collision; the time found is one of a pair
/// that is, up to rounding, still apart. Which image of b is meant is for the caller to say.
[[nodiscard]] std::optional<double> published_contact_time(const MovingEllipsoid& a,
                                                           const MovingEllipsoid& b, double horizon,
                                                           const PublishedOptions& options = {});

/// Algorithm 7, equation (23): below 0 where the body cuts the plane x[axis] = plane, 0 where it
/// touches, above 0 where it does not reach it [-]. Evaluated from the center, since absolute
/// coordinates leave nothing of it for small bodies.
[[nodiscard]] double published_face_function(const MovingEllipsoid& moving, std::size_t axis,
                                             double plane) noexcept;

/// When a body that is clear of the plane x[axis] = plane first reaches it, or nothing if no such
/// time is found up to `horizon` [T]: equations (24) and (25), lines 8 to 17 of Algorithm 8.
[[nodiscard]] std::optional<double> published_face_time(const MovingEllipsoid& moving,
                                                        std::size_t axis, double plane,
                                                        double horizon,
                                                        const PublishedOptions& options = {});

/// Algorithm 9: both bodies with their velocities after an elastic collision, at the moment of
/// touching. The twelve equations (29) to (32) leave one unknown, the impulse along the normal; so
/// this is their exact solution.
[[nodiscard]] std::pair<MovingEllipsoid, MovingEllipsoid> published_impact(
    const MovingEllipsoid& a, const MovingEllipsoid& b, PublishedForm growth_speed) noexcept;

/// Why a run stopped. All of these are ordinary outcomes; none is an exception.
enum class PublishedStop {
  target_reached,  ///< The bodies have the sizes ordered.
  most_events,     ///< max_events have passed.
  cancelled,       ///< The run was cancelled.
  out_of_time,     ///< The time limit passed.
};

/// "target_reached", "most_events", ...
[[nodiscard]] std::string_view name(PublishedStop stop) noexcept;

/// What a run did, and what it did not see.
struct PublishedCounts {
  std::int64_t collisions = 0;   ///< Of pairs.
  std::int64_t face_events = 0;  ///< Bodies that reached a plane x_k = m L.
  std::int64_t searches = 0;     ///< Pairs whose roots were looked for.
  std::int64_t skipped = 0;      ///< Pairs set aside by bounding spheres or neighborhoods.
  /// Pairs that came to overlap, by a millionth of their size, with no collision found. Seen by
  /// decide() after every event, all images; what happens in between is not.
  std::int64_t missed = 0;
};

/// What a run produced.
struct PublishedResult {
  Packing packing;  ///< In the order given, at the size reached. May hold overlaps.
  PublishedStop stop = PublishedStop::target_reached;
  double size_factor = 1.0;  ///< Sizes reached over those ordered [-].
  double heating = 1.0;  ///< Kinetic energy over that at the start, both at the sizes ordered [-].
  PublishedCounts counts;
};

/// More bodies than this are refused.
inline constexpr std::size_t kMostPublishedBodies = 500;

/// Algorithm 1: packs ellipsoids and spheres into `cell`, starting from random places in the
/// orientations given.
///
/// Errors:  throws InvalidArgument, before any work, if the cell is not 3D and periodic, a body is
///          of another shape or longer than the shortest edge (Algorithm 10 knows no collision with
///          an own image), there are none or more than kMostPublishedBodies, their volume is not
///          below that of the cell, or an option is out of range.
/// Random:  streams event_driven_centers and event_driven_velocities, keyed by options.seed.
/// Cost:    an event takes a look at all pairs and moves all bodies: some 0.2 ms for 20 bodies.
[[nodiscard]] PublishedResult published_event_driven_pack(const Cell& cell,
                                                          const std::vector<OrderedBody>& bodies,
                                                          const PublishedOptions& options = {},
                                                          RunContext run = {});

}  // namespace packstone
