#include "generate/rsa/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::rsa {
namespace {

constexpr double kPi = std::numbers::pi;

// Cores are shrunk by this part, far above the rounding of the formulas that give them [-].
constexpr double kCoreMargin = 1e-12;

// The body axis along which an ellipsoid is a body of revolution: 0, 1, 2, or -1 for none.
int revolution_axis(const Vec3& s) {
  if (s.x == s.y) return 2;
  if (s.y == s.z) return 0;
  if (s.x == s.z) return 1;
  return -1;
}

Quaternion turn_body_axis_to(int body_axis, const Vec3& direction) {
  // The cyclic turn about (1, 1, 1) takes x to y, y to z, z to x.
  constexpr Quaternion x_to_z{0.5, -0.5, -0.5, -0.5};
  constexpr Quaternion y_to_z{0.5, 0.5, 0.5, 0.5};
  const Quaternion to = from_z_to(direction);
  return body_axis == 2 ? to : normalized(to * (body_axis == 0 ? x_to_z : y_to_z));
}

Body with_axis(const Body& body, const Vec3& axis) {
  Body turned = body;
  std::visit(Overloaded{[&](Ellipsoid& b) {
                          b.orientation = turn_body_axis_to(revolution_axis(b.semi_axes), axis);
                        },
                        [&](Cylinder& b) { b.axis = axis; },
                        [&](Spherocylinder& b) { b.axis = axis; }, [](auto&) {}},
             turned);
  return turned;
}

// One half of the HEALPix plane: base pixels 0-3 stand about the north pole, 4 and 5 on the
// equator; the other six are their antipodes. Coordinates (x, y) as in Gorski et al., section 5.
struct PlanePoint {
  double x;
  double y;
  double facet_x;  // Center line of the polar facet.
};

struct Pixel {
  int base;
  std::int32_t column;
  std::int32_t row;
};

// Pixels are numbered so that the children of pixel k are 4 k to 4 k + 3.
Pixel pixel_of(std::int32_t cell, int level) {
  Pixel pixel{0, 0, 0};
  for (int bit = 0; bit < level; ++bit) {
    pixel.column |= (cell & 1) << bit;
    pixel.row |= ((cell >> 1) & 1) << bit;
    cell >>= 2;
  }
  pixel.base = cell;
  return pixel;
}

PlanePoint plane_point(const Pixel& pixel, int level, double u, double v) {
  const double scale = 1.0 / (1 << level);
  const double p = (pixel.column + u) * scale, q = (pixel.row + v) * scale;
  const bool polar = pixel.base < 4;
  const double x0 = polar ? kPi / 4 + pixel.base * kPi / 2 : (pixel.base - 4) * kPi / 2;
  const double y0 = polar ? kPi / 4 : 0.0;
  return {x0 + (p - q) * kPi / 4, y0 + (p + q - 1.0) * kPi / 4, x0};
}

Vec3 direction_at(const PlanePoint& at) {
  double z = 0.0, phi = at.x;
  if (at.y <= kPi / 4) {
    z = 8.0 / (3.0 * kPi) * at.y;
  } else {
    const double sigma = std::max(2.0 - 4.0 * at.y / kPi, 0.0);
    z = 1.0 - sigma * sigma / 3.0;
    if (sigma > 0.0) phi = at.facet_x + (at.x - at.facet_x) / sigma;
  }
  const double rho = std::sqrt((1.0 - z) * (1.0 + z));
  return normalized(Vec3{rho * std::cos(phi), rho * std::sin(phi), z});
}

// Factor s such that s times the body of revolution with semi-axes a (along) and b (across) lies in
// every copy of it that is turned by up to `angle`: 1 / s is the norm of the turn seen in the
// frame where the body is a ball, [[c, -(b/a) sin], [(a/b) sin, c]], of determinant 1.
double revolution_core(double a, double b, double angle) {
  const double q = std::sin(std::min(angle, kPi / 2)) * std::abs(a / b - b / a);
  return 2.0 / (q + std::sqrt(4.0 + q * q));
}

void add_part(CommonCore& core, const Body& body) {
  const auto slot = static_cast<std::size_t>(core.part_count++);
  core.parts[slot] = body;
  core.outlines[slot] = outline_of(body);
}

// Cylinders (radius, half length) about the same axis that stay inside when it turns by up to
// `angle`: radius + half_length sin(angle) <= r bounds the side, and the largest value of
// half_length cos(t) + radius sin(t) over 0 <= t <= angle the ends.
void add_cylinder_parts(CommonCore& core, const Cylinder& whole) {
  const double angle = std::min(core.angle, kPi / 2);
  const double sine = std::sin(angle);
  for (const double part : {1.0, 0.7, 0.4}) {
    double half = part * whole.half_length;
    double radius = whole.radius - half * sine;
    if (radius <= 0.0) continue;
    const double steepest = std::min(angle, std::atan2(radius, half));
    const double end = half * std::cos(steepest) + radius * std::sin(steepest);
    if (end > whole.half_length) half *= whole.half_length / end, radius *= whole.half_length / end;
    add_part(core, Cylinder{radius * (1.0 - kCoreMargin), half * (1.0 - kCoreMargin), whole.axis});
  }
  add_part(core, Sphere{std::min(whole.radius, whole.half_length) * (1.0 - kCoreMargin)});
}

// As for cylinders; the ends are round, so only the side matters.
void add_spherocylinder_parts(CommonCore& core, const Spherocylinder& whole) {
  const double bend = 2.0 * std::sin(0.5 * std::min(core.angle, kPi));
  for (const double part : {1.0, 0.7, 0.4}) {
    const double half = part * whole.half_length;
    const double radius = whole.radius - half * bend;
    if (radius <= 0.0) continue;
    add_part(core, Spherocylinder{radius * (1.0 - kCoreMargin), half, whole.axis});
  }
  add_part(core, Sphere{whole.radius * (1.0 - kCoreMargin)});
}

void add_ellipsoid_part(CommonCore& core, const Ellipsoid& whole) {
  const int axis = revolution_axis(whole.semi_axes);
  if (axis < 0) {
    add_part(core, Sphere{in_radius(whole) * (1.0 - kCoreMargin)});
    return;
  }
  const auto along = static_cast<std::size_t>(axis);
  const double factor =
      revolution_core(whole.semi_axes[along], whole.semi_axes[(along + 1) % 3], core.angle);
  add_part(core, scaled(whole, factor * (1.0 - kCoreMargin)));
}

}  // namespace

Turning turning_of(const Body& body, bool redraw) noexcept {
  if (!redraw) return Turning::none;
  return std::visit(Overloaded{[](const Sphere&) { return Turning::none; },
                               [](const Disk&) { return Turning::none; },
                               [](const Cylinder&) { return Turning::of_axis; },
                               [](const Spherocylinder&) { return Turning::of_axis; },
                               [](const Ellipse& b) {
                                 return b.semi_axes.x == b.semi_axes.y ? Turning::none
                                                                       : Turning::in_plane;
                               },
                               [](const Ellipsoid& b) {
                                 const Vec3& s = b.semi_axes;
                                 if (s.x == s.y && s.y == s.z) return Turning::none;
                                 return revolution_axis(s) < 0 ? Turning::full : Turning::of_axis;
                               }},
                    body);
}

Body in_standard_pose(const Body& body, Turning turning) noexcept {
  Body standard = body;
  if (turning == Turning::in_plane) std::get<Ellipse>(standard).angle = 0.0;
  if (turning == Turning::of_axis) standard = with_axis(body, {0, 0, 1});
  if (turning == Turning::full) std::get<Ellipsoid>(standard).orientation = {};
  return standard;
}

// G. Marsaglia, Ann. Math. Stat. 43 (1972) 645-646. Each word gives a point of the square, which is
// in the circle with the chance pi / 4.
Vec3 axis_at_random(TrialNumbers::Row& numbers) noexcept {
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::uint64_t word = numbers.bits();
    const double a = static_cast<std::int32_t>(word) * 0x1p-31;
    const double b = static_cast<std::int32_t>(word >> 32) * 0x1p-31;
    const double s = a * a + b * b;
    if (s >= 1.0) continue;
    const double factor = 2.0 * std::sqrt(1.0 - s);
    return normalized(Vec3{factor * a, factor * b, 1.0 - 2.0 * s});
  }
  RandomStream random(numbers.bits(), StreamId::rsa_orientation);
  return random_direction(random);
}

Body turned_at_random(const Body& body, Turning turning, TrialNumbers::Row& numbers) noexcept {
  Body turned = body;
  if (turning == Turning::in_plane) {
    std::get<Ellipse>(turned).angle = kPi * numbers.uniform();
  } else if (turning == Turning::of_axis) {
    turned = with_axis(body, axis_at_random(numbers));
  } else if (turning == Turning::full) {
    RandomStream random(numbers.bits(), StreamId::rsa_orientation);
    std::get<Ellipsoid>(turned).orientation = random_rotation(random);
  }
  return turned;
}

int OrientationCells::branching() const noexcept {
  return turning_ == Turning::of_axis ? 4 : turning_ == Turning::in_plane ? 2 : 1;
}

std::int32_t OrientationCells::count() const noexcept {
  if (turning_ == Turning::of_axis) return std::int32_t{6} << (2 * level_);
  return turning_ == Turning::in_plane ? std::int32_t{1} << level_ : 1;
}

double OrientationCells::angle(std::int32_t cell) const noexcept {
  if (turning_ == Turning::none) return 0.0;
  if (turning_ == Turning::full) return kPi;
  if (turning_ == Turning::in_plane) return 0.5 * kPi / (1 << level_);
  // How the map of the HEALPix plane stretches arcs. Equatorial zone, |z| <= 2/3: ds <= max(1,
  // (8 / 3 pi) / sqrt(1 - z^2)) |d(x, y)|. Polar zone: ds^2 <= (1 + z)/3 (|dx| + |dy|)^2 +
  // (8 / 3 pi)^2 3 / (1 + z) dy^2, since sin(theta) = sigma sqrt((1 + z) / 3) there.
  // A pixel reaches (pi/4) / 2^level from its middle, measured by |dx| + |dy|.
  const double reach = kPi / 4 / (1 << level_);
  const Pixel pixel = pixel_of(cell, level_);
  const double y = plane_point(pixel, level_, 0.5, 0.5).y;
  const double y_far = std::abs(y) + reach;
  if (y_far <= kPi / 4 * (1.0 + 1e-12)) {
    const double z = std::min(8.0 / (3.0 * kPi) * y_far, 2.0 / 3.0);
    return reach * std::max(1.0, 8.0 / (3.0 * kPi) / std::sqrt(1.0 - z * z)) * (1.0 + 1e-12);
  }
  constexpr double polar_stretch = 1.361;  // The root of its bound at z = 2/3, the largest.
  return reach * polar_stretch;
}

double OrientationCells::widest() const noexcept {
  // The first base pixel holds the pole.
  return turning_ == Turning::of_axis ? angle(count() / 6 - 1) : angle(0);
}

Body OrientationCells::turned(const Body& body, std::int32_t cell, double u,
                              double v) const noexcept {
  if (turning_ == Turning::of_axis) {
    return with_axis(body, direction_at(plane_point(pixel_of(cell, level_), level_, u, v)));
  }
  Body result = body;
  if (turning_ == Turning::in_plane) {
    std::get<Ellipse>(result).angle = kPi * (cell + u) / (1 << level_);
  }
  return result;
}

CommonCore common_core(const Body& middle, double angle) noexcept {
  CommonCore core;
  core.middle = middle;
  core.middle_outline = outline_of(middle);
  core.angle = angle;
  core.swing = 2.0 * std::sin(0.5 * std::min(angle, kPi)) * core.middle_outline.half_length;
  if (angle == 0.0) {
    add_part(core, middle);
    return core;
  }
  std::visit(Overloaded{[&](const Cylinder& b) { add_cylinder_parts(core, b); },
                        [&](const Spherocylinder& b) { add_spherocylinder_parts(core, b); },
                        [&](const Ellipsoid& b) { add_ellipsoid_part(core, b); },
                        [&](const Ellipse& b) {
                          const double factor =
                              revolution_core(b.semi_axes.x, b.semi_axes.y, angle) *
                              (1.0 - kCoreMargin);
                          add_part(core, scaled(b, factor));
                        },
                        [&](const auto& b) { add_part(core, b); }},
             middle);
  return core;
}

}  // namespace packstone::rsa
