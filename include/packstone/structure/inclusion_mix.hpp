#pragma once

/// @file
/// Orders for groups of inclusions, and the bodies that meet them exactly.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/structure/distribution.hpp"
#include "packstone/structure/orientation_law.hpp"

namespace packstone {

/// What InclusionGroup::size measures.
enum class SizeMeasure {
  relative,     ///< Diameter of the equal-volume ball (disk), up to a factor that count and
                ///< fraction fix. The default law is ConstantLaw{1}.
  equivalent,   ///< Diameter of the ball (disk) of equal volume (area) [L].
  volume,       ///< Volume [L^3], area in 2D [L^2].
  radius,       ///< Radius of sphere, disk, cylinder, spherocylinder [L]; the latter with aspect.
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
  Distribution size;  ///< Law of `measure`; values > 0. May count volume.
  /// Ellipsoid: a/b and a/c. Ellipse: a/b, values >= 1. Cylinder, spherocylinder: length / diameter
  /// (of the straight part). Drawn for each inclusion; values > 0. Unused for sphere and disk. May
  /// count volume for cylinders of constant radius, whose volume grows with it.
  Distribution aspect;
  Distribution aspect_second;
  /// Ellipsoid: `aspect` gives a/b and a/c alike, one value for both (needle above 1, lens below);
  /// aspect_second is then not used.
  bool spheroid = false;
  /// Fixed absolute dimensions, instead of measure, size and aspect (which are then not read):
  /// ellipsoid (a, b, c), ellipse (a, b), cylinder and spherocylinder (radius, half length), sphere
  /// and disk (radius) [L].
  std::optional<Vec3> dimensions;
  OrientationLaw orientation = RandomOrientation{};
};

/// What of an InclusionGroup is at fault.
enum class GroupField { group, shape, count, fraction, size, aspect, orientation };

/// "shape", "count", ...: the words of recipes.
[[nodiscard]] std::string_view name(GroupField field) noexcept;

/// A group that orders what cannot be. Carries whose it is, so that who knows where the group was
/// written can say so.
class InvalidGroup : public InvalidArgument {
 public:
  /// `label`: the start of what(), "group <index>" when empty. `value` of the field, or empty.
  InvalidGroup(const std::string& label, int index, GroupField field, const std::string& value,
               const std::string& why);

  [[nodiscard]] int group() const noexcept { return group_; }
  [[nodiscard]] GroupField field() const noexcept { return field_; }
  /// what() without label, field and value.
  [[nodiscard]] const std::string& why() const noexcept { return why_; }

 private:
  int group_;
  GroupField field_;
  std::string why_;
};

/// One body to place.
struct OrderedBody {
  Body body;
  int group = 0;  ///< Index of its InclusionGroup.
};

/// Gives body k of an endless supply.
using BodySource = std::function<OrderedBody(std::int64_t k)>;

/// The bodies with all lengths multiplied by `factor` > 0.
[[nodiscard]] std::vector<OrderedBody> scaled(std::vector<OrderedBody> bodies, double factor);

/// The bodies of all groups, in the order of the groups, and what was derived on the way.
struct InclusionMix {
  std::vector<OrderedBody> bodies;
  std::vector<std::string> derived;  ///< Sentences for people: "fibers: diameter 0.0412 from ...".
  std::vector<bool> open_count;  ///< Per group: true when size alone was given; no bodies drawn.
};

/// How many inclusions may be drawn.
struct InclusionLimit {
  std::int64_t most = 100'000'000;  ///< In all groups together.
  double bytes_each = 0.0;  ///< What one takes in memory [B], where that is what limits `most`.

  /// "it needs some 40 GB of memory, this machine has 16 GB; allowed are 40000000" for `count`.
  [[nodiscard]] std::string why_not(double count) const;
};

/// Draws sizes, aspects and orientations once, and scales relative sizes so that count and fraction
/// are met exactly (the last few bits of rounding apart).
///
/// Size and fraction given: the count is the integer that comes nearest, and the sizes are kept, so
/// that the fraction is met as nearly as whole bodies can; `derived` says which fraction that is.
///
/// Body i of group g takes the numbers of (seed, g, i): changing another group does not change it.
/// Tensor laws are corrected over the group, see draw_axes().
///
/// Errors:  throws InvalidGroup, before any body is drawn where that can be known, when
///            - a group is under- or over-determined, its shape is not of the dimension of the
///              cell, or its measure not one of its shape;
///            - a law gives values that are not > 0, or counts volume where it may not;
///            - the ordered fractions sum to 1 or more;
///            - one inclusion is more than twice the ordered fraction;
///            - more inclusions are ordered than `limit` allows.
///          Whether the cell can hold what was drawn is another question: standing.hpp.
/// Cost:    1 to 2 us a body.
[[nodiscard]] InclusionMix draw_inclusions(const Cell& cell,
                                           const std::vector<InclusionGroup>& groups,
                                           std::uint64_t seed, const InclusionLimit& limit = {});

/// `count` further bodies of one group with open count: item first, first + 1, ... of its streams.
///
/// Item i depends on (seed, group_index, i) alone, however the calls are split. Tensor laws are
/// therefore not corrected: their sample tensor is off by some 0.4 / sqrt(bodies placed).
///
/// Errors:  as draw_inclusions(), for a group with an absolute size alone.
[[nodiscard]] std::vector<OrderedBody> draw_open_group(const Cell& cell,
                                                       const InclusionGroup& group, int group_index,
                                                       std::int64_t first, std::int64_t count,
                                                       std::uint64_t seed);

}  // namespace packstone
