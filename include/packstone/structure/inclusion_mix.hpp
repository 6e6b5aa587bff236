#pragma once

/// @file
/// Orders for groups of inclusions, and the bodies that meet them exactly.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/structure/distribution.hpp"
#include "packstone/structure/orientation_law.hpp"

namespace packstone {

/// What SizeLaw::law measures.
enum class SizeMeasure {
  relative,     ///< Diameter of the equal-volume ball (disk), up to a factor that count and
                ///< fraction fix. The default law is ConstantLaw{1}.
  equivalent,   ///< Diameter of the ball (disk) of equal volume (area) [L].
  volume,       ///< Volume [L^3], area in 2D [L^2].
  radius,       ///< Radius of sphere, disk, cylinder, spherocylinder [L].
  half_length,  ///< Half length of cylinder or half straight part of spherocylinder [L]; with
                ///< aspect.
};

/// One `[[inclusions]]` table: how many, how large, of what shape, turned how.
///
/// Two of count, fraction and an absolute size fix the third. With count and fraction the size law
/// is relative. With an absolute size alone the count stays open (methods that fill the cell).
struct InclusionGroup {
  std::string name;
  ShapeKind shape = ShapeKind::sphere;
  std::optional<std::int64_t> count;  ///< >= 1.
  std::optional<double> fraction;     ///< Volume of the group over that of the cell [-], in (0, 1).
  SizeMeasure measure = SizeMeasure::relative;
  Distribution size;  ///< Law of `measure`.
  /// Ellipsoid: a/b and a/c. Ellipse: a/b. Cylinder, spherocylinder: length / diameter (of the
  /// straight part). Unused for sphere and disk.
  Distribution aspect;
  Distribution aspect_second;
  /// Ellipsoid: `aspect` gives a/b and a/c alike, one value for both (needle above 1, lens below);
  /// aspect_second is then not used.
  bool spheroid = false;
  /// Fixed absolute dimensions, instead of measure, size and aspect: ellipsoid (a, b, c), ellipse
  /// (a, b), cylinder and spherocylinder (radius, half length) [L].
  std::optional<Vec3> dimensions;
  OrientationLaw orientation = RandomOrientation{};
};

/// One body to place.
struct OrderedBody {
  Body body;
  int group = 0;  ///< Index of its InclusionGroup.
};

/// The bodies of all groups, in the order of the groups, and what was derived on the way.
struct InclusionMix {
  std::vector<OrderedBody> bodies;
  std::vector<std::string> derived;  ///< Sentences for people: "fibers: diameter 0.0412 from ...".
  std::vector<bool> open_count;  ///< Per group: true when size alone was given; no bodies drawn.
};

/// Draws sizes, aspects and orientations once, and scales relative sizes so that count and fraction
/// are met exactly (the last few bits of rounding apart).
///
/// Size and fraction given: the count is the integer that comes nearest, and the sizes are kept, so
/// that the fraction is met as nearly as whole bodies can; `derived` says which fraction that is.
///
/// Errors:  throws InvalidArgument when a group is under- or over-determined, of the wrong
/// dimension,
///          has a law that gives values that are not > 0, or the fractions sum above 1.
[[nodiscard]] InclusionMix draw_inclusions(const Cell& cell,
                                           const std::vector<InclusionGroup>& groups,
                                           std::uint64_t seed);

/// `count` further bodies of one group with open count: item first, first + 1, ... of its streams.
[[nodiscard]] std::vector<OrderedBody> draw_open_group(const Cell& cell,
                                                       const InclusionGroup& group, int group_index,
                                                       std::int64_t first, std::int64_t count,
                                                       std::uint64_t seed);

}  // namespace packstone
