#pragma once

/// @file
/// Does a ball of a packing rest where it stands? What the tests of constructive methods ask.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::resting {

/// Unit normals, toward inclusion `i`, of all that it touches within `touch`: inclusions that came
/// before it, walls and the floor.
inline std::vector<Vec3> contact_normals(const Packing& packing, std::size_t i, double touch) {
  const Cell& cell = packing.cell;
  const Inclusion& ball = packing.inclusions[i];
  const double radius = circum_radius(ball.body);
  std::vector<Vec3> normals;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (cell.periodic[a]) continue;
    Vec3 inward;
    inward[a] = 1.0;
    if (ball.center[a] - radius < touch) normals.push_back(inward);
    const bool ceiling = a + 1 == static_cast<std::size_t>(cell.dimension);
    if (!ceiling && cell.size[a] - ball.center[a] - radius < touch) normals.push_back(-inward);
  }
  const auto last = [&](std::size_t a) { return cell.periodic[a] ? 1 : 0; };
  for (std::size_t j = 0; j < i; ++j) {
    const double reach = radius + circum_radius(packing.inclusions[j].body) + touch;
    for (int x = -last(0); x <= last(0); ++x) {
      for (int y = -last(1); y <= last(1); ++y) {
        const Vec3 d = ball.center - packing.inclusions[j].center - image_shift(cell, {x, y, 0});
        if (norm(d) < reach) normals.push_back(normalized(d));
      }
    }
  }
  return normals;
}

/// Is there no way down? Every way down that is worst for some of the contacts lies along none, one
/// or two of them: the steepest of each kind is tried.
inline bool has_no_way_down(const std::vector<Vec3>& normals, const Vec3& up) {
  constexpr double kClear = 1e-9;
  const auto leads_down = [&](const Vec3& v, std::size_t i, std::size_t j) {
    if (dot(v, up) > -kClear) return false;
    for (std::size_t k = 0; k < normals.size(); ++k) {
      if (k != i && k != j && dot(v, normals[k]) < kClear) return false;
    }
    return true;
  };
  const std::size_t none = normals.size();
  if (leads_down(-up, none, none)) return false;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (leads_down(dot(up, normals[i]) * normals[i] - up, i, none)) return false;
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Vec3 along = cross(normals[i], normals[j]);
      if (norm(along) < 1e-9) continue;
      const Vec3 t = normalized(along);
      if (leads_down(-dot(up, t) * t, i, j)) return false;
    }
  }
  return true;
}

}  // namespace packstone::resting
