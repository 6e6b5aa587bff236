#pragma once

/// @file
/// How dense a packing is: over the whole cell, in a window away from its boundaries, slab by slab,
/// and what walls, floor and top cost.
///
/// A wall cuts bodies off, and what was packed on a floor ends in an uneven top; so the fraction of
/// the whole cell is that of the packing only in large cells. With phi the fraction in a window
/// that keeps away from all boundaries, and phi(x) that of a thin slab at distance x from a wall,
/// the window being a distance X away from it, the deficit of the wall is
///
///     D = integral of (phi - phi(x)) dx from 0 to X                                        (1)
///
/// a length: the thickness of a layer of the packing that the wall costs per unit of its area.
/// Slabs are as wide as the window along the other axes, so that no other boundary has a part in
/// phi(x). Of a column through the window, of length L, that ends at two boundaries,
///
///     fraction of the column = phi - (D_1 + D_2) / L                                       (2)
///
/// holds exactly. The vertical axis is y in 2D, z in 3D: where it is not periodic, its low wall is
/// a floor, its high one a ceiling, and the highest point of all bodies the top of what stands.
///
/// Nothing is sampled: all fractions are sums of parts of bodies in boxes (clipped_volume.hpp).
/// Where bodies overlap, both count.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Options of measure_density(). Half widths are circumscribed radii.
struct DensityOptions {
  /// Distance of the window from walls, floor and ceiling [L]. >= 0. Absent: two of the largest
  /// half width.
  std::optional<double> wall_margin = {};

  /// Distance of the window from the top of what stands [L]. >= 0. Absent: four of the largest
  /// half width.
  std::optional<double> top_margin = {};

  /// Width of the slabs, at most [L]. > 0, and no less than a millionth of the longest edge of the
  /// cell. Absent: a quarter of the largest half width, at most some 10 000 slabs along an axis.
  std::optional<double> bin_width = {};
};

/// A box with edges along the axes [L]; z means nothing in 2D.
struct Window {
  Vec3 lo;
  Vec3 hi;

  friend bool operator==(const Window&, const Window&) = default;
};

/// A fraction in a window.
struct WindowFraction {
  double value = 0.0;  ///< Volume of the bodies in the window over that of the window [-].
  /// Bound on the error of value [-]: that of the parts of bodies (clipped_volume.hpp), and
  /// rounding. Says nothing about how other packings of the kind scatter.
  double error = 0.0;

  friend bool operator==(const WindowFraction&, const WindowFraction&) = default;
};

/// The fraction away from all boundaries.
struct InteriorDensity {
  Window window;  ///< From 0 to the edge of the cell along periodic axes.
  WindowFraction fraction;

  friend bool operator==(const InteriorDensity&, const InteriorDensity&) = default;
};

/// Fractions of slabs across one axis.
struct DensityProfile {
  int axis = 0;                ///< 0, 1, 2 for x, y, z.
  std::vector<double> edges;   ///< Ends of the slabs, ascending from 0 to the edge of the cell [L].
                               ///< Walls, ends of the window and the top of what stands are among
                               ///< them; above that top there is one slab.
  std::vector<double> whole;   ///< Per slab, over the whole section of the cell [-]. What reaches
                               ///< through a wall beside a slab counts in it.
  std::vector<double> window;  ///< Per slab, over the section of the window [-]; empty without one.

  friend bool operator==(const DensityProfile&, const DensityProfile&) = default;
};

/// What ends a packing.
enum class Boundary {
  wall,     ///< Across a horizontal axis.
  floor,    ///< The low wall across the vertical axis.
  ceiling,  ///< The high one: what the cell has above the top counts as empty.
  top,      ///< The top of what stands.
};

/// What a boundary costs, equation (1), from the `window` fractions of the profile along its axis.
struct BoundaryDeficit {
  Boundary boundary = Boundary::wall;
  int axis = 0;           ///< Across which it stands.
  double position = 0.0;  ///< Where along that axis [L].
  double length = 0.0;    ///< D [L]; negative where it is denser there than inside.
  /// The most that D changes where the integral goes on into the window, by up to two of the
  /// largest half width and not beyond its middle [L]: what the choice of the margin matters.
  double spread = 0.0;

  friend bool operator==(const BoundaryDeficit&, const BoundaryDeficit&) = default;
};

/// How dense a packing is.
struct DensityReport {
  std::int64_t count = 0;           ///< Inclusions.
  double largest_half_width = 0.0;  ///< Largest circumscribed radius [L]; 0 where there is none.
  double fraction = 0.0;            ///< Volume of all bodies over that of the cell [-].

  /// The highest point of all bodies along the vertical axis, not above the ceiling [L]; absent
  /// where that axis is periodic or nothing stands.
  std::optional<double> top;
  std::optional<double> fraction_below_top;  ///< fraction, over the part of the cell below top [-].

  std::optional<InteriorDensity> interior;
  std::string why_no_interior;  ///< A sentence, where there is none: the packing is too small.

  std::vector<DensityProfile> profiles;  ///< One along each axis.
  std::vector<BoundaryDeficit>
      deficits;  ///< By axis, position and boundary; none without interior.

  friend bool operator==(const DensityReport&, const DensityReport&) = default;
};

/// Measures how dense `packing` is; see above. Reports progress; does not stop half-way.
///
/// Properties: a shift along a periodic axis changes nothing but the profile along it, rounding
///             apart; equation (2).
/// Errors:     throws InvalidArgument if the packing is not well formed, an option is out of range,
///             or an inclusion is longer than 500 periods.
/// Cost:       some 1 us per inclusion; bodies on the rim of the window in space some 100 us more.
///             Parallel over inclusions; the result does not depend on the number of threads.
[[nodiscard]] DensityReport measure_density(const Packing& packing,
                                            const DensityOptions& options = {},
                                            RunContext run = {});

/// The fraction in a window of your own. Along periodic axes it may stand anywhere.
///
/// Properties: of windows that fill another one, the fractions, weighted by volume, add up to its.
/// Errors:     throws InvalidArgument if the packing is not well formed, or the window is empty,
///             not finite, reaches through a wall or is longer than a period; or as above.
[[nodiscard]] WindowFraction fraction_in_window(const Packing& packing, const Window& window,
                                                const RunContext& run = {});

}  // namespace packstone
