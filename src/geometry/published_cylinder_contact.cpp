#include "packstone/geometry/published_cylinder_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace packstone {
namespace {

/// The end disks of a cylinder, normals outward, in the paper's order: +l, -l.
std::array<PublishedDisk, 2> ends(const Cylinder& body, const Vec3& center) {
  const Vec3 l = body.half_length * body.axis;
  return {PublishedDisk{center + l, body.radius, l}, PublishedDisk{center - l, body.radius, -l}};
}

PublishedDisk moved(const PublishedDisk& disk, const Vec3& by) {
  return {disk.center + by, disk.radius, disk.normal};
}

/// Do the chords meet that two disks cut from their common line? d_i: distances of the centers from
/// the line, `along`: distance of their projections to it.
bool chords_meet(double radius_a, double d_a, double radius_b, double d_b, double along) {
  const double half_a = std::sqrt(std::max(0.0, (radius_a - d_a) * (radius_a + d_a)));
  const double half_b = std::sqrt(std::max(0.0, (radius_b - d_b) * (radius_b + d_b)));
  return std::abs(along) <= half_a + half_b;
}

/// First of the types d1, d2, cd1 to cd3 in the order of step 3.c of Algorithm 4.
PublishedContact end_contact(const Cylinder& a, const Cylinder& b, const Vec3& r,
                             PublishedRepair repair) {
  const std::array<PublishedDisk, 2> ends_a = ends(a, {}), ends_b = ends(b, r);
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
                                        "d2",   "cd1", "cd2", "cd3", "cc1"};
  return names[static_cast<int>(contact)];
}

PublishedContact published_sphere_cylinder(const Sphere& a, const Cylinder& b,
                                           const Vec3& r_ab) noexcept {
  const double x = std::abs(dot(r_ab, b.axis));
  const double h = b.half_length;
  if (x > h + a.radius) {
    return norm(r_ab) < a.radius ? PublishedContact::sc1 : PublishedContact::none;
  }
  const double l = std::sqrt(std::max(0.0, norm_sq(r_ab) - x * x));
  if (x < h) return l < a.radius + b.radius ? PublishedContact::sc2 : PublishedContact::none;
  const double beyond = x - h;
  const double cut = std::sqrt(std::max(0.0, (a.radius - beyond) * (a.radius + beyond)));
  if (!(l < cut + b.radius)) return PublishedContact::none;
  return l < b.radius ? PublishedContact::sc3 : PublishedContact::sc4;
}

PublishedContact published_disk_disk(const PublishedDisk& a, const PublishedDisk& b,
                                     PublishedRepair repair) noexcept {
  const Vec3 n = cross(a.normal, b.normal);
  const Vec3 v = cross(n, a.normal);
  const bool literal = repair == PublishedRepair::literal;
  const Vec3 offset = literal ? a.center - b.center : b.center - a.center;
  const Vec3 pt = a.center + (dot(b.normal, offset) / dot(b.normal, v)) * v;
  const Vec3 e = normalized(n);
  const double along = dot(b.center - pt, e);
  const Vec3 pt_b = repair == PublishedRepair::chords ? pt + along * e : pt;
  const double d_a = norm(pt - a.center), d_b = norm(pt_b - b.center);
  if (!(d_a <= a.radius && d_b <= b.radius)) return PublishedContact::none;
  if (repair == PublishedRepair::chords && !chords_meet(a.radius, d_a, b.radius, d_b, along)) {
    return PublishedContact::none;
  }
  const bool first = a.radius * a.radius - d_a * d_a > b.radius * b.radius - d_b * d_b;
  return first ? PublishedContact::d1 : PublishedContact::d2;
}

PublishedContact published_cylinder_disk(const Cylinder& a, const PublishedDisk& b,
                                         PublishedRepair repair) noexcept {
  const Vec3 l = a.half_length * a.axis;
  const double t = dot(b.normal, b.center) / dot(b.normal, l);
  const Vec3 crossing = t * l;
  const Vec3 from_center = crossing - b.center;
  const double off = norm(from_center);
  const Vec3 rim = b.center + (b.radius / off) * from_center;
  const double x = dot(rim, a.axis);
  const bool within = std::abs(x) < a.half_length;
  if (within && norm(x * a.axis - rim) < a.radius) {
    if (off > b.radius) return PublishedContact::cd1;
    if (off < b.radius) return PublishedContact::cd2;
  }
  const bool bounded = repair == PublishedRepair::literal ||
                       (repair == PublishedRepair::typos ? within : std::abs(t) <= 1.0);
  return bounded && off < b.radius ? PublishedContact::cd3 : PublishedContact::none;
}

PublishedContact published_cylinder_cylinder(const Cylinder& a, const Cylinder& b, const Vec3& r_ab,
                                             PublishedRepair repair) noexcept {
  const Vec3 l_a = a.half_length * a.axis, l_b = b.half_length * b.axis;
  const Vec3 n = normalized(cross(l_a, l_b));
  if (std::abs(dot(r_ab, n)) > a.radius + b.radius) return PublishedContact::none;
  const Vec3 n_a = cross(n, l_a), n_b = cross(n, l_b);
  const double t_a = dot(r_ab, n_b) / dot(l_a, n_b);
  const double t_b = -dot(r_ab, n_a) / dot(l_b, n_a);
  if (std::abs(t_a) <= 1.0 && std::abs(t_b) <= 1.0) return PublishedContact::cc1;
  return end_contact(a, b, r_ab, repair);
}

}  // namespace packstone
