#include "structure/mix/group_checks.hpp"

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"

namespace packstone::mix {
namespace {

bool has_absolute_size(const InclusionGroup& group) {
  return group.dimensions.has_value() || group.measure != SizeMeasure::relative;
}

void check_positive_law(const Distribution& law, const std::string& what, int power) {
  check_distribution(law, what);
  const double least = support_of(law, power).min;
  if (least > 0.0) return;
  throw InvalidArgument(what + " can be as small as " + number_text(least) +
                        ", allowed are values > 0" +
                        (is_constant(law) ? "" : "; give the law a min > 0"));
}

void check_aspect_law(const Distribution& law, const std::string& what) {
  check_positive_law(law, what, 3);
  if (law.by == Weighting::volume) {
    throw InvalidArgument(what + " counts volume, allowed is by = \"number\"");
  }
}

void check_dimensions(const InclusionGroup& group, const std::string& what) {
  const std::size_t count = group.shape == ShapeKind::ellipsoid ? 3 : is_round(group.shape) ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = (*group.dimensions)[i];
    if (value > 0.0 && std::isfinite(value)) continue;
    const std::string field = is_round(group.shape) || (is_rod(group.shape) && i == 0) ? "radius"
                              : is_rod(group.shape) ? "half length"
                                                    : "semi_axes[" + std::to_string(i) + "]";
    refuse(what, field + " = " + number_text(value) + ", allowed are finite numbers > 0");
  }
}

void check_measure(const InclusionGroup& group, const std::string& what) {
  const bool allowed = group.measure == SizeMeasure::radius
                           ? is_round(group.shape) || is_rod(group.shape)
                       : group.measure == SizeMeasure::half_length ? is_rod(group.shape)
                                                                   : true;
  if (allowed) return;
  refuse(what, std::string(group.measure == SizeMeasure::radius ? "a radius" : "a length") +
                   " does not fix the size of the shape " + std::string(name(group.shape)) +
                   ", allowed are volume, equivalent size" +
                   (is_round(group.shape) ? " and radius" : " and semi-axes"));
}

void check_sizes(const InclusionGroup& group, const std::string& what) {
  if (group.dimensions) {
    check_dimensions(group, what);
    return;
  }
  check_measure(group, what);
  check_positive_law(group.size, what + ": size", size_power(group));
  if (is_round(group.shape)) return;
  check_aspect_law(group.aspect, what + ": aspect");
  if (has_second_aspect(group)) {
    check_aspect_law(group.aspect_second, what + ": aspect (second of the pair)");
  }
}

void check_determined(const InclusionGroup& group, const std::string& what) {
  if (group.count && *group.count < 1) {
    refuse(what, "count = " + std::to_string(*group.count) + ", allowed are counts >= 1");
  }
  if (group.count && *group.count > kMostInclusions) {
    refuse(what, "count = " + std::to_string(*group.count) + ", allowed are counts <= 100000000");
  }
  if (group.fraction && !(*group.fraction > 0.0 && *group.fraction < 1.0)) {
    refuse(what,
           "fraction = " + number_text(*group.fraction) + ", allowed are fractions > 0 and < 1");
  }
  const bool absolute = has_absolute_size(group);
  if (group.count && group.fraction && absolute) {
    refuse(what, "count, fraction and an absolute size are given, allowed are two of the three");
  }
  if (group.count.has_value() != group.fraction.has_value() && !absolute) {
    refuse(what, std::string(group.count ? "count" : "fraction") +
                     " alone does not fix the inclusions, give " +
                     (group.count ? "fraction" : "count") + " or an absolute size too");
  }
  if (has_open_count(group) && !absolute) {
    refuse(what,
           "nothing says how many inclusions there are and how large, give two of count, "
           "fraction and size");
  }
}

}  // namespace

std::string label(const InclusionGroup& group, int index) {
  return group.name.empty() ? "group " + std::to_string(index) : "group '" + group.name + "'";
}

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw InvalidArgument(what + ": " + why);
}

bool is_rod(ShapeKind shape) noexcept {
  return shape == ShapeKind::cylinder || shape == ShapeKind::spherocylinder;
}

bool is_round(ShapeKind shape) noexcept {
  return shape == ShapeKind::sphere || shape == ShapeKind::disk;
}

bool has_second_aspect(const InclusionGroup& group) noexcept {
  return group.shape == ShapeKind::ellipsoid && !group.spheroid;
}

bool has_open_count(const InclusionGroup& group) noexcept {
  return !group.count && !group.fraction;
}

int size_power(const InclusionGroup& group) noexcept {
  return group.measure == SizeMeasure::volume ? 1 : dimension(group.shape);
}

void check_group(const Cell& cell, const InclusionGroup& group, int index) {
  const std::string what = label(group, index);
  if (dimension(group.shape) != cell.dimension) {
    refuse(what, "the shape " + std::string(name(group.shape)) + " does not belong in a " +
                     std::to_string(cell.dimension) + "D cell, allowed are " +
                     (cell.dimension == 2 ? "disk and ellipse"
                                          : "sphere, ellipsoid, cylinder and spherocylinder"));
  }
  check_determined(group, what);
  check_sizes(group, what);
  if (!is_round(group.shape)) {
    check_orientation_law(group.orientation, what + ": orientation", cell.dimension);
  }
}

}  // namespace packstone::mix
