#pragma once

/// @file
/// A body at one instant, in the form in which dynamic methods turn and grow it.
///
/// One struct for all shapes in place of a variant: what the support function of a body is put
/// together from is an axis with the size along it and a size across it. In the plane a disk is a
/// ball and an ellipse a spheroid whose axis and center stay in it: by symmetry about the plane all
/// contacts, and the directions of all shortest gaps, are the same.

#include <cstdint>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// How the support function of a body is put together.
enum class Form : std::uint8_t { ball, spheroid, scalene, cylinder, spherocylinder };

/// Smooth and strictly convex, as ellipsoids are.
[[nodiscard]] constexpr bool is_ellipsoid(Form form) { return form <= Form::scalene; }

/// Where a body is and how it is turned.
struct Pose {
  Vec3 center;
  Vec3 axis{0, 0, 1};  ///< Unit.
  Vec3 second;         ///< Unit, across `axis`; of scalene bodies.
};

/// A body at one instant, at its size then.
struct PosedBody {
  Form form = Form::ball;
  Pose pose;
  double axial = 0.0;    ///< Semi-axis along the axis; half length of rods, radius of a ball [L].
  double second = 0.0;   ///< Semi-axis along the second axis; of scalene bodies [L].
  double lateral = 0.0;  ///< Semi-axis across both; radius of rods and balls [L].
};

/// The body about `center`. Its axis is symmetry_axis(); of an ellipse the first one.
[[nodiscard]] PosedBody posed_body(const Body& body, const Vec3& center = {});

/// `shape` turned so that posed_body() gives the axes of `pose`; of ellipsoids of revolution, whose
/// turn about their axis is not seen, by the shortest way.
[[nodiscard]] Body turned_body(const Body& shape, const Pose& pose);

/// Moments of inertia about the axes of posed_body(), over the mass, of uniform density [L^2]; 0
/// for balls. Of bodies of revolution that across their axis stands for all three: they are never
/// turned about it, as nothing would be seen of that.
[[nodiscard]] Vec3 specific_inertia(const Body& body);

/// The support function [L |n|].
[[nodiscard]] double support(const PosedBody& body, const Vec3& n);

/// Where the body comes nearest to a plane with unit normal n, relative to its center [L]; the
/// middle of a side that rests on it.
[[nodiscard]] Vec3 support_point(const PosedBody& body, const Vec3& n);

/// The matrix whose quadratic form is the square of the support function of an ellipsoid, times n,
/// without the cancellation that its entries bring to flat bodies.
[[nodiscard]] Vec3 shape_times(const PosedBody& body, const Vec3& n);

}  // namespace packstone
