#include "packstone/io/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/overloaded.hpp"

namespace packstone {
namespace {

/// A point of the curve that is turned about z, and the normal of the surface there.
struct ProfilePoint {
  double radius;
  double z;
  double normal_radius;
  double normal_z;
};

/// From the upper end to the lower one; a radius of 0 closes the surface in a pole.
using Profile = std::vector<ProfilePoint>;

/// Cosine and sine of each step around the circle, the first at angle 0.
std::vector<Vec2> circle(int segments) {
  std::vector<Vec2> points;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / segments;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

int add_ring(SurfaceMesh& mesh, const ProfilePoint& p, const std::vector<Vec2>& directions) {
  const int first = static_cast<int>(mesh.points.size());
  if (p.radius == 0.0) {
    mesh.points.push_back({0, 0, p.z});
    mesh.normals.push_back({0, 0, p.normal_z});
    return first;
  }
  for (const Vec2& d : directions) {
    mesh.points.push_back({p.radius * d.x, p.radius * d.y, p.z});
    mesh.normals.push_back({p.normal_radius * d.x, p.normal_radius * d.y, p.normal_z});
  }
  return first;
}

/// Adds the surface that `profile` sweeps when it is turned about z.
void add_revolved(SurfaceMesh& mesh, const Profile& profile, int segments) {
  const std::vector<Vec2> directions = circle(segments);
  int upper = add_ring(mesh, profile.front(), directions);
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const bool upper_pole = profile[i - 1].radius == 0.0;
    const bool lower_pole = profile[i].radius == 0.0;
    const int lower = add_ring(mesh, profile[i], directions);
    for (int j = 0; j < segments; ++j) {
      const int next = (j + 1) % segments;
      if (!lower_pole)
        mesh.triangles.push_back({upper_pole ? upper : upper + j, lower + j, lower + next});
      if (!upper_pole)
        mesh.triangles.push_back({upper + j, lower_pole ? lower : lower + next, upper + next});
    }
    upper = lower;
  }
}

/// The half circle about (0, z) from angle `first` to `last` out of `steps` in a half turn, with
/// exact poles.
void add_arc(Profile& profile, double radius, double z, int first, int last, int steps) {
  for (int i = first; i <= last; ++i) {
    const double angle = std::numbers::pi * i / steps;
    const bool pole = i == 0 || i == steps;
    const double s = pole ? 0.0 : std::sin(angle);
    const double c = i == 0 ? 1.0 : i == steps ? -1.0 : 2 * i == steps ? 0.0 : std::cos(angle);
    profile.push_back({radius * s, z + radius * c, s, c});
  }
}

// A multiple of four, so that the equator of a spherocylinder's ends is a ring.
int steps_of_half_turn(int segments) { return 2 * ((segments + 3) / 4); }

SurfaceMesh ball(double radius, int segments) {
  SurfaceMesh mesh;
  Profile profile;
  const int steps = steps_of_half_turn(segments);
  add_arc(profile, radius, 0.0, 0, steps, steps);
  add_revolved(mesh, profile, segments);
  return mesh;
}

SurfaceMesh rod(double radius, double half_length, int segments) {
  SurfaceMesh mesh;
  const double r = radius, h = half_length;
  add_revolved(mesh, {{0, h, 0, 1}, {r, h, 0, 1}}, segments);
  add_revolved(mesh, {{r, h, 1, 0}, {r, -h, 1, 0}}, segments);
  add_revolved(mesh, {{r, -h, 0, -1}, {0, -h, 0, -1}}, segments);
  return mesh;
}

SurfaceMesh capsule(double radius, double half_length, int segments) {
  SurfaceMesh mesh;
  Profile profile;
  const int steps = steps_of_half_turn(segments);
  add_arc(profile, radius, half_length, 0, steps / 2, steps);
  add_arc(profile, radius, -half_length, steps / 2, steps, steps);
  add_revolved(mesh, profile, segments);
  return mesh;
}

SurfaceMesh turned(SurfaceMesh mesh, const Mat3& frame) {
  for (Vec3& point : mesh.points) point = frame * point;
  for (Vec3& normal : mesh.normals) normal = frame * normal;
  return mesh;
}

// The normal of an ellipsoid is that of the ball before stretching, divided by the stretch.
SurfaceMesh stretched(SurfaceMesh mesh, const Vec3& factors) {
  for (Vec3& point : mesh.points) point = scale(factors, point);
  // Over the smallest factor, so that very different axes neither over- nor underflow.
  const double least = std::min({factors.x, factors.y, factors.z});
  for (Vec3& normal : mesh.normals) {
    normal =
        normalized(scale(normal, Vec3{least / factors.x, least / factors.y, least / factors.z}));
  }
  return mesh;
}

void check_segments(int segments) {
  if (segments >= 8 && segments <= 4096) return;
  throw InvalidArgument("segments = " + std::to_string(segments) + ", allowed are 8 to 4096");
}

[[noreturn]] void refuse_dimension(const Body& body, const char* wanted) {
  throw InvalidArgument("a " + std::string(name(kind(body))) + " has no " + wanted);
}

}  // namespace

SurfaceMesh surface_mesh(const Body& body, int segments) {
  check_segments(segments);
  const auto no_surface = [&](const auto&) -> SurfaceMesh { refuse_dimension(body, "surface"); };
  return std::visit(
      Overloaded{
          [&](const Sphere& b) { return ball(b.radius, segments); },
          [&](const Ellipsoid& b) {
            return turned(stretched(ball(1.0, segments), b.semi_axes), to_matrix(b.orientation));
          },
          [&](const Cylinder& b) {
            return turned(rod(b.radius, b.half_length, segments), to_matrix(from_z_to(b.axis)));
          },
          [&](const Spherocylinder& b) {
            return turned(capsule(b.radius, b.half_length, segments), to_matrix(from_z_to(b.axis)));
          },
          [&](const Disk& b) { return no_surface(b); },
          [&](const Ellipse& b) { return no_surface(b); }},
      body);
}

// Rings of `segments` points and two poles; between two rings two triangles a segment, at a pole
// one. The cylinder has a ring twice at each rim.
std::size_t point_count(ShapeKind shape, int segments) {
  const auto n = static_cast<std::size_t>(segments);
  const auto steps = static_cast<std::size_t>(steps_of_half_turn(segments));
  if (shape == ShapeKind::cylinder) return 4 * n + 2;
  return (shape == ShapeKind::spherocylinder ? steps : steps - 1) * n + 2;
}

std::size_t triangle_count(ShapeKind shape, int segments) {
  const auto n = static_cast<std::size_t>(segments);
  const auto steps = static_cast<std::size_t>(steps_of_half_turn(segments));
  if (shape == ShapeKind::cylinder) return 4 * n;
  return 2 * (shape == ShapeKind::spherocylinder ? steps : steps - 1) * n;
}

std::vector<Vec3> outline(const Body& body, int segments) {
  check_segments(segments);
  if (dimension(kind(body)) != 2) refuse_dimension(body, "outline");
  const auto* disk = std::get_if<Disk>(&body);
  const Ellipse ellipse =
      disk != nullptr ? Ellipse{{disk->radius, disk->radius}, 0.0} : std::get<Ellipse>(body);
  const double c = std::cos(ellipse.angle), s = std::sin(ellipse.angle);
  std::vector<Vec3> points;
  for (const Vec2& d : circle(segments)) {
    const Vec2 p{ellipse.semi_axes.x * d.x, ellipse.semi_axes.y * d.y};
    points.push_back({c * p.x - s * p.y, s * p.x + c * p.y, 0.0});
  }
  return points;
}

}  // namespace packstone
