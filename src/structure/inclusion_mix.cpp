#include "packstone/structure/inclusion_mix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

constexpr std::int64_t kMostInclusions = 100'000'000;
// The second aspect of a group draws from a stream of its own.
constexpr std::uint64_t kSecondAspect = std::uint64_t{1} << 32;

// --- words for messages ------------------------------------------------------------------------

std::string label(const InclusionGroup& group, int index) {
  return group.name.empty() ? "group " + std::to_string(index) : "group '" + group.name + "'";
}

std::string plain_label(const InclusionGroup& group, int index) {
  return group.name.empty() ? "group " + std::to_string(index) : group.name;
}

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw InvalidArgument(what + ": " + why);
}

bool is_rod(ShapeKind shape) {
  return shape == ShapeKind::cylinder || shape == ShapeKind::spherocylinder;
}

bool is_round(ShapeKind shape) { return shape == ShapeKind::sphere || shape == ShapeKind::disk; }

bool has_second_aspect(const InclusionGroup& group) {
  return group.shape == ShapeKind::ellipsoid && !group.spheroid;
}

bool has_absolute_size(const InclusionGroup& group) {
  return group.dimensions.has_value() || group.measure != SizeMeasure::relative;
}

bool has_open_count(const InclusionGroup& group) { return !group.count && !group.fraction; }

// --- checks of one group -----------------------------------------------------------------------

// The power of the size that volume grows with.
int size_power(const InclusionGroup& group) {
  return group.measure == SizeMeasure::volume ? 1 : dimension(group.shape);
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

// --- drawing -----------------------------------------------------------------------------------

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
    refuse(label(group, index), problem.what());
  }
}

// Sum with the rounding error carried along: A. Neumaier, Z. Angew. Math. Mech. 54 (1974) 39-51.
class CarefulSum {
 public:
  void add(double x) {
    const double next = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
    sum_ = next;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

double total_volume(const std::vector<Body>& bodies) {
  CarefulSum sum;
  for (const Body& body : bodies) sum.add(volume(body));
  return sum.value();
}

void scale_to_volume(std::vector<Body>& bodies, double wanted) {
  const double ratio = wanted / total_volume(bodies);
  const bool plane = dimension(kind(bodies.front())) == 2;
  const double factor = plane ? std::sqrt(ratio) : std::cbrt(ratio);
  for (Body& body : bodies) body = scaled(body, factor);
}

// As many bodies as come nearest to the volume `wanted`, drawn until they pass it.
std::vector<Body> bodies_of_volume(const InclusionGroup& group, int index, std::uint64_t seed,
                                   double wanted) {
  std::vector<Body> bodies;
  CarefulSum sum;
  double before = 0.0;
  std::int64_t batch = 1;
  while (true) {
    const auto first = static_cast<std::int64_t>(bodies.size());
    if (first >= kMostInclusions) {
      refuse(label(group, index), "fraction = " + number_text(*group.fraction) +
                                      " is not reached by 100000000 inclusions of this size");
    }
    for (const Body& body : unturned_bodies(group, index, seed, first, batch)) {
      before = sum.value();
      bodies.push_back(body);
      sum.add(volume(body));
      if (sum.value() < wanted) continue;
      if (wanted - before < sum.value() - wanted) bodies.pop_back();
      return bodies;
    }
    // What the mean volume so far makes of the rest, and a little more.
    const double rest = (wanted - sum.value()) / (sum.value() / static_cast<double>(bodies.size()));
    batch = static_cast<std::int64_t>(
        std::clamp(1.02 * rest + 16.0, 16.0, 64.0 * static_cast<double>(bodies.size()) + 16.0));
    batch = std::min(batch, kMostInclusions - static_cast<std::int64_t>(bodies.size()) + 1);
  }
}

// --- sentences ---------------------------------------------------------------------------------

// The lengths that people name a shape by, and their names.
Vec3 lengths_of(const Body& body) {
  return std::visit(Overloaded{[](const Ellipsoid& b) { return b.semi_axes; },
                               [](const Ellipse& b) { return lift(b.semi_axes); },
                               [](const Cylinder& b) {
                                 return Vec3{2.0 * b.radius, 2.0 * b.half_length, 0.0};
                               },
                               [](const Spherocylinder& b) {
                                 return Vec3{2.0 * b.radius, 2.0 * b.half_length, 0.0};
                               },
                               [](const auto& b) {
                                 return Vec3{2.0 * b.radius, 0.0, 0.0};
                               }},
                    body);
}

std::vector<std::string> length_names(ShapeKind shape) {
  switch (shape) {
    case ShapeKind::ellipsoid:
      return {"semi-axis a", "semi-axis b", "semi-axis c"};
    case ShapeKind::ellipse:
      return {"semi-axis a", "semi-axis b"};
    case ShapeKind::cylinder:
      return {"diameter", "length"};
    case ShapeKind::spherocylinder:
      return {"diameter", "straight length"};
    case ShapeKind::sphere:
    case ShapeKind::disk:
      break;
  }
  return {"diameter"};
}

// "diameter 0.08 and length 0.4", with "0.08 to 0.1" where they differ.
std::string lengths_text(const std::vector<Body>& bodies) {
  Vec3 least = lengths_of(bodies.front());
  Vec3 most = least;
  for (const Body& body : bodies) {
    const Vec3 lengths = lengths_of(body);
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], lengths[i]);
      most[i] = std::max(most[i], lengths[i]);
    }
  }
  const std::vector<std::string> names = length_names(kind(bodies.front()));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i] + " " + number_text(least[i]);
    if (most[i] - least[i] > 1e-9 * most[i]) text += " to " + number_text(most[i]);
  }
  return text;
}

std::string derived_sentence(const Cell& cell, const InclusionGroup& group, int index,
                             const std::vector<Body>& bodies) {
  const std::string start = plain_label(group, index) + ": ";
  const std::string lengths = lengths_text(bodies);
  const std::string count = "count " + std::to_string(bodies.size());
  const double reached = total_volume(bodies) / volume(cell);
  if (group.count && group.fraction) {
    return start + lengths + (is_round(group.shape) ? " follows" : " follow") + " from " + count +
           " and fraction " + number_text(*group.fraction);
  }
  if (group.count) {
    return start + "fraction " + number_text(reached) + " follows from " + count + " and " +
           lengths;
  }
  return start + count + " follows from fraction " + number_text(*group.fraction) + " and " +
         lengths + "; whole inclusions make it fraction " + number_text(reached);
}

// --- checks of what was drawn ------------------------------------------------------------------

// Squared distance of p to the segment from -h u to h u.
double segment_distance_sq(const Vec3& p, const Vec3& u, double h) {
  return norm_sq(p - std::clamp(dot(p, u), -h, h) * u);
}

// True when p lies inside the body about the origin, by more than rounding.
bool holds(const Body& body, const Vec3& p) {
  constexpr double inside = 1.0 - 1e-12;
  return std::visit(
      Overloaded{[&](const Ellipsoid& b) {
                   const Vec3 q = mul_transposed(to_matrix(b.orientation), p);
                   return norm_sq(unscale(q, b.semi_axes)) < inside;
                 },
                 [&](const Cylinder& b) {
                   const double along = dot(p, b.axis);
                   return std::abs(along) < inside * b.half_length &&
                          norm_sq(p - along * b.axis) < inside * b.radius * b.radius;
                 },
                 [&](const Spherocylinder& b) {
                   return segment_distance_sq(p, b.axis, b.half_length) <
                          inside * b.radius * b.radius;
                 },
                 [&](const Ellipse& b) {
                   const double c = std::cos(b.angle), s = std::sin(b.angle);
                   const Vec2 q{c * p.x + s * p.y, c * p.y - s * p.x};
                   return norm_sq(Vec2{q.x / b.semi_axes.x, q.y / b.semi_axes.y}) < inside;
                 },
                 [&](const auto& b) { return norm_sq(p) < inside * b.radius * b.radius; }},
      body);
}

std::string lengths_text(const Body& body) { return lengths_text(std::vector<Body>{body}); }

// One of each pair of opposite images that a body of the given reach may meet, the origin left out.
std::vector<std::array<int, 3>> half_of_images(const Cell& cell, double reach) {
  std::array<int, 3> most{0, 0, 0};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (!cell.periodic[axis]) continue;
    // Fibers of more than 64 periods are left to the placement, which meets the rest.
    most[axis] = static_cast<int>(std::min(64.0, std::ceil(reach / cell.size[axis]) - 1.0));
  }
  std::vector<std::array<int, 3>> images;
  for (int i = 0; i <= most[0]; ++i) {
    for (int j = i == 0 ? 0 : -most[1]; j <= most[1]; ++j) {
      for (int k = i == 0 && j == 0 ? 1 : -most[2]; k <= most[2]; ++k) images.push_back({i, j, k});
    }
  }
  return images;
}

// A centrally symmetric body meets its image at s exactly when s / 2 lies inside it.
void check_own_images(const Cell& cell, const Body& body) {
  const double reach = 2.0 * circum_radius(body);
  if (reach <= std::min({cell.size.x, cell.size.y, cell.dimension == 2 ? reach : cell.size.z})) {
    return;
  }
  std::array<int, 3> nearest{};
  double least = std::numeric_limits<double>::infinity();
  for (const std::array<int, 3>& image : half_of_images(cell, reach)) {
    const Vec3 shift = image_shift(cell, image);
    if (norm_sq(shift) >= least || !holds(body, 0.5 * shift)) continue;
    least = norm_sq(shift);
    nearest = image;
  }
  if (!std::isfinite(least)) return;
  throw InvalidArgument(lengths_text(body) + " overlaps its own periodic image [" +
                        std::to_string(nearest[0]) + ", " + std::to_string(nearest[1]) + ", " +
                        std::to_string(nearest[2]) + "]; make it smaller or the cell larger");
}

void check_walls(const Cell& cell, const Body& body) {
  const Vec3 half = half_extents(body);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (cell.periodic[axis] || 2.0 * half[axis] <= cell.size[axis] * (1.0 + 1e-12)) continue;
    throw InvalidArgument(lengths_text(body) + ", turned as drawn, is " +
                          number_text(2.0 * half[axis]) + " wide along " + "xyz"[axis] +
                          ", allowed between the walls is " + number_text(cell.size[axis]));
  }
}

void check_bodies(const Cell& cell, const InclusionGroup& group, int index,
                  const std::vector<Body>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    try {
      check_walls(cell, bodies[i]);
      check_own_images(cell, bodies[i]);
    } catch (const InvalidArgument& problem) {
      refuse(label(group, index) + ": inclusion " + std::to_string(i), problem.what());
    }
  }
}

// Highest fraction that bodies all congruent can have at all.
double densest(ShapeKind shape) {
  switch (shape) {
    case ShapeKind::sphere:
      return pi / std::sqrt(18.0);
    case ShapeKind::disk:
    case ShapeKind::ellipse:
      return pi / std::sqrt(12.0);
    default:
      return 1.0;
  }
}

bool all_congruent(const std::vector<OrderedBody>& bodies) {
  const Vec3 first = lengths_of(bodies.front().body);
  return std::all_of(bodies.begin(), bodies.end(), [&](const OrderedBody& b) {
    return kind(b.body) == kind(bodies.front().body) && lengths_of(b.body) == first;
  });
}

void check_total(const Cell& cell, const std::vector<OrderedBody>& bodies) {
  if (bodies.empty()) return;
  CarefulSum sum;
  for (const OrderedBody& b : bodies) sum.add(volume(b.body));
  const double reached = sum.value() / volume(cell);
  if (reached >= 1.0) {
    throw InvalidArgument("the inclusions ask for fraction " + number_text(reached) +
                          " in total, allowed are totals < 1");
  }
  const ShapeKind shape = kind(bodies.front().body);
  const double bound = densest(shape);
  // Rounding of the sizes apart.
  if (reached <= bound * (1.0 + 1e-12) || !all_congruent(bodies)) return;
  throw InvalidArgument("equal inclusions of the shape " + std::string(name(shape)) +
                        " ask for fraction " + number_text(reached) +
                        ", allowed are fractions <= " + number_text(bound) +
                        ", the densest packing there is");
}

void check_ordered_fractions(const std::vector<InclusionGroup>& groups) {
  double sum = 0.0;
  for (const InclusionGroup& group : groups) sum += group.fraction.value_or(0.0);
  if (sum < 1.0) return;
  throw InvalidArgument("the fractions of the groups sum to " + number_text(sum) +
                        ", allowed are sums < 1");
}

std::vector<Body> group_bodies(const Cell& cell, const InclusionGroup& group, int index,
                               std::uint64_t seed) {
  const double wanted = group.fraction.value_or(0.0) * volume(cell);
  std::vector<Body> bodies = group.count ? unturned_bodies(group, index, seed, 0, *group.count)
                                         : bodies_of_volume(group, index, seed, wanted);
  if (bodies.empty()) {
    const Body one = unturned_bodies(group, index, seed, 0, 1).front();
    refuse(label(group, index),
           "fraction = " + number_text(*group.fraction) + " is less than half an inclusion, " +
               "allowed with " + lengths_text(one) +
               " are fractions >= " + number_text(0.5 * volume(one) / volume(cell)));
  }
  if (group.count && group.fraction) scale_to_volume(bodies, wanted);
  return bodies;
}

}  // namespace

int symmetry_axis(const Vec3& s) noexcept {
  const auto equal = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(a, b); };
  if (equal(s.x, s.y)) return 2;
  if (equal(s.x, s.z)) return 1;
  if (equal(s.y, s.z)) return 0;
  return s.x > s.y && s.x > s.z ? 0 : s.y > s.z ? 1 : 2;
}

InclusionMix draw_inclusions(const Cell& cell, const std::vector<InclusionGroup>& groups,
                             std::uint64_t seed) {
  check_cell(cell);
  const int count = static_cast<int>(groups.size());
  for (int g = 0; g < count; ++g) check_group(cell, groups[static_cast<std::size_t>(g)], g);
  check_ordered_fractions(groups);

  InclusionMix mix;
  for (int g = 0; g < count; ++g) {
    const InclusionGroup& group = groups[static_cast<std::size_t>(g)];
    mix.open_count.push_back(has_open_count(group));
    if (has_open_count(group)) {
      mix.derived.push_back(plain_label(group, g) + ": the count is open, inclusions are added " +
                            "until the cell is full");
      continue;
    }
    std::vector<Body> bodies = group_bodies(cell, group, g, seed);
    mix.derived.push_back(derived_sentence(cell, group, g, bodies));
    turn_bodies(bodies, group, g, seed, 0, Correction::exact);
    check_bodies(cell, group, g, bodies);
    for (const Body& body : bodies) mix.bodies.push_back({body, g});
  }
  check_total(cell, mix.bodies);
  return mix;
}

std::vector<OrderedBody> draw_open_group(const Cell& cell, const InclusionGroup& group,
                                         int group_index, std::int64_t first, std::int64_t count,
                                         std::uint64_t seed) {
  check_cell(cell);
  check_group(cell, group, group_index);
  if (!has_open_count(group)) {
    refuse(label(group, group_index), "count or fraction is given, allowed here is a size alone");
  }
  std::vector<Body> bodies = unturned_bodies(group, group_index, seed, first, count);
  turn_bodies(bodies, group, group_index, seed, first, Correction::none);
  check_bodies(cell, group, group_index, bodies);
  std::vector<OrderedBody> ordered;
  ordered.reserve(bodies.size());
  for (const Body& body : bodies) ordered.push_back({body, group_index});
  return ordered;
}

}  // namespace packstone
