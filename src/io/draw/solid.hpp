#pragma once

/// @file
/// Solid: a placed 3D body as a ray sees it.

#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone::draw {

/// A ray: points origin + t direction. The direction need not be unit.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// The part of a ray inside a convex solid; empty when enter >= leave.
struct Crossing {
  double enter = 1.0;
  double leave = 0.0;
  Vec3 normal;  ///< Outward unit normal where the ray enters.

  [[nodiscard]] bool empty() const noexcept { return !(enter < leave); }
};

/// A box with faces across the axes.
struct Box {
  Vec3 low;
  Vec3 high;
};

/// Where the ray is inside the box.
[[nodiscard]] Crossing crossing(const Box& box, const Ray& ray) noexcept;

/// A body with its place and color; `clipped` bodies are cut at the cell.
struct Solid {
  Body body;
  Vec3 center;
  Vec3 color;
  bool clipped = false;
  Mat3 frame;  ///< Body axes as columns.
};

/// A solid, with the frame filled in.
[[nodiscard]] Solid make_solid(const Body& body, const Vec3& center, const Vec3& color,
                               bool clipped);

/// Where the ray is inside the solid, not clipped.
[[nodiscard]] Crossing crossing(const Solid& solid, const Ray& ray) noexcept;

/// The common part of two crossings; the normal is that of the later entry.
[[nodiscard]] Crossing intersection(const Crossing& a, const Crossing& b) noexcept;

}  // namespace packstone::draw
