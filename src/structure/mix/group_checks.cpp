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

// The volume of bodies is in proportion to their aspect.
bool aspect_is_volume(const InclusionGroup& group) {
  return group.shape == ShapeKind::cylinder && group.measure == SizeMeasure::radius &&
         is_constant(group.size);
}

// In the plane orientations say how the longer axis lies, so an aspect below 1 would only swap the
// two, and hide a law that was meant otherwise.
void check_ellipse_aspect(const Distribution& law) {
  const double least = support_of(law, 1).min;
  if (least >= 1.0) return;
  throw InvalidArgument("aspect can be as small as " + number_text(least) +
                        ", allowed of ellipses are values >= 1, the longer over the shorter "
                        "semi-axis" +
                        (is_constant(law) ? "" : "; give the law a min >= 1"));
}

void check_aspect_law(const Distribution& law, const std::string& what, bool may_count_volume) {
  check_positive_law(law, what, 1);
  if (law.by == Weighting::volume && !may_count_volume) {
    throw InvalidArgument(what +
                          " counts volume, allowed is by = \"number\", except for cylinders of "
                          "one radius");
  }
}

void check_dimensions(const Named& named) {
  const InclusionGroup& group = named.group;
  const std::size_t count = group.shape == ShapeKind::ellipsoid ? 3 : is_round(group.shape) ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = (*group.dimensions)[i];
    if (value > 0.0 && std::isfinite(value)) continue;
    const std::string field = is_round(group.shape) || (is_rod(group.shape) && i == 0) ? "radius"
                              : is_rod(group.shape) ? "half length"
                                                    : "semi_axes[" + std::to_string(i) + "]";
    named.refuse(GroupField::size, "",
                 field + " = " + number_text(value) + ", allowed are finite numbers > 0");
  }
}

void check_measure(const Named& named) {
  const InclusionGroup& group = named.group;
  const bool allowed = group.measure == SizeMeasure::radius
                           ? is_round(group.shape) || is_rod(group.shape)
                       : group.measure == SizeMeasure::half_length ? is_rod(group.shape)
                                                                   : true;
  if (allowed) return;
  named.refuse(GroupField::size, "",
               std::string(group.measure == SizeMeasure::radius ? "a radius" : "a length") +
                   " does not fix the size of the shape " + std::string(name(group.shape)) +
                   ", allowed are volume, equivalent size" +
                   (is_round(group.shape) ? " and radius" : " and semi-axes"));
}

// What `check` throws becomes a complaint about the field.
template <class Check>
void for_field(const Named& named, GroupField field, Check check) {
  try {
    check();
  } catch (const InvalidArgument& problem) {
    named.refuse(field, "", problem.what());
  }
}

void check_sizes(const Named& named) {
  const InclusionGroup& group = named.group;
  if (group.dimensions) return check_dimensions(named);
  check_measure(named);
  for_field(named, GroupField::size,
            [&] { check_positive_law(group.size, "size", size_power(group)); });
  if (is_round(group.shape)) return;
  for_field(named, GroupField::aspect, [&] {
    check_aspect_law(group.aspect, "aspect", aspect_is_volume(group));
    if (group.shape == ShapeKind::ellipse) check_ellipse_aspect(group.aspect);
    if (!has_second_aspect(group)) return;
    check_aspect_law(group.aspect_second, "aspect (second of the pair)", false);
  });
}

void check_determined(const Named& named) {
  const InclusionGroup& group = named.group;
  if (group.count && *group.count < 1) {
    named.refuse(GroupField::count, std::to_string(*group.count), "allowed are counts >= 1");
  }
  if (group.fraction && !(*group.fraction > 0.0 && *group.fraction < 1.0)) {
    named.refuse(GroupField::fraction, number_text(*group.fraction),
                 "allowed are fractions > 0 and < 1");
  }
  const bool absolute = has_absolute_size(group);
  if (group.count && group.fraction && absolute) {
    named.refuse(GroupField::size, "",
                 "count, fraction and an absolute size are given, allowed are two of the three");
  }
  if (group.count.has_value() != group.fraction.has_value() && !absolute) {
    named.refuse(GroupField::group, "",
                 std::string(group.count ? "count" : "fraction") +
                     " alone does not fix the inclusions, give " +
                     (group.count ? "fraction" : "count") + " or an absolute size too");
  }
  if (has_open_count(group) && !absolute) {
    named.refuse(GroupField::group, "",
                 "nothing says how many inclusions there are and how large, give two of count, "
                 "fraction and size");
  }
}

}  // namespace

void Named::refuse(GroupField field, const std::string& value, const std::string& why) const {
  throw InvalidGroup(group.name.empty() ? "" : "group '" + group.name + "'", index, field, value,
                     why);
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
  const Named named{group, index};
  if (dimension(group.shape) != cell.dimension) {
    named.refuse(GroupField::shape, std::string(name(group.shape)),
                 "allowed in a " + std::to_string(cell.dimension) + "D cell are " +
                     (cell.dimension == 2 ? "disk and ellipse"
                                          : "sphere, ellipsoid, cylinder and spherocylinder"));
  }
  check_determined(named);
  check_sizes(named);
  if (is_round(group.shape)) return;
  for_field(named, GroupField::orientation,
            [&] { check_orientation_law(group.orientation, "orientation", cell.dimension); });
}

void check_ordered_fractions(const std::vector<InclusionGroup>& groups) {
  double sum = 0.0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    sum += groups[i].fraction.value_or(0.0);
    if (sum < 1.0) continue;
    Named{groups[i], static_cast<int>(i)}.refuse(
        GroupField::fraction, number_text(*groups[i].fraction),
        "it makes the fractions sum to " + number_text(sum) + "; allowed are sums < 1");
  }
}

void check_ordered_counts(const std::vector<InclusionGroup>& groups, const InclusionLimit& limit) {
  std::int64_t left = limit.most;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::int64_t count = groups[i].count.value_or(0);
    if (count > left) {
      const double all = static_cast<double>(limit.most - left) + static_cast<double>(count);
      Named{groups[i], static_cast<int>(i)}.refuse(GroupField::count, std::to_string(count),
                                                   limit.why_not(all));
    }
    left -= count;
  }
}

}  // namespace packstone::mix
