#pragma once

/// @file
/// Random bodies of every shape, turned at random.

#include "packstone/core/random.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone::test {

/// A body of this shape. Each of its lengths, three of them at most, is what `length()` gives.
template <class Length>
Body random_body(ShapeKind shape, RandomStream& random, const Length& length) {
  switch (shape) {
    case ShapeKind::sphere:
      return Sphere{length()};
    case ShapeKind::ellipsoid:
      return Ellipsoid{{length(), length(), length()}, random_rotation(random)};
    case ShapeKind::cylinder:
      return Cylinder{length(), length(), random_direction(random)};
    case ShapeKind::spherocylinder:
      return Spherocylinder{length(), length(), random_direction(random)};
    case ShapeKind::disk:
      return Disk{length()};
    case ShapeKind::ellipse:
      break;
  }
  return Ellipse{{length(), length()}, random.uniform(-10.0, 10.0)};
}

/// A shape of 2 or 3 dimensions, each with the same chance.
inline ShapeKind random_shape(int dimension, RandomStream& random) {
  return static_cast<ShapeKind>(dimension == 3 ? random.below(4) : 4 + random.below(2));
}

}  // namespace packstone::test
