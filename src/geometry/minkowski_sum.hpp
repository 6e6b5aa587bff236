#pragma once

/// @file
/// The set M = K_a + K_b that every convex pair kernel searches.
///
/// All six shapes are symmetric about their centers, so K_a - K_b = K_a + K_b = M, and with r =
/// r_ab
///
///     a and b overlap            <=>  r in M                                               (1)
///     gap                         =   signed distance of r from M                          (2)
///     common scale of contact     =   gauge of M at r, min { mu : r in mu M }              (3)
///     r = p + q, p in K_a, q in K_b  <=>  p is a common point (q in K_b <=> p - r in b)    (4)
///
/// The support map of a body is prepared once per pair: rotation matrices, sines and cosines.

#include <algorithm>
#include <cmath>

#include "packstone/core/mat.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// Support map of one body, ready for many directions. point(d) attains max d.x over the body; the
/// direction need not be unit, but not 0.
template <class Shape>
class SupportMap;

template <>
class SupportMap<Sphere> {
 public:
  explicit SupportMap(const Sphere& body) : radius_(body.radius) {}
  Vec3 point(const Vec3& d) const { return (radius_ / norm(d)) * d; }
  double circum_radius() const { return radius_; }

 private:
  double radius_;
};

template <>
class SupportMap<Ellipsoid> {
 public:
  explicit SupportMap(const Ellipsoid& body) {
    const Mat3 rotation = to_matrix(body.orientation);
    axes_ = {body.semi_axes.x * rotation.col_x, body.semi_axes.y * rotation.col_y,
             body.semi_axes.z * rotation.col_z};
    circum_radius_ = std::max({body.semi_axes.x, body.semi_axes.y, body.semi_axes.z});
  }
  Vec3 point(const Vec3& d) const {
    const Vec3 w = mul_transposed(axes_, d);
    return axes_ * (w / norm(w));
  }
  double circum_radius() const { return circum_radius_; }

 private:
  Mat3 axes_;  // columns: the semi-axes as vectors
  double circum_radius_ = 0.0;
};

template <>
class SupportMap<Cylinder> {
 public:
  explicit SupportMap(const Cylinder& body) : body_(body) {}
  Vec3 point(const Vec3& d) const {
    const double along = dot(body_.axis, d);
    // Twice: near the axis, rounding leaves a part along the axis that would carry the point
    // outside.
    Vec3 radial = d - along * body_.axis;
    radial -= dot(body_.axis, radial) * body_.axis;
    const double rho_sq = norm_sq(radial);
    const Vec3 end = std::copysign(body_.half_length, along) * body_.axis;
    // A direction along the axis within rounding is served by the center of the end face.
    constexpr double least = kSupportRoundoff * kSupportRoundoff;
    return rho_sq > least * along * along ? end + (body_.radius / std::sqrt(rho_sq)) * radial : end;
  }
  double circum_radius() const { return body_.radius + body_.half_length; }

 private:
  Cylinder body_;
};

template <>
class SupportMap<Spherocylinder> {
 public:
  explicit SupportMap(const Spherocylinder& body) : body_(body) {}
  Vec3 point(const Vec3& d) const {
    return std::copysign(body_.half_length, dot(body_.axis, d)) * body_.axis +
           (body_.radius / norm(d)) * d;
  }
  double circum_radius() const { return body_.radius + body_.half_length; }

 private:
  Spherocylinder body_;
};

template <>
class SupportMap<Disk> {
 public:
  explicit SupportMap(const Disk& body) : radius_(body.radius) {}
  Vec3 point(const Vec3& d) const {
    const double length = std::hypot(d.x, d.y);
    return length > 0.0 ? lift((radius_ / length) * flatten(d)) : Vec3{};
  }
  double circum_radius() const { return radius_; }

 private:
  double radius_;
};

template <>
class SupportMap<Ellipse> {
 public:
  explicit SupportMap(const Ellipse& body)
      : axis_x_{body.semi_axes.x * std::cos(body.angle), body.semi_axes.x * std::sin(body.angle)},
        axis_y_{-body.semi_axes.y * std::sin(body.angle), body.semi_axes.y * std::cos(body.angle)},
        circum_radius_(std::max(body.semi_axes.x, body.semi_axes.y)) {}
  Vec3 point(const Vec3& d) const {
    const Vec2 w{dot(axis_x_, flatten(d)), dot(axis_y_, flatten(d))};
    const double length = norm(w);
    return length > 0.0 ? lift((w.x / length) * axis_x_ + (w.y / length) * axis_y_) : Vec3{};
  }
  double circum_radius() const { return circum_radius_; }

 private:
  Vec2 axis_x_;  // the semi-axes as vectors
  Vec2 axis_y_;
  double circum_radius_;
};

/// What is left of a sphere or disk without its radius.
struct PointCore {};
/// What is left of a spherocylinder without its radius.
struct SegmentCore {
  double half_length;
  Vec3 axis;
};

template <>
class SupportMap<PointCore> {
 public:
  explicit SupportMap(PointCore) {}
  Vec3 point(const Vec3&) const { return {}; }
  double circum_radius() const { return 0.0; }
};

template <>
class SupportMap<SegmentCore> {
 public:
  explicit SupportMap(const SegmentCore& core) : core_(core) {}
  Vec3 point(const Vec3& d) const {
    return std::copysign(core_.half_length, dot(core_.axis, d)) * core_.axis;
  }
  double circum_radius() const { return core_.half_length; }

 private:
  SegmentCore core_;
};

/// A body is its core grown by a ball (in the plane, a disk) of radius margin(body). Distances of
/// cores are well conditioned where bodies touch, and of shallow depths they are the exact answer.
inline PointCore core(const Sphere&) { return {}; }
inline PointCore core(const Disk&) { return {}; }
inline SegmentCore core(const Spherocylinder& body) { return {body.half_length, body.axis}; }
inline const Ellipsoid& core(const Ellipsoid& body) { return body; }
inline const Cylinder& core(const Cylinder& body) { return body; }
inline const Ellipse& core(const Ellipse& body) { return body; }
inline double margin(const Sphere& body) { return body.radius; }
inline double margin(const Disk& body) { return body.radius; }
inline double margin(const Spherocylinder& body) { return body.radius; }
template <class Shape>
double margin(const Shape&) {
  return 0.0;
}

/// A point of M with its parts, equation (4): sum = in_a + in_b, and the inflation where there is
/// one.
struct SumPoint {
  Vec3 in_a;
  Vec3 in_b;
  Vec3 sum;
};

/// M of a pair, grown by a ball of radius `inflation`.
template <class ShapeA, class ShapeB>
class MinkowskiSum {
 public:
  MinkowskiSum(const ShapeA& a, const ShapeB& b, double inflation = 0.0)
      : a_(a), b_(b), inflation_(inflation) {}

  SumPoint support(const Vec3& d) const {
    const Vec3 in_a = a_.point(d);
    const Vec3 in_b = b_.point(d);
    Vec3 sum = in_a + in_b;
    if (inflation_ > 0.0) sum += (inflation_ / norm(d)) * d;
    return {in_a, in_b, sum};
  }

  /// Radius of a ball about the center that holds M.
  double circum_radius() const { return a_.circum_radius() + b_.circum_radius() + inflation_; }

 private:
  SupportMap<ShapeA> a_;
  SupportMap<ShapeB> b_;
  double inflation_;
};

}  // namespace packstone
