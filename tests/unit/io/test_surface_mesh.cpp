#include "packstone/io/surface_mesh.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone {
namespace {

std::vector<Body> bodies_3d() {
  RandomStream random(1, StreamId::test);
  return {Sphere{0.7},
          Ellipsoid{{0.3, 1.1, 2.0}, random_rotation(random)},
          Ellipsoid{{1e-6, 1.0, 1e3}, random_rotation(random)},
          Cylinder{0.4, 1.3, random_direction(random)},
          Cylinder{1.0, 0.01, {0, 0, -1}},
          Spherocylinder{0.4, 1.3, random_direction(random)},
          Spherocylinder{1.0, 1e-3, {1, 0, 0}}};
}

/// Volume inside the triangles, by the divergence theorem.
double enclosed_volume(const SurfaceMesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& t : mesh.triangles) {
    six_volumes += dot(mesh.points[t[0]], cross(mesh.points[t[1]], mesh.points[t[2]]));
  }
  return six_volumes / 6.0;
}

/// How often each directed edge occurs, equal places taken as one point.
std::map<std::pair<int, int>, int> directed_edges(const SurfaceMesh& mesh) {
  std::map<std::tuple<double, double, double>, int> places;
  std::vector<int> place_of;
  for (const Vec3& p : mesh.points) {
    place_of.push_back(
        places.try_emplace({p.x, p.y, p.z}, static_cast<int>(places.size())).first->second);
  }
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{place_of[t[i]], place_of[t[(i + 1) % 3]]}];
  }
  return edges;
}

TEST_CASE("every edge of a surface mesh belongs to two triangles, in opposite senses") {
  for (const Body& body : bodies_3d()) {
    for (const int segments : {8, 9, 11, 32}) {
      INFO(name(kind(body)) << ", " << segments << " segments");
      const auto edges = directed_edges(surface_mesh(body, segments));
      bool closed = true;
      for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        closed = closed && count == 1 && back != edges.end() && back->second == 1;
      }
      CHECK(closed);
    }
  }
}

TEST_CASE("triangles and normals of a surface mesh look outward") {
  for (const Body& body : bodies_3d()) {
    INFO(name(kind(body)));
    const SurfaceMesh mesh = surface_mesh(body, 24);
    double worst_length = 0.0;
    for (const Vec3& n : mesh.normals) {
      worst_length = std::max(worst_length, std::abs(norm(n) - 1.0));
    }
    CHECK(worst_length < 1e-9);  // the length of a stored axis may be off by as much
    bool outward = true;
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      const Vec3 across = cross(b - a, c - a);
      outward = outward && dot(across, a + b + c) > 0.0 && dot(across, mesh.normals[t[0]]) > 0.0;
    }
    CHECK(outward);
  }
}

TEST_CASE("the normal of a surface mesh is where the support function attains its maximum") {
  for (const Body& body : bodies_3d()) {
    INFO(name(kind(body)));
    const SurfaceMesh mesh = surface_mesh(body, 16);
    double worst = 0.0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const double reach = support(body, mesh.normals[i]);
      worst = std::max(
          worst, std::abs(dot(mesh.points[i], mesh.normals[i]) - reach) / norm(mesh.points[i]));
    }
    CHECK(worst < 1e-12);  // some rounding errors of the turned point
  }
}

TEST_CASE("the volume in a surface mesh grows to the exact one with the square of the segments") {
  for (const Body& body : bodies_3d()) {
    INFO(name(kind(body)));
    const double exact = volume(body);
    const double coarse = 1.0 - enclosed_volume(surface_mesh(body, 32)) / exact;
    const double fine = 1.0 - enclosed_volume(surface_mesh(body, 64)) / exact;
    CHECK(fine > 0.0);
    CHECK(fine < 5.0 / 12.0 * std::pow(2.0 * std::numbers::pi / 64, 2));
    CHECK(coarse / fine == Approx(4.0).epsilon(0.02));  // the next order is (2 pi / 32)^2 smaller
  }
}

TEST_CASE("points and triangles of a surface mesh are as many as foretold") {
  for (const Body& body : bodies_3d()) {
    for (const int segments : {8, 9, 10, 11, 40}) {
      const SurfaceMesh mesh = surface_mesh(body, segments);
      CHECK(mesh.points.size() == point_count(kind(body), segments));
      CHECK(mesh.normals.size() == mesh.points.size());
      CHECK(mesh.triangles.size() == triangle_count(kind(body), segments));
    }
  }
}

TEST_CASE("an outline runs counterclockwise and its area is that of the inscribed polygon") {
  for (const Body& body : {Body{Disk{0.3}}, Body{Ellipse{{2.0, 0.1}, 0.7}}}) {
    const std::vector<Vec3> points = outline(body, 40);
    REQUIRE(points.size() == 40);
    double twice_area = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      twice_area += cross(points[i], points[(i + 1) % points.size()]).z;
      CHECK(points[i].z == 0.0);
    }
    const double step = 2.0 * std::numbers::pi / 40;
    CHECK(0.5 * twice_area == Approx(volume(body) * std::sin(step) / step).epsilon(1e-12));
  }
}

TEST_CASE("surface meshes refuse bodies of the other dimension and segments out of range") {
  CHECK_THROWS_AS(surface_mesh(Disk{1.0}, 16), InvalidArgument);
  CHECK_THROWS_AS(outline(Sphere{1.0}, 16), InvalidArgument);
  CHECK_THROWS_WITH(surface_mesh(Sphere{1.0}, 7), "segments = 7, allowed are 8 to 4096");
  CHECK_THROWS_AS(outline(Disk{1.0}, 4097), InvalidArgument);
}

}  // namespace
}  // namespace packstone
