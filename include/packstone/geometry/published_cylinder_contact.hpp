#pragma once

/// @file
/// The cylinder tests of Salnikov, Choi and Karamian-Surville as published, for comparison only.
///
/// **Do not pack with these.** Their Algorithm 1 (sphere and cylinder) is right; Algorithms 2 to 4
/// miss overlaps and report overlaps that are none. docs/algorithms/published_cylinder_tests.md
/// counts how often. Use decide() of contact.hpp, which proves what it says.
///
/// Everything is in the paper's notation: a cylinder has its center, radius r and the vector l from
/// its center to the center of an end (so |l| is half the length); a disk its center, radius and
/// normal. Two repairs can be switched on, to see what is a slip of the pen and what is not:
///
///   typos   the sign of t in Algorithm 2; step 5 of Algorithm 3 only where step 4 holds, so that
///           the cylinder has an end.
///   chords  besides, in Algorithm 2 each center is projected to its own point of the common line
///           and the chords that the disks cut from it must meet, which makes that test exact; in
///           Algorithm 3 type cd3 asks that the axis crosses the disk between its own ends.
///
/// Even with both, Algorithm 3 looks at one point of the disk's rim only, the nearest to where the
/// cylinder's axis crosses its plane, and misses disks that enter elsewhere.
///
/// Reference: V. Salnikov, D. Choi, P. Karamian-Surville, "On efficient and reliable stochastic
/// generation of RVEs for analysis of composites within the framework of homogenization",
/// Comput. Mech. 55 (2015) 127-144, section 2, Algorithms 1 to 4.

#include <array>
#include <string_view>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// The paper's types of intersection; `none` where it finds no intersection.
enum class PublishedContact {
  none,
  sc1,  ///< Cylinder inside the sphere; never reached, step 2 of Algorithm 1 excludes it.
  sc2,  ///< Sphere meets the curved face.
  sc3,  ///< Sphere meets an end, its center within the infinite cylinder.
  sc4,  ///< Sphere meets an end, its center outside.
  d1,   ///< Disks meet; the first reaches farther along the common line.
  d2,   ///< Disks meet; the second does.
  cd1,  ///< Disk enters the curved face, not as far as the axis.
  cd2,  ///< Disk crosses the axis.
  cd3,  ///< The whole cylinder passes through the disk.
  cc1,  ///< Both curved faces meet.
  ss,   ///< Two spheres meet; has no name in the paper.
};

/// "none", "sc1", ...
[[nodiscard]] std::string_view name(PublishedContact contact) noexcept;

/// How faithful to the print.
enum class PublishedRepair {
  literal,  ///< As printed.
  typos,    ///< Slips of the pen repaired.
  chords,   ///< Typos and the disk-disk test repaired.
};

/// A flat disk in space: the end of a cylinder.
struct PublishedDisk {
  Vec3 center;
  double radius = 1.0;  ///< [L] > 0.
  Vec3 normal;          ///< Of any length > 0.
};

/// What Algorithm 1 finds on its way, in the letters of the paper.
struct PublishedSphereCylinder {
  PublishedContact type = PublishedContact::none;
  double x = 0.0;  ///< X: where the sphere stands along the axis, from the cylinder's center [L].
  Vec3 to_axis{};  ///< From the sphere's center to its projection on the axis [L]; its length is L.
};

/// What Algorithm 2 finds on its way.
struct PublishedDiskDisk {
  PublishedContact type = PublishedContact::none;
  Vec3 point{};  ///< pt; with chords repaired, the middle of what the two chords share [L].
  double distance_a = 0.0;  ///< Of the center of a from pt: from the common line [L].
  double distance_b =
      0.0;  ///< Of the center of b from its own projection; as printed, from pt [L].
};

/// What Algorithm 3 finds on its way; points relative to the center of the cylinder [L].
struct PublishedCylinderDisk {
  PublishedContact type = PublishedContact::none;
  Vec3 crossing{};  ///< a: where the axis meets the plane of the disk.
  Vec3 rim{};       ///< pt_c: the point of the rim next to `crossing`.
  Vec3 foot{};      ///< b: the projection of `rim` on the axis.
};

/// What steps 1 to 3.c of Algorithm 4 find; points relative to the center of the first cylinder
/// [L].
struct PublishedAxes {
  bool near = false;      ///< The distance of the axes, prolonged, is within the sum of the radii.
  bool cross = false;     ///< The nearest points lie on the cylinders: cc1, where near as well.
  double distance = 0.0;  ///< rho [L].
  Vec3 point_a{};         ///< pt_1, on the first axis.
  Vec3 point_b{};         ///< pt_2, on the second.
};

/// The end disks of a cylinder about `center`, normals outward, in the paper's order: +l, -l.
[[nodiscard]] std::array<PublishedDisk, 2> published_ends(const Cylinder& body,
                                                          const Vec3& center) noexcept;

/// Algorithms 1 to 3, and the part of 4 that looks at the axes, with what they find on their way.
/// Arguments as below.
[[nodiscard]] PublishedSphereCylinder published_sphere_cylinder_test(const Sphere& a,
                                                                     const Cylinder& b,
                                                                     const Vec3& r_ab) noexcept;
[[nodiscard]] PublishedDiskDisk published_disk_disk_test(const PublishedDisk& a,
                                                         const PublishedDisk& b,
                                                         PublishedRepair repair = {}) noexcept;
[[nodiscard]] PublishedCylinderDisk published_cylinder_disk_test(
    const Cylinder& a, const PublishedDisk& b, PublishedRepair repair = {}) noexcept;
[[nodiscard]] PublishedAxes published_axes_test(const Cylinder& a, const Cylinder& b,
                                                const Vec3& r_ab) noexcept;

/// Algorithm 1. r_ab: center of the cylinder minus center of the sphere [L].
[[nodiscard]] PublishedContact published_sphere_cylinder(const Sphere& a, const Cylinder& b,
                                                         const Vec3& r_ab) noexcept;

/// Algorithm 2. Both disks in one frame.
[[nodiscard]] PublishedContact published_disk_disk(const PublishedDisk& a, const PublishedDisk& b,
                                                   PublishedRepair repair = {}) noexcept;

/// Algorithm 3. The disk's center is relative to the center of the cylinder.
[[nodiscard]] PublishedContact published_cylinder_disk(const Cylinder& a, const PublishedDisk& b,
                                                       PublishedRepair repair = {}) noexcept;

/// Algorithm 4; of several types found, the first in the paper's order. r_ab: center of b minus
/// center of a [L]. Parallel axes divide 0 by 0, as in print: the outcome is then whatever
/// comparisons with NaN give, and `none` as a rule.
[[nodiscard]] PublishedContact published_cylinder_cylinder(const Cylinder& a, const Cylinder& b,
                                                           const Vec3& r_ab,
                                                           PublishedRepair repair = {}) noexcept;

}  // namespace packstone
