#include "packstone/structure/inclusion_mix.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/measures.hpp"
#include "structure/mix/group_checks.hpp"
#include "structure/mix/sentences.hpp"

namespace packstone {
namespace {

using mix::check_group;
using mix::check_ordered_counts;
using mix::check_ordered_fractions;
using mix::derived_sentence;
using mix::has_open_count;
using mix::has_second_aspect;
using mix::lengths_text;
using mix::Named;
using mix::open_count_sentence;
using mix::size_power;
using std::numbers::pi;

// The second aspect of a group draws from a stream of its own.
constexpr std::uint64_t kSecondAspect = std::uint64_t{1} << 32;

// What the laws give for one inclusion, before its shape takes a size.
struct Proportions {
  double aspect = 1.0;
  double aspect_second = 1.0;
};

// The shape of unit equivalent diameter, not turned.
Body unit_body(ShapeKind shape, const Proportions& p) {
  switch (shape) {
    case ShapeKind::sphere:
      return Sphere{0.5};
    case ShapeKind::disk:
      return Disk{0.5};
    case ShapeKind::ellipsoid: {
      const double a = 0.5 * std::cbrt(p.aspect * p.aspect_second);
      return Ellipsoid{{a, a / p.aspect, a / p.aspect_second}, {}};
    }
    case ShapeKind::ellipse: {
      const double a = 0.5 * std::sqrt(p.aspect);
      return Ellipse{{a, a / p.aspect}, 0.0};
    }
    case ShapeKind::cylinder: {
      const double r = std::cbrt(1.0 / (12.0 * p.aspect));
      return Cylinder{r, p.aspect * r, {0, 0, 1}};
    }
    case ShapeKind::spherocylinder: {
      const double r = std::cbrt(1.0 / (12.0 * p.aspect + 8.0));
      return Spherocylinder{r, p.aspect * r, {0, 0, 1}};
    }
  }
  PACKSTONE_ASSERT(false);
  return Sphere{};
}

Body fixed_body(ShapeKind shape, const Vec3& d) {
  switch (shape) {
    case ShapeKind::sphere:
      return Sphere{d.x};
    case ShapeKind::disk:
      return Disk{d.x};
    case ShapeKind::ellipsoid:
      return Ellipsoid{d, {}};
    case ShapeKind::ellipse:
      return Ellipse{{d.x, d.y}, 0.0};
    case ShapeKind::cylinder:
      return Cylinder{d.x, d.y, {0, 0, 1}};
    case ShapeKind::spherocylinder:
      return Spherocylinder{d.x, d.y, {0, 0, 1}};
  }
  PACKSTONE_ASSERT(false);
  return Sphere{};
}

// The body that `size` makes of a shape, exact in the field that was measured.
Body sized_body(const InclusionGroup& group, const Proportions& p, double size) {
  const bool rod = is_rod(group.shape);
  if (group.measure == SizeMeasure::radius) {
    return fixed_body(group.shape, {size, rod ? p.aspect * size : 0.0, 0.0});
  }
  if (group.measure == SizeMeasure::half_length) {
    return fixed_body(group.shape, {size / p.aspect, size, 0.0});
  }
  const Body unit = unit_body(group.shape, p);
  if (group.measure != SizeMeasure::volume) return scaled(unit, size);
  const double ratio = size / volume(unit);
  return scaled(unit, dimension(group.shape) == 2 ? std::sqrt(ratio) : std::cbrt(ratio));
}

// Bodies first, first + 1, ... of the group, not yet turned.
std::vector<Body> unturned_bodies(const InclusionGroup& group, int index, std::uint64_t seed,
                                  std::int64_t first, std::int64_t count) {
  const auto size = static_cast<std::size_t>(count);
  if (group.dimensions) return std::vector<Body>(size, fixed_body(group.shape, *group.dimensions));

  const auto stream = static_cast<std::uint64_t>(index);
  const auto values = [&](const Distribution& law, StreamId id, std::uint64_t which, int power) {
    return draw(law, count, seed, id, stream + which, power, first);
  };
  const auto sizes = values(group.size, StreamId::sizes, 0, size_power(group));
  std::vector<double> aspects(size, 1.0), seconds(size, 1.0);
  if (!is_round(group.shape)) aspects = values(group.aspect, StreamId::aspects, 0, 1);
  if (group.spheroid) seconds = aspects;
  if (has_second_aspect(group)) {
    seconds = values(group.aspect_second, StreamId::aspects, kSecondAspect, 1);
  }
  std::vector<Body> bodies;
  bodies.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    bodies.push_back(sized_body(group, {aspects[i], seconds[i]}, sizes[i]));
  }
  return bodies;
}

enum class Correction { exact, none };

// Turns body k to be item first + k of the orientation law.
void turn_in_space(std::vector<Body>& bodies, const InclusionGroup& group, int index,
                   std::uint64_t seed, std::int64_t first, Correction correction) {
  const auto count = static_cast<std::int64_t>(bodies.size());
  const auto stream = static_cast<std::uint64_t>(index);
  const auto axes = correction == Correction::exact
                        ? draw_axes(group.orientation, count, seed, stream)
                        : sample_axes(group.orientation, count, seed, stream, first);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::visit(Overloaded{[&](Ellipsoid& b) {
                            b.orientation =
                                random_turn_about(axes[i], symmetry_axis(b.semi_axes), seed, stream,
                                                  first + static_cast<std::int64_t>(i));
                          },
                          [&](Cylinder& b) { b.axis = axes[i]; },
                          [&](Spherocylinder& b) { b.axis = axes[i]; }, [](auto&) {}},
               bodies[i]);
  }
}

// Ellipses: the major axis is turned, whichever of the two that is.
void turn_in_plane(std::vector<Body>& bodies, const InclusionGroup& group, int index,
                   std::uint64_t seed, std::int64_t first, Correction correction) {
  const auto count = static_cast<std::int64_t>(bodies.size());
  const auto stream = static_cast<std::uint64_t>(index);
  const auto angles = correction == Correction::exact
                          ? draw_angles(group.orientation, count, seed, stream)
                          : sample_angles(group.orientation, count, seed, stream, first);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    auto& ellipse = std::get<Ellipse>(bodies[i]);
    const bool second = ellipse.semi_axes.y > ellipse.semi_axes.x;
    const double angle = second ? angles[i] + 0.5 * pi : angles[i];
    ellipse.angle = angle >= pi ? angle - pi : angle;
  }
}

void turn_bodies(std::vector<Body>& bodies, const InclusionGroup& group, int index,
                 std::uint64_t seed, std::int64_t first, Correction correction) {
  if (is_round(group.shape)) return;
  try {
    const auto turn = group.shape == ShapeKind::ellipse ? turn_in_plane : turn_in_space;
    turn(bodies, group, index, seed, first, correction);
  } catch (const InvalidArgument& problem) {
    Named{group, index}.refuse(GroupField::orientation, "", problem.what());
  }
}

double total_volume(const std::vector<Body>& bodies) {
  CompensatedSum sum;
  for (const Body& body : bodies) sum.add(volume(body));
  return sum.value();
}

void scale_to_volume(std::vector<Body>& bodies, double wanted) {
  const double ratio = wanted / total_volume(bodies);
  const bool plane = dimension(kind(bodies.front())) == 2;
  const double factor = plane ? std::sqrt(ratio) : std::cbrt(ratio);
  for (Body& body : bodies) body = scaled(body, factor);
}

// Bodies after which their mean volume tells a hopeless order from one that takes long.
constexpr std::size_t kEnoughForMean = 1000;

// Of this many times as many bodies as are allowed is said, after kEnoughForMean of them, that
// they are too many. Equal bodies need no such margin.
double certain_excess(const InclusionGroup& group) {
  return group.dimensions || (is_constant(group.size) && is_constant(group.aspect) &&
                              is_constant(group.aspect_second))
             ? 1.0
             : 10.0;
}

// As many bodies as come nearest to the volume `wanted`, drawn until they pass it. `most`: that
// many are left of `limit`.
std::vector<Body> bodies_of_volume(const InclusionGroup& group, int index, std::uint64_t seed,
                                   double wanted, std::int64_t most, const InclusionLimit& limit) {
  const auto refuse = [&](double count) {
    Named{group, index}.refuse(GroupField::fraction, number_text(group.fraction.value_or(0.0)),
                               "it takes some " + number_text(count, 3) +
                                   " inclusions of this size; " +
                                   limit.why_not(static_cast<double>(limit.most - most) + count));
  };
  std::vector<Body> bodies;
  CompensatedSum sum;
  double before = 0.0;
  std::int64_t batch = 1;
  while (true) {
    const auto first = static_cast<std::int64_t>(bodies.size());
    for (const Body& body : unturned_bodies(group, index, seed, first, batch)) {
      before = sum.value();
      bodies.push_back(body);
      sum.add(volume(body));
      if (sum.value() < wanted) continue;
      if (wanted - before < sum.value() - wanted) bodies.pop_back();
      if (static_cast<std::int64_t>(bodies.size()) > most) break;
      return bodies;
    }
    // What the mean volume so far makes of the whole and of the rest, and a little more.
    const auto count = static_cast<double>(bodies.size());
    const double whole = wanted / (sum.value() / count);
    const bool hopeless = bodies.size() >= kEnoughForMean &&
                          whole > certain_excess(group) * static_cast<double>(most) + 1.0;
    if (hopeless || count > static_cast<double>(most)) refuse(whole);
    batch = static_cast<std::int64_t>(
        std::clamp(1.02 * (whole - count) + 16.0, 16.0, 64.0 * count + 16.0));
    batch = std::min(batch, most - static_cast<std::int64_t>(bodies.size()) + 1);
  }
}

std::vector<Body> group_bodies(const Cell& cell, const InclusionGroup& group, int index,
                               std::uint64_t seed, std::int64_t most, const InclusionLimit& limit) {
  const double wanted = group.fraction.value_or(0.0) * volume(cell);
  std::vector<Body> bodies = group.count
                                 ? unturned_bodies(group, index, seed, 0, *group.count)
                                 : bodies_of_volume(group, index, seed, wanted, most, limit);
  if (bodies.empty()) {
    const Body one = unturned_bodies(group, index, seed, 0, 1).front();
    Named{group, index}.refuse(
        GroupField::fraction, number_text(*group.fraction),
        "it is less than half an inclusion; allowed with " + lengths_text({one}) +
            " are fractions >= " + number_text(0.5 * volume(one) / volume(cell)));
  }
  if (group.count && group.fraction) scale_to_volume(bodies, wanted);
  return bodies;
}

}  // namespace

std::string_view name(GroupField field) noexcept {
  constexpr std::string_view names[] = {"group", "shape",  "count",      "fraction",
                                        "size",  "aspect", "orientation"};
  return names[static_cast<int>(field)];
}

InvalidGroup::InvalidGroup(const std::string& label, int index, GroupField field,
                           const std::string& value, const std::string& why)
    : InvalidArgument((label.empty() ? "group " + std::to_string(index) : label) + ": " +
                      (value.empty() ? "" : std::string(name(field)) + " = " + value + "; ") + why),
      group_(index),
      field_(field),
      why_(why) {}

std::string InclusionLimit::why_not(double count) const {
  std::string allowed = "allowed are " + std::to_string(most) + " in all";
  if (bytes_each == 0.0) return allowed;
  const auto gigabytes = [&](double n) { return number_text(1e-9 * n * bytes_each, 3) + " GB"; };
  return "that needs some " + gigabytes(count) + " of memory, this machine has " +
         gigabytes(static_cast<double>(most)) + "; " + allowed;
}

std::vector<OrderedBody> scaled(std::vector<OrderedBody> bodies, double factor) {
  for (OrderedBody& ordered : bodies) ordered.body = scaled(ordered.body, factor);
  return bodies;
}

InclusionMix draw_inclusions(const Cell& cell, const std::vector<InclusionGroup>& groups,
                             std::uint64_t seed, const InclusionLimit& limit) {
  check_cell(cell);
  const int count = static_cast<int>(groups.size());
  for (int g = 0; g < count; ++g) check_group(cell, groups[static_cast<std::size_t>(g)], g);
  check_ordered_fractions(groups);
  check_ordered_counts(groups, limit);

  InclusionMix mix;
  for (int g = 0; g < count; ++g) {
    const InclusionGroup& group = groups[static_cast<std::size_t>(g)];
    mix.open_count.push_back(has_open_count(group));
    if (has_open_count(group)) {
      mix.derived.push_back(open_count_sentence(group, g));
      continue;
    }
    const std::int64_t left = limit.most - static_cast<std::int64_t>(mix.bodies.size());
    std::vector<Body> bodies = group_bodies(cell, group, g, seed, left, limit);
    const double reached = total_volume(bodies) / volume(cell);
    mix.derived.push_back(derived_sentence(group, g, bodies, reached));
    turn_bodies(bodies, group, g, seed, 0, Correction::exact);
    mix.bodies.reserve(mix.bodies.size() + bodies.size());
    for (const Body& body : bodies) mix.bodies.push_back({body, g});
  }
  return mix;
}

std::vector<OrderedBody> draw_open_group(const Cell& cell, const InclusionGroup& group,
                                         int group_index, std::int64_t first, std::int64_t count,
                                         std::uint64_t seed) {
  check_cell(cell);
  check_group(cell, group, group_index);
  if (!has_open_count(group)) {
    Named{group, group_index}.refuse(GroupField::group, "",
                                     "count or fraction is given, allowed here is a size alone");
  }
  std::vector<Body> bodies = unturned_bodies(group, group_index, seed, first, count);
  turn_bodies(bodies, group, group_index, seed, first, Correction::none);
  std::vector<OrderedBody> ordered;
  ordered.reserve(bodies.size());
  for (const Body& body : bodies) ordered.push_back({body, group_index});
  return ordered;
}

}  // namespace packstone
