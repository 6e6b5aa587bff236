#include "packstone/geometry/published_cylinder_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace packstone {
namespace {

PublishedDisk moved(const PublishedDisk& disk, const Vec3& by) {
  return {disk.center + by, disk.radius, disk.normal};
}

/// Half the chord that a disk cuts from a line at distance d.
double half_chord(double radius, double d) {
  return std::sqrt(std::max(0.0, (radius - d) * (radius + d)));
}

/// First of the types d1, d2, cd1 to cd3 in the order of step 3.c of Algorithm 4.
PublishedContact end_contact(const Cylinder& a, const Cylinder& b, const Vec3& r,
                             PublishedRepair repair) {
  const std::array<PublishedDisk, 2> ends_a = published_ends(a, {}), ends_b = published_ends(b, r);
  for (const PublishedDisk& end : ends_b) {
    const PublishedContact found = published_cylinder_disk(a, end, repair);
    if (found != PublishedContact::none) return found;
  }
  for (const PublishedDisk& end : ends_a) {
    const PublishedContact found = published_cylinder_disk(b, moved(end, -r), repair);
    if (found != PublishedContact::none) return found;
  }
  for (const PublishedDisk& end_a : ends_a) {
    for (const PublishedDisk& end_b : ends_b) {
      const PublishedContact found = published_disk_disk(end_a, end_b, repair);
      if (found != PublishedContact::none) return found;
    }
  }
  return PublishedContact::none;
}

}  // namespace

std::string_view name(PublishedContact contact) noexcept {
  constexpr std::string_view names[] = {"none", "sc1", "sc2", "sc3", "sc4", "d1",
                                        "d2",   "cd1", "cd2", "cd3", "cc1", "ss"};
  return names[static_cast<int>(contact)];
}

std::array<PublishedDisk, 2> published_ends(const Cylinder& body, const Vec3& center) noexcept {
  const Vec3 l = body.half_length * body.axis;
  return {PublishedDisk{center + l, body.radius, l}, PublishedDisk{center - l, body.radius, -l}};
}

PublishedSphereCylinder published_sphere_cylinder_test(const Sphere& a, const Cylinder& b,
                                                       const Vec3& r_ab) noexcept {
  PublishedSphereCylinder found;
  found.x = -dot(r_ab, b.axis);
  found.to_axis = r_ab + found.x * b.axis;
  const double x = std::abs(found.x);
  const double h = b.half_length;
  if (x > h + a.radius) {
    if (norm(r_ab) < a.radius) found.type = PublishedContact::sc1;
    return found;
  }
  const double l = std::sqrt(std::max(0.0, norm_sq(r_ab) - x * x));
  if (x < h) {
    if (l < a.radius + b.radius) found.type = PublishedContact::sc2;
    return found;
  }
  if (!(l < half_chord(a.radius, x - h) + b.radius)) return found;
  found.type = l < b.radius ? PublishedContact::sc3 : PublishedContact::sc4;
  return found;
}

PublishedContact published_sphere_cylinder(const Sphere& a, const Cylinder& b,
                                           const Vec3& r_ab) noexcept {
  return published_sphere_cylinder_test(a, b, r_ab).type;
}

PublishedDiskDisk published_disk_disk_test(const PublishedDisk& a, const PublishedDisk& b,
                                           PublishedRepair repair) noexcept {
  const Vec3 n = cross(a.normal, b.normal);
  const Vec3 v = cross(n, a.normal);
  const bool literal = repair == PublishedRepair::literal;
  const bool chords = repair == PublishedRepair::chords;
  const Vec3 offset = literal ? a.center - b.center : b.center - a.center;
  const Vec3 pt = a.center + (dot(b.normal, offset) / dot(b.normal, v)) * v;
  const Vec3 e = normalized(n);
  const double along = dot(b.center - pt, e);
  const Vec3 pt_b = chords ? pt + along * e : pt;
  const double d_a = norm(pt - a.center), d_b = norm(pt_b - b.center);
  PublishedDiskDisk found{PublishedContact::none, pt, d_a, d_b};
  if (!(d_a <= a.radius && d_b <= b.radius)) return found;
  if (chords) {
    const double half_a = half_chord(a.radius, d_a), half_b = half_chord(b.radius, d_b);
    if (!(std::abs(along) <= half_a + half_b)) return found;
    const double lo = std::max(-half_a, along - half_b), hi = std::min(half_a, along + half_b);
    found.point = pt + 0.5 * (lo + hi) * e;
  }
  const bool first = a.radius * a.radius - d_a * d_a > b.radius * b.radius - d_b * d_b;
  found.type = first ? PublishedContact::d1 : PublishedContact::d2;
  return found;
}

PublishedContact published_disk_disk(const PublishedDisk& a, const PublishedDisk& b,
                                     PublishedRepair repair) noexcept {
  return published_disk_disk_test(a, b, repair).type;
}

PublishedCylinderDisk published_cylinder_disk_test(const Cylinder& a, const PublishedDisk& b,
                                                   PublishedRepair repair) noexcept {
  const Vec3 l = a.half_length * a.axis;
  const double t = dot(b.normal, b.center) / dot(b.normal, l);
  PublishedCylinderDisk found;
  found.crossing = t * l;
  const Vec3 from_center = found.crossing - b.center;
  const double off = norm(from_center);
  found.rim = b.center + (b.radius / off) * from_center;
  const double x = dot(found.rim, a.axis);
  found.foot = x * a.axis;
  const bool within = std::abs(x) < a.half_length;
  const bool bounded = repair == PublishedRepair::literal ||
                       (repair == PublishedRepair::typos ? within : std::abs(t) <= 1.0);
  const bool in_wall = within && norm(found.foot - found.rim) < a.radius;
  if (in_wall && off > b.radius) {
    found.type = PublishedContact::cd1;
  } else if (in_wall && off < b.radius) {
    found.type = PublishedContact::cd2;
  } else if (bounded && off < b.radius) {
    found.type = PublishedContact::cd3;
  }
  return found;
}

PublishedContact published_cylinder_disk(const Cylinder& a, const PublishedDisk& b,
                                         PublishedRepair repair) noexcept {
  return published_cylinder_disk_test(a, b, repair).type;
}

PublishedAxes published_axes_test(const Cylinder& a, const Cylinder& b, const Vec3& r_ab) noexcept {
  const Vec3 l_a = a.half_length * a.axis, l_b = b.half_length * b.axis;
  const Vec3 n = normalized(cross(l_a, l_b));
  PublishedAxes found;
  found.distance = std::abs(dot(r_ab, n));
  found.near = !(found.distance > a.radius + b.radius);
  const Vec3 n_a = cross(n, l_a), n_b = cross(n, l_b);
  const double t_a = dot(r_ab, n_b) / dot(l_a, n_b);
  const double t_b = -dot(r_ab, n_a) / dot(l_b, n_a);
  found.cross = std::abs(t_a) <= 1.0 && std::abs(t_b) <= 1.0;
  found.point_a = t_a * l_a;
  found.point_b = r_ab + t_b * l_b;
  return found;
}

PublishedContact published_cylinder_cylinder(const Cylinder& a, const Cylinder& b, const Vec3& r_ab,
                                             PublishedRepair repair) noexcept {
  const PublishedAxes axes = published_axes_test(a, b, r_ab);
  if (!axes.near) return PublishedContact::none;
  return axes.cross ? PublishedContact::cc1 : end_contact(a, b, r_ab, repair);
}

}  // namespace packstone
