#include "packstone/structure/face_crossings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/structure/images.hpp"
#include "support/random_body.hpp"

namespace packstone {
namespace {

using Image = std::array<int, 3>;

const Cell kCells[] = {
    {3, {1, 0.5, 2}, {true, true, true}}, {3, {1, 0.5, 2}, {true, false, true}}, cell_2d(1.0, 0.7)};

Inclusion random_inclusion(const Cell& cell, RandomStream& random, double longest) {
  Inclusion one;
  one.body = test::random_body(test::random_shape(cell.dimension, random), random,
                               [&] { return random.uniform(0.02, longest); });
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    one.center[axis] = random.uniform(0.0, cell.size[axis]);
  }
  return one;
}

Ellipsoid random_ellipsoid(RandomStream& random, double least) {
  return std::get<Ellipsoid>(
      test::random_body(ShapeKind::ellipsoid, random, [&] { return random.uniform(least, 0.8); }));
}

std::set<Image> listed(const Cell& cell, const Inclusion& inclusion) {
  std::set<Image> images;
  for (const ImageInCell& one : images_reaching_in(cell, inclusion)) images.insert(one.image);
  return images;
}

Inclusion shifted(const Cell& cell, Inclusion inclusion, const Image& image) {
  inclusion.center += image_shift(cell, image);
  return inclusion;
}

// --- Judges of their own -------------------------------------------------------------------------

// E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013) 471-490, equations (17) to (23): the least
// value on the plane x_k = beta of the quadratic that is negative inside the ellipsoid.
double g_dagger(const Ellipsoid& body, const Vec3& center, std::size_t k, double beta) {
  const Vec3& s = body.semi_axes;
  const SymMat3 b = rotated_diagonal(to_matrix(body.orientation),
                                     {1 / (s.x * s.x), 1 / (s.y * s.y), 1 / (s.z * s.z)});
  const Vec3 d = -2.0 * (b * center);
  const double f = dot(center, b * center) - 1.0;
  Vec3 e[2], p;
  e[0][(k + 1) % 3] = e[1][(k + 2) % 3] = 1.0;
  p[k] = beta;
  const double b_ll = dot(e[0], b * e[0]), b_mm = dot(e[1], b * e[1]), b_lm = dot(e[0], b * e[1]);
  const Vec3 gradient = 2.0 * (b * p) + d;
  const double d_l = dot(e[0], gradient), d_m = dot(e[1], gradient);
  const double inverse =
      (b_mm * d_l * d_l - 2 * b_lm * d_l * d_m + b_ll * d_m * d_m) / (b_ll * b_mm - b_lm * b_lm);
  return -0.25 * inverse + dot(p, b * p) + dot(d, p) + f;
}

double distance_to_box(const Vec3& point, const Vec3& low, const Vec3& high) {
  Vec3 nearest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nearest[axis] = std::clamp(point[axis], low[axis], high[axis]);
  }
  return norm(point - nearest);
}

// By golden sections: the distance of a point to a convex set is convex along a line.
double distance_to_box(const Vec3& a, const Vec3& b, const Vec3& low, const Vec3& high) {
  const auto at = [&](double t) { return distance_to_box(a + t * (b - a), low, high); };
  constexpr double kGolden = 0.6180339887498949;
  double from = 0.0, to = 1.0;
  for (int step = 0; step < 80; ++step) {
    const double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
    if (at(left) < at(right)) {
      to = right;
    } else {
      from = left;
    }
  }
  return at(0.5 * (from + to));
}

// The least of (x - c)^T B (x - c) over a box: one coordinate at a time, which converges as the
// quadratic is smooth and the bounds do not couple coordinates.
double least_quadratic(const Ellipsoid& body, const Vec3& c, const Vec3& low, const Vec3& high) {
  const Vec3& s = body.semi_axes;
  const SymMat3 b = rotated_diagonal(to_matrix(body.orientation),
                                     {1 / (s.x * s.x), 1 / (s.y * s.y), 1 / (s.z * s.z)});
  const Vec3 diagonal{b.xx, b.yy, b.zz};
  Vec3 x;
  for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = std::clamp(c[axis], low[axis], high[axis]);
  for (int round = 0; round < 20000; ++round) {
    const Vec3 before = x;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double slope = (b * (x - c))[axis];
      x[axis] = std::clamp(x[axis] - slope / diagonal[axis], low[axis], high[axis]);
    }
    if (norm(x - before) < 1e-14) break;
  }
  return dot(x - c, b * (x - c));
}

// --- Planes and faces ----------------------------------------------------------------------------

TEST_CASE("an ellipsoid cuts the planes where the published quadratic is negative") {
  RandomStream random(1, StreamId::test);
  int cut = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Cell& cell = kCells[trial % 2];
    Inclusion one = random_inclusion(cell, random, 0.8);
    const Ellipsoid body = random_ellipsoid(random, 0.02);
    one.body = body;
    const CellFaces planes = planes_cut(cell, one);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = g_dagger(body, one.center, axis, 0.0);
      const double high = g_dagger(body, one.center, axis, cell.size[axis]);
      // Rounding of the quadratic, up to 2500 in size.
      if (std::abs(low) > 1e-9 && planes.low[axis] != (low < 0)) FAIL_CHECK(trial);
      if (std::abs(high) > 1e-9 && planes.high[axis] != (high < 0)) FAIL_CHECK(trial);
      cut += planes.low[axis] + planes.high[axis];
    }
  }
  CHECK(cut > 4000);
  CHECK(cut < 20000);
}

TEST_CASE("a face is cut where the body meets its rectangle, not only its plane") {
  const Cell cell;
  // Leaves through the face x = 0, and meets the plane y = 0 beyond it.
  const Vec3 axis = normalized(Vec3{2, 1, 0});
  const Inclusion rod{{0.3, 0.3, 0.5}, Spherocylinder{0.02, 1.0, axis}, 0};
  const CellFaces planes = planes_cut(cell, rod);
  CHECK(planes.low == std::array{true, true, false});
  CHECK(planes.high == std::array{true, false, false});
  const CellFaces faces = faces_cut(cell, rod);
  CHECK(faces.low == std::array{true, false, false});
  CHECK(faces.high == std::array{true, false, false});
  // Its neighbor at x + 1 enters through x = 1, then leaves through y = 0.
  const CellFaces next = faces_cut(cell, rod, {1, 0, 0});
  CHECK(next.low == std::array{false, true, false});
  CHECK(next.high == std::array{true, false, false});
}

TEST_CASE("a face touched within rounding counts as cut, one clear of it by more does not") {
  const double gap = 1e-12;
  for (const Body& body : {Body(Sphere{0.1}), Body(Cylinder{0.3, 0.1, {1, 0, 0}}),
                           Body(Ellipsoid{{0.1, 0.3, 0.2}, {}})}) {
    const Cell cell{3, {1, 1, 1}, {true, true, false}};
    CHECK(faces_cut(cell, {{0.1, 0.5, 0.5}, body, 0}).low[0]);
    CHECK_FALSE(faces_cut(cell, {{0.1 + gap, 0.5, 0.5}, body, 0}).low[0]);
    CHECK(faces_cut(cell, {{0.1 - gap, 0.5, 0.5}, body, 0}).low[0]);
    CHECK(faces_cut(cell, {{0.9, 0.5, 0.5}, body, 0}).high[0]);
    CHECK_FALSE(faces_cut(cell, {{0.9 - gap, 0.5, 0.5}, body, 0}).high[0]);
    CHECK_FALSE(faces_cut(cell, {{0.5, 0.5, 0.5}, body, 0}).any());
  }
  const Cell flat = cell_2d(1, 1);
  CHECK(faces_cut(flat, {{0.5, 0.9, 0}, Disk{0.1}, 0}) ==
        CellFaces{{false, false, false}, {false, true, false}});
}

TEST_CASE("faces cut are matched across periods for every shape, and lie in planes cut") {
  RandomStream random(2, StreamId::test);
  for (int trial = 0; trial < 3000; ++trial) {
    const Cell& cell = kCells[trial % 3];
    Inclusion one = random_inclusion(cell, random, 0.8);
    // Centers on a grid and equal lengths touch faces exactly.
    if (trial % 2 == 0) {
      one.center = {0.25, 0.25, 0.25 * (cell.dimension - 2)};
      one.body = cell.dimension == 3 ? Body(Sphere{0.25}) : Body(Ellipse{{0.25, 0.25}, 0.1});
    }
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= (cell.periodic[1] ? 1 : -1); ++y) {
        const Image image{x, cell.periodic[1] ? y : 0, 0};
        const CellFaces faces = faces_cut(cell, one, image);
        const CellFaces planes = planes_cut(cell, one, image);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (faces.low[axis] && !planes.low[axis]) FAIL_CHECK("not in the plane: " << trial);
          if (faces.high[axis] && !planes.high[axis]) FAIL_CHECK("not in the plane: " << trial);
          if (!cell.periodic[axis]) continue;
          Image before = image;
          --before[axis];
          if (faces.high[axis] != faces_cut(cell, one, before).low[axis]) {
            FAIL_CHECK("not matched: " << trial);
          }
        }
      }
    }
  }
}

// --- Images --------------------------------------------------------------------------------------

TEST_CASE("images of balls reach in where the nearest point of the cell says so") {
  RandomStream random(3, StreamId::test);
  std::size_t boxes = 0, bodies = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Cell& cell = kCells[trial % 3];
    Inclusion one = random_inclusion(cell, random, 0.8);
    const double radius = random.uniform(0.05, 0.8);
    one.body = cell.dimension == 3 ? Body(Sphere{radius}) : Body(Disk{radius});
    std::set<Image> expected;
    for (const Image& image : images_in_cell(cell, one)) {
      const Vec3 center = shifted(cell, one, image).center;
      if (distance_to_box(center, {}, cell.size) < radius) expected.insert(image);
      ++boxes;
    }
    if (listed(cell, one) != expected) FAIL_CHECK(trial);
    bodies += expected.size();
  }
  // Boxes of balls near edges and corners reach in where the balls do not.
  CHECK(100 * bodies < 95 * boxes);
}

TEST_CASE("images of ellipsoids and spherocylinders reach in where searches in the cell say so") {
  RandomStream random(4, StreamId::test);
  std::size_t boxes = 0, bodies = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Cell& cell = kCells[trial % 2];
    Inclusion one = random_inclusion(cell, random, 0.6);
    const Ellipsoid ellipsoid = random_ellipsoid(random, 0.05);
    const Spherocylinder rod{random.uniform(0.02, 0.2), random.uniform(0.1, 1.5),
                             random_direction(random)};
    for (const Body& body : {Body(ellipsoid), Body(rod)}) {
      one.body = body;
      const std::set<Image> found = listed(cell, one);
      for (const Image& image : images_in_cell(cell, one)) {
        const Vec3 c = shifted(cell, one, image).center;
        const Vec3 arm = rod.half_length * rod.axis;
        const double beyond = body.index() == 1
                                  ? least_quadratic(ellipsoid, c, {}, cell.size) - 1.0
                                  : distance_to_box(c - arm, c + arm, {}, cell.size) - rod.radius;
        ++boxes;
        bodies += found.count(image);
        // What the searches leave open.
        if (std::abs(beyond) < 1e-11) continue;
        if ((beyond < 0) != (found.count(image) == 1)) FAIL_CHECK(trial << " " << beyond);
      }
    }
  }
  CHECK(100 * bodies < 80 * boxes);
}

TEST_CASE("every point of a body of any shape lies in an image that is listed") {
  RandomStream random(5, StreamId::test);
  for (int trial = 0; trial < 300; ++trial) {
    const Cell& cell = kCells[trial % 3];
    const Inclusion one = random_inclusion(cell, random, 0.8);
    const std::set<Image> found = listed(cell, one);
    CHECK(found.count({0, 0, 0}) == 1);
    for (int probe = 0; probe < 300; ++probe) {
      // Points of the surface reach furthest.
      Vec3 d = random_direction(random);
      if (cell.dimension == 2) d.z = 0.0;
      const Vec3 point = one.center + support_point(one.body, d);
      Image image{};
      bool in_walls = true;
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
        if (cell.periodic[axis]) {
          image[axis] = -static_cast<int>(std::floor(point[axis] / cell.size[axis]));
        } else {
          in_walls = in_walls && point[axis] >= 0.0 && point[axis] <= cell.size[axis];
        }
      }
      if (in_walls && found.count(image) == 0) FAIL_CHECK("missed: " << trial);
    }
  }
}

TEST_CASE("each image lists the faces that it cuts, and those other than itself cut one at least") {
  const Cell cell;
  const auto images = images_reaching_in(cell, {{0.05, 0.5, 0.95}, Sphere{0.1}, 0});
  REQUIRE(images.size() == 4);
  const CellFaces corner{{true, false, false}, {false, false, true}};
  CHECK(images[0] == ImageInCell{{0, 0, -1}, {{true, false, true}, {false, false, false}}});
  CHECK(images[1] == ImageInCell{{0, 0, 0}, corner});
  CHECK(images[2] == ImageInCell{{1, 0, -1}, {{false, false, true}, {true, false, false}}});
  CHECK(images[3] == ImageInCell{{1, 0, 0}, {{false, false, false}, {true, false, true}}});
  // Too far from the edge for the fourth: its box reaches in, the ball does not.
  const Inclusion clear{{0.08, 0.5, 0.92}, Sphere{0.1}, 0};
  CHECK(images_in_cell(cell, clear).size() == 4);
  CHECK(images_reaching_in(cell, clear).size() == 3);

  RandomStream random(6, StreamId::test);
  for (int trial = 0; trial < 500; ++trial) {
    const Cell& periodic = kCells[trial % 3];
    for (const ImageInCell& one :
         images_reaching_in(periodic, random_inclusion(periodic, random, 0.8))) {
      CHECK((one.cuts.any() || one.image == Image{0, 0, 0}));
    }
  }
}

}  // namespace
}  // namespace packstone
