#include <algorithm>
#include <cmath>
#include <variant>

#include "packstone/generate/published_time_driven.hpp"

namespace packstone {
namespace {

// Below this a length, in units of a radius or half length, or a sine counts as 0: what it divides
// would be rounding.
constexpr double kDegenerate = 1e-9;

// v at length 1, or where there is none the direction `instead`, or some direction across the axis.
Vec3 direction_or(const Vec3& v, const Vec3& instead, const Vec3& axis, double size) {
  if (norm(v) > kDegenerate * size) return normalized(v);
  return norm(instead) > kDegenerate * size ? normalized(instead) : any_perpendicular(axis);
}

PublishedForce opposite(const PublishedForce& force) {
  return {force.type, -force.on_a, force.point};
}

// Seen from another body; r: its center, as seen until now.
PublishedForce seen_from(const Vec3& r, const PublishedForce& force) {
  return {force.type, force.on_a, force.point - r};
}

PublishedForce sphere_sphere(const Sphere& a, const Sphere& b, const Vec3& r) {
  const double distance = norm(r);
  const double depth = a.radius + b.radius - distance;
  if (depth <= 0.0) return {};
  const Vec3 d = direction_or(r, {0, 0, 1}, {0, 0, 1}, a.radius + b.radius);
  return {PublishedContact::ss, -depth * d, (a.radius - 0.5 * depth) * d};
}

// sc1 to sc4 as printed, on the cylinder b, seen from the sphere a.
PublishedForce printed_on_cylinder(const Sphere& a, const Cylinder& b, const Vec3& r,
                                   const PublishedSphereCylinder& at) {
  const double l = norm(at.to_axis), beyond = std::abs(at.x) - b.half_length;
  const Vec3 out = normalized(at.to_axis);
  const double chord = std::sqrt((a.radius - beyond) * (a.radius + beyond));
  const Vec3 rim = at.to_axis - b.radius * out;
  switch (at.type) {
    case PublishedContact::sc1:
      return {at.type, 2.0 * b.half_length * normalized(r), r};
    case PublishedContact::sc2: {
      const double size = std::sqrt((a.radius + b.radius - l) * (a.radius + b.radius + l));
      return {at.type, -size * out, (size - a.radius) * out};
    }
    case PublishedContact::sc3:
      return {at.type, -std::copysign(a.radius - beyond, at.x) * b.axis, at.to_axis - l * out};
    case PublishedContact::sc4:
      return {at.type, (chord + b.radius - l) * normalized(rim), rim};
    default:
      return {};
  }
}

// The same with a depth that is that along the force, which points away from the sphere and applies
// where the two surfaces are.
PublishedForce repaired_on_cylinder(const Sphere& a, const Cylinder& b, const Vec3& r,
                                    const PublishedSphereCylinder& at) {
  const double l = norm(at.to_axis), beyond = std::abs(at.x) - b.half_length;
  const Vec3 out = direction_or(at.to_axis, r, b.axis, b.radius);
  const Vec3 rim = r + std::copysign(b.half_length, at.x) * b.axis - b.radius * out;
  switch (at.type) {
    case PublishedContact::sc1:
      return {at.type, 2.0 * b.half_length * normalized(r), r};
    case PublishedContact::sc2:
      return {at.type, (a.radius + b.radius - l) * out, (l - b.radius) * out};
    case PublishedContact::sc3:
      return {at.type, -std::copysign(a.radius - beyond, at.x) * b.axis, {}};
    case PublishedContact::sc4:
      return {at.type, (a.radius - norm(rim)) * direction_or(rim, out, b.axis, a.radius), rim};
    default:
      return {};
  }
}

// On the sphere, seen from it.
PublishedForce sphere_cylinder(const Sphere& a, const Cylinder& b, const Vec3& r, bool literal) {
  const PublishedSphereCylinder at = published_sphere_cylinder_test(a, b, r);
  if (at.type == PublishedContact::none) return {};
  return opposite(literal ? printed_on_cylinder(a, b, r, at) : repaired_on_cylinder(a, b, r, at));
}

bool parallel(const Cylinder& a, const Cylinder& b) {
  return norm(cross(a.axis, b.axis)) < kDegenerate;
}

// Steps 1 to 3.c of Algorithm 4 where they are 0/0. Nearest to each other are all points of the
// part that lies side by side; the middle of it stands for them.
PublishedAxes parallel_axes(const Cylinder& a, const Cylinder& b, const Vec3& r) {
  const double x = dot(r, a.axis);
  const Vec3 across = r - x * a.axis;
  const double lo = std::max(-a.half_length, x - b.half_length);
  const double hi = std::min(a.half_length, x + b.half_length);
  const Vec3 middle = 0.5 * (lo + hi) * a.axis;
  const double distance = norm(across);
  return {distance <= a.radius + b.radius, lo <= hi, distance, middle, middle + across};
}

// cc1, on a. Where the axes meet, the line of centers takes the place of their normal.
PublishedForce axes_force(const Cylinder& a, const Cylinder& b, const Vec3& r,
                          const PublishedAxes& axes, bool literal) {
  const Vec3 apart = axes.point_a - axes.point_b;
  const Vec3 d = literal ? normalized(apart) : direction_or(apart, -r, a.axis, a.radius + b.radius);
  return {PublishedContact::cc1, (a.radius + b.radius - axes.distance) * d,
          0.5 * (axes.point_a + axes.point_b)};
}

// A disk with the axis in its plane, whose crossing is infinitely far to one side: tilted by a hair
// so that it is to the side of the cylinder's center.
PublishedDisk tilted(const Cylinder& a, const PublishedDisk& b) {
  const Vec3 n = normalized(b.normal);
  if (std::abs(dot(n, a.axis)) > kDegenerate) return b;
  const double side = dot(n, b.center) * dot(b.center, a.axis);
  return {b.center, b.radius, n - std::copysign(kDegenerate, side) * a.axis};
}

// cd3, on the cylinder a, seen from it.
PublishedForce passing_force(const Cylinder& a, const PublishedDisk& b, const Vec3& crossing) {
  const Vec3 d = direction_or(-b.center, b.normal, a.axis, a.radius);
  return {PublishedContact::cd3, 2.0 * a.radius * d, crossing};
}

// cd1 to cd3, on the cylinder a, seen from it.
PublishedForce disk_force(const Cylinder& a, const PublishedDisk& b, bool literal) {
  const auto repair = literal ? PublishedRepair::literal : PublishedRepair::chords;
  const auto at = published_cylinder_disk_test(a, literal ? b : tilted(a, b), repair);
  const bool centered = norm(at.crossing - b.center) < kDegenerate * b.radius;
  if (!literal && centered && norm(at.crossing) <= a.half_length) {
    return passing_force(a, b, at.crossing);
  }
  const Vec3 out = at.foot - at.rim;
  const double d = norm(out);
  switch (at.type) {
    case PublishedContact::cd1:
      return {at.type, (a.radius - d) * normalized(out), at.rim};
    case PublishedContact::cd2: {
      if (literal) return {at.type, (d - 2.0 * a.radius) * normalized(out), at.rim};
      const Vec3 away = direction_or(-out, at.crossing - b.center, a.axis, a.radius);
      return {at.type, (a.radius + d) * away, at.rim};
    }
    case PublishedContact::cd3:
      return passing_force(a, b, at.crossing);
    default:
      return {};
  }
}

// d1 and d2, on the owner of disk a. Printed, d2 pulls.
PublishedForce disks_force(const PublishedDisk& a, const PublishedDisk& b, bool literal) {
  const auto repair = literal ? PublishedRepair::literal : PublishedRepair::chords;
  const PublishedDiskDisk at = published_disk_disk_test(a, b, repair);
  switch (at.type) {
    case PublishedContact::d1:
      return {at.type, (at.distance_b - b.radius) * normalized(a.normal), at.point};
    case PublishedContact::d2:
      return {
          at.type,
          (literal ? at.distance_a - a.radius : a.radius - at.distance_a) * normalized(b.normal),
          at.point};
    default:
      return {};
  }
}

// Step 3.c of Algorithm 4.
void add_end_forces(PublishedForces& forces, const Cylinder& a, const Cylinder& b, const Vec3& r,
                    bool literal) {
  const auto ends_a = published_ends(a, {}), ends_b = published_ends(b, r);
  for (const PublishedDisk& end : ends_b) forces.add(disk_force(a, end, literal));
  for (const PublishedDisk& end : published_ends(a, -r)) {
    forces.add(seen_from(-r, opposite(disk_force(b, end, literal))));
  }
  for (const PublishedDisk& end_a : ends_a) {
    for (const PublishedDisk& end_b : ends_b) forces.add(disks_force(end_a, end_b, literal));
  }
}

PublishedForces cylinder_cylinder(const Cylinder& a, const Cylinder& b, const Vec3& r,
                                  bool literal) {
  const bool side_by_side = !literal && parallel(a, b);
  const PublishedAxes axes = side_by_side ? parallel_axes(a, b, r) : published_axes_test(a, b, r);
  PublishedForces forces;
  if (!axes.near) return forces;
  if (axes.cross) forces.add(axes_force(a, b, r, axes, literal));
  if (!axes.cross || side_by_side) add_end_forces(forces, a, b, r, literal);
  return forces;
}

}  // namespace

void PublishedForces::add(const PublishedForce& force) noexcept {
  if (force.type == PublishedContact::none || count_ == kMost) return;
  if (!std::isfinite(norm_sq(force.on_a)) || !std::isfinite(norm_sq(force.point))) return;
  forces_[count_++] = force;
}

PublishedForces published_forces(const Body& a, const Body& b, const Vec3& r_ab,
                                 bool literal) noexcept {
  const auto* sphere_a = std::get_if<Sphere>(&a);
  const auto* sphere_b = std::get_if<Sphere>(&b);
  const auto* cylinder_a = std::get_if<Cylinder>(&a);
  const auto* cylinder_b = std::get_if<Cylinder>(&b);
  if (cylinder_a != nullptr && cylinder_b != nullptr) {
    return cylinder_cylinder(*cylinder_a, *cylinder_b, r_ab, literal);
  }
  PublishedForces forces;
  if (sphere_a != nullptr && sphere_b != nullptr) {
    forces.add(sphere_sphere(*sphere_a, *sphere_b, r_ab));
  } else if (sphere_a != nullptr && cylinder_b != nullptr) {
    forces.add(sphere_cylinder(*sphere_a, *cylinder_b, r_ab, literal));
  } else if (cylinder_a != nullptr && sphere_b != nullptr) {
    const PublishedForce force = sphere_cylinder(*sphere_b, *cylinder_a, -r_ab, literal);
    forces.add(seen_from(-r_ab, opposite(force)));
  }
  return forces;
}

}  // namespace packstone
