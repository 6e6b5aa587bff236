#pragma once

/// @file
/// The cell: a rectangle or a box, periodic along any of its axes, with a wall where it is not.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "packstone/core/vec.hpp"

namespace packstone {

/// The box that inclusions are packed in: [0, size.x) x [0, size.y) (x [0, size.z)).
///
/// A 2D cell has dimension 2, size.z = 0 and periodic[2] = false; loops over axes run to
/// `dimension`.
struct Cell {
  int dimension = 3;                               ///< 2 or 3.
  Vec3 size{1, 1, 1};                              ///< Edge lengths [L]. > 0 along every axis.
  std::array<bool, 3> periodic{true, true, true};  ///< false: two walls across that axis.

  friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

/// A 2D cell with edges `x`, `y` [L].
constexpr Cell cell_2d(double x, double y, bool periodic_x = true, bool periodic_y = true) {
  return {2, {x, y, 0}, {periodic_x, periodic_y, false}};
}

/// Volume of the cell [L^3], area in 2D [L^2].
constexpr double volume(const Cell& cell) {
  return cell.dimension == 2 ? cell.size.x * cell.size.y : cell.size.x * cell.size.y * cell.size.z;
}

/// The shortest period [L]; infinite where no axis is periodic.
inline double shortest_period(const Cell& cell) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (cell.periodic[axis]) shortest = std::min(shortest, cell.size[axis]);
  }
  return shortest;
}

/// `x` brought into [0, length) by whole periods; exact for x already inside.
inline double wrapped(double x, double length) {
  if (x >= 0.0 && x < length) return x;
  const double y = x - length * std::floor(x / length);
  return y >= length ? 0.0 : y;
}

/// `p` brought into the cell along its periodic axes.
inline Vec3 wrapped(const Cell& cell, Vec3 p) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    if (cell.periodic[axis]) p[axis] = wrapped(p[axis], cell.size[axis]);
  }
  return p;
}

/// The shift of a periodic image: whole periods along each axis, times the edge lengths [L].
constexpr Vec3 image_shift(const Cell& cell, const std::array<int, 3>& image) {
  return {image[0] * cell.size.x, image[1] * cell.size.y, image[2] * cell.size.z};
}

/// Throws InvalidArgument when dimension, size or flags are out of range.
void check_cell(const Cell& cell);

}  // namespace packstone
