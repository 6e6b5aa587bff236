#pragma once

/// @file
/// An ellipsoid with its rotation at hand; the same arithmetic as support.cpp, bit by bit, so that
/// what is proven here is proven for whoever evaluates support() and contains() again.

#include <algorithm>
#include <cmath>

#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

struct PosedEllipsoid {
  Mat3 rotation;
  Vec3 axes;
  double least;
  double largest;

  explicit PosedEllipsoid(const Ellipsoid& body)
      : rotation(to_matrix(body.orientation)),
        axes(body.semi_axes),
        least(std::min({axes.x, axes.y, axes.z})),
        largest(std::max({axes.x, axes.y, axes.z})) {}

  Vec3 to_body(const Vec3& v) const { return mul_transposed(rotation, v); }
  Vec3 to_cell(const Vec3& v) const { return rotation * v; }
  double support(const Vec3& d) const { return norm(scale(axes, to_body(d))); }
  Vec3 support_point(const Vec3& d) const {
    const Vec3 v = scale(axes, to_body(d));
    return rotation * (scale(axes, v) / norm(v));
  }
  /// Factor by which the body must be scaled for x to lie on its surface.
  double level(const Vec3& x) const { return norm(unscale(to_body(x), axes)); }
  /// The same, certainly not too small.
  double level_bound(const Vec3& x) const {
    const double computed = level(x);
    return computed + kSupportRoundoff * std::max(computed, norm(x) / least);
  }
  bool contains(const Vec3& x) const {
    return level(x) <= 1.0 - kSupportRoundoff * std::max(1.0, norm(x) / least);
  }
};

}  // namespace packstone
