#pragma once

/// @file
/// A box as one more convex shape: the primitives that searches and proofs rest on.

#include <cmath>

#include "geometry/minkowski_sum.hpp"
#include "geometry/proof.hpp"

namespace packstone {

/// A box with edges along the axes; a half edge of 0 is legal.
struct Box {
  Vec3 half_edges;
};

[[nodiscard]] inline double reach(const Box& box) { return norm(box.half_edges); }

[[nodiscard]] inline double support(const Box& box, const Vec3& d) {
  const Vec3& h = box.half_edges;
  return h.x * std::abs(d.x) + h.y * std::abs(d.y) + h.z * std::abs(d.z);
}

template <>
class SupportMap<Box> {
 public:
  explicit SupportMap(const Box& box) : h_(box.half_edges) {}
  Vec3 point(const Vec3& d) const {
    return {std::copysign(h_.x, d.x), std::copysign(h_.y, d.y), std::copysign(h_.z, d.z)};
  }
  double circum_radius() const { return norm(h_); }

 private:
  Vec3 h_;
};

}  // namespace packstone
