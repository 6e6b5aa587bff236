#include "generate/published_event_driven/faces.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "moving_pairs.hpp"
#include "packstone/geometry/bounds.hpp"

namespace packstone {
namespace {

using namespace moving_pairs;
using published::image_shifts;

MovingEllipsoid random_body(RandomStream& random) {
  const auto length = [&] { return random.uniform(0.02, 0.3); };
  return {.center = {random.uniform(), random.uniform(), random.uniform()},
          .orientation = random_rotation(random),
          .velocity = random_direction(random),
          .angular_velocity = 5.0 * random_direction(random),
          .semi_axes = {length(), length(), length()},
          .growth = {0.01, 0.02, 0.03}};
}

TEST_CASE("the face function is below zero where the bounding box crosses the plane") {
  RandomStream random(76, StreamId::test);
  for (int i = 0; i < 500; ++i) {
    const MovingEllipsoid moving = random_body(random);
    const Vec3 extent = half_extents(Body{body_of(moving)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double edge = moving.center[axis] + extent[axis];
      CHECK(published_face_function(moving, axis, edge) == Approx(0.0).margin(1e-10));
      CHECK(published_face_function(moving, axis, edge + 1e-6) > 0.0);
      CHECK(published_face_function(moving, axis, edge - 1e-6) < 0.0);
      CHECK(published_face_function(moving, axis, moving.center[axis]) == Approx(-1.0));
    }
  }
}

TEST_CASE("bodies reach faces when their bounding boxes do") {
  RandomStream random(77, StreamId::test);
  int reaching = 0, wrong = 0;
  for (int i = 0; i < 500; ++i) {
    const MovingEllipsoid moving = random_body(random);
    const auto axis = static_cast<std::size_t>(random.below(3));
    const double plane = random.below(2) == 0 ? 0.0 : 1.0;
    const auto clear = [&](double t) {
      const MovingEllipsoid later = published_moved(moving, t);
      return std::abs(plane - later.center[axis]) > half_extents(Body{body_of(later)})[axis];
    };
    if (!clear(0.0)) continue;
    double first = 1.0;
    for (int k = 1; k <= 4000 && first == 1.0; ++k) {
      if (!clear(k / 4000.0)) first = k / 4000.0;
    }
    const auto found = published_face_time(moving, axis, plane, 1.0, {.samples = 200});
    reaching += found.has_value();
    wrong += found.has_value() != (first < 1.0);
    if (found && first < 1.0) CHECK(*found == Approx(first).margin(1.0 / 4000.0));
  }
  CHECK(reaching > 100);
  CHECK(wrong == 0);
}

TEST_CASE("a body has 1, 3 or 7 images for 1, 2 or 3 faces that it crosses") {
  const auto count = [](const Vec3& center) {
    const MovingEllipsoid moving{.center = center, .semi_axes = {0.1, 0.1, 0.1}};
    return image_shifts(kUnitCube, moving).size();
  };
  CHECK(count({0.5, 0.5, 0.5}) == 1);
  CHECK(count({0.05, 0.5, 0.5}) == 2);
  CHECK(count({0.05, 0.5, 0.95}) == 4);
  CHECK(count({0.05, 0.92, 0.95}) == 8);
  // Centers are not wrapped: the same images from anywhere.
  const MovingEllipsoid outside{.center = {2.05, -1.5, 0.5}, .semi_axes = {0.1, 0.1, 0.1}};
  const std::vector<published::Shift> shifts = image_shifts(kUnitCube, outside);
  CHECK(shifts == std::vector<published::Shift>{{-2, 2, 0}, {-1, 2, 0}});
}

}  // namespace
}  // namespace packstone
