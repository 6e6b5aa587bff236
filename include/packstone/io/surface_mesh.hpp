#pragma once

/// @file
/// Surfaces of bodies as triangles, outlines as polygons: what viewers and solvers read.

#include <array>
#include <cstddef>
#include <vector>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// Triangles on a closed surface. Every edge belongs to two triangles that run along it in opposite
/// senses, once points at equal places are taken as one: along the rims of a cylinder the points
/// stand twice, because the surface has two normals there.
struct SurfaceMesh {
  std::vector<Vec3> points;                   ///< On the surface, relative to the center [L].
  std::vector<Vec3> normals;                  ///< Outward unit normal at each point.
  std::vector<std::array<int, 3>> triangles;  ///< Counterclockwise seen from outside.
};

/// The surface of a 3D body with `segments` edges around the full circle and half as many from pole
/// to pole.
///
/// Points lie on the surface, so the mesh lies inside the (convex) body: its volume is too small by
/// the order of 1 / segments^2, for a ball by a share of (5/12) (2 pi / segments)^2 or 16.5 /
/// segments^2: 1/6 from the circles of latitude, 1/4 from the meridians.
/// Number and order of points and triangles depend on the shape and `segments` alone.
///
/// Errors: throws InvalidArgument for a 2D body or segments outside 8 to 4096.
[[nodiscard]] SurfaceMesh surface_mesh(const Body& body, int segments);

/// How many points and triangles surface_mesh() makes of a shape.
[[nodiscard]] std::size_t point_count(ShapeKind shape, int segments);
[[nodiscard]] std::size_t triangle_count(ShapeKind shape, int segments);

/// The outline of a 2D body: `segments` points, counterclockwise, relative to the center [L].
/// Throws InvalidArgument for a 3D body or segments outside 8 to 4096.
[[nodiscard]] std::vector<Vec3> outline(const Body& body, int segments);

}  // namespace packstone
