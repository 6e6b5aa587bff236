#pragma once

/// @file
/// The six shapes, each turned into the cell frame but without a place.
///
/// A body is a shape and its orientation. Where it stands is said separately, because pair kernels
/// take the separation r_ab of two bodies and know nothing of cells and images.

#include <optional>
#include <string_view>
#include <variant>

#include "packstone/core/quaternion.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A ball (3D).
struct Sphere {
  double radius = 1.0;  ///< [L] > 0.

  friend constexpr bool operator==(const Sphere&, const Sphere&) = default;
};

/// An ellipsoid with three free semi-axes (3D).
struct Ellipsoid {
  Vec3 semi_axes{1, 1, 1};   ///< a, b, c along body x, y, z [L] > 0.
  Quaternion orientation{};  ///< Body frame to cell frame, unit.

  friend constexpr bool operator==(const Ellipsoid&, const Ellipsoid&) = default;
};

/// A cylinder with flat ends (3D).
struct Cylinder {
  double radius = 1.0;       ///< [L] > 0.
  double half_length = 1.0;  ///< Half of the full length [L] > 0.
  Vec3 axis{0, 0, 1};        ///< Unit; its sign means nothing.

  friend constexpr bool operator==(const Cylinder&, const Cylinder&) = default;
};

/// A cylinder with half-balls on its ends (3D).
struct Spherocylinder {
  double radius = 1.0;       ///< [L] > 0.
  double half_length = 1.0;  ///< Half of the straight part [L] > 0.
  Vec3 axis{0, 0, 1};        ///< Unit; its sign means nothing.

  friend constexpr bool operator==(const Spherocylinder&, const Spherocylinder&) = default;
};

/// A disk in the plane (2D).
struct Disk {
  double radius = 1.0;  ///< [L] > 0.

  friend constexpr bool operator==(const Disk&, const Disk&) = default;
};

/// An ellipse in the plane (2D).
struct Ellipse {
  Vec2 semi_axes{1, 1};  ///< a, b along body x, y [L] > 0.
  double angle = 0.0;    ///< From cell x to the body x axis, counterclockwise [rad].

  friend constexpr bool operator==(const Ellipse&, const Ellipse&) = default;
};

/// Any of the six.
using Body = std::variant<Sphere, Ellipsoid, Cylinder, Spherocylinder, Disk, Ellipse>;

/// Names the alternatives of Body, in its order.
enum class ShapeKind { sphere, ellipsoid, cylinder, spherocylinder, disk, ellipse };

[[nodiscard]] constexpr ShapeKind kind(const Body& body) noexcept {
  return static_cast<ShapeKind>(body.index());
}

/// 2 for disk and ellipse, 3 for the others.
[[nodiscard]] constexpr int dimension(ShapeKind kind) noexcept {
  return kind == ShapeKind::disk || kind == ShapeKind::ellipse ? 2 : 3;
}

/// Looks the same from all sides.
[[nodiscard]] constexpr bool is_round(ShapeKind kind) noexcept {
  return kind == ShapeKind::sphere || kind == ShapeKind::disk;
}

/// Has a radius and a length.
[[nodiscard]] constexpr bool is_rod(ShapeKind kind) noexcept {
  return kind == ShapeKind::cylinder || kind == ShapeKind::spherocylinder;
}

/// "sphere", "ellipsoid", ...: the word used in recipes and packing files.
[[nodiscard]] constexpr std::string_view name(ShapeKind kind) noexcept {
  constexpr std::string_view names[] = {"sphere",         "ellipsoid", "cylinder",
                                        "spherocylinder", "disk",      "ellipse"};
  return names[static_cast<int>(kind)];
}

/// Throws InvalidArgument when a size is not a finite number > 0, or a direction or quaternion is
/// not of length 1 within kUnitTolerance.
void check_body(const Body& body);

/// The body axis that orientation laws turn: of an ellipsoid the axis of revolution where two
/// semi-axes are equal within 1e-9 (for a ball z), otherwise the longest one. 0, 1 or 2.
[[nodiscard]] int symmetry_axis(const Vec3& semi_axes) noexcept;

/// That axis of the body, in the cell frame: unit, its sign without meaning. Of rods their axis, of
/// an ellipse the longer one; nothing for spheres and disks.
[[nodiscard]] std::optional<Vec3> symmetry_axis(const Body& body) noexcept;

}  // namespace packstone
