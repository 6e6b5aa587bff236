#pragma once

/// @file
/// An ellipse with its axes at hand; the same arithmetic as support.cpp, bit by bit, so that what
/// is proven here is proven for whoever evaluates support() and contains() again.

#include <algorithm>
#include <cmath>

#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

struct PosedEllipse {
  Vec2 x_axis;  ///< Body x axis in the cell.
  Vec2 axes;
  double least;
  double largest;

  explicit PosedEllipse(const Ellipse& body)
      : x_axis{std::cos(body.angle), std::sin(body.angle)},
        axes(body.semi_axes),
        least(std::min(axes.x, axes.y)),
        largest(std::max(axes.x, axes.y)) {}

  Vec2 to_body(const Vec3& v) const {
    return {x_axis.x * v.x + x_axis.y * v.y, x_axis.x * v.y - x_axis.y * v.x};
  }
  Vec3 to_cell(const Vec2& v) const {
    return {x_axis.x * v.x - x_axis.y * v.y, x_axis.y * v.x + x_axis.x * v.y, 0.0};
  }
  double support(const Vec3& d) const {
    const Vec2 v = to_body(d);
    return norm(Vec2{axes.x * v.x, axes.y * v.y});
  }
  /// Factor by which the body must be scaled for x to lie on its outline.
  double level(const Vec3& x) const {
    const Vec2 v = to_body(x);
    return norm(Vec2{v.x / axes.x, v.y / axes.y});
  }
  /// The same, certainly not too small.
  double level_bound(const Vec3& x) const {
    const double computed = level(x);
    return computed + kSupportRoundoff * std::max(computed, norm(x) / least);
  }
  bool contains(const Vec3& x) const {
    return level(x) <= 1.0 - kSupportRoundoff * std::max(1.0, norm(flatten(x)) / least);
  }
};

}  // namespace packstone
