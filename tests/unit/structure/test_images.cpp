#include "packstone/structure/images.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

namespace packstone {
namespace {

using Image = std::array<int, 3>;

TEST_CASE("own images are visited once per pair, and none is missed whose box comes near") {
  const Cell cells[] = {
      {3, {1, 0.5, 2}, {true, true, true}}, {3, {1, 0.5, 2}, {true, false, true}}, cell_2d(1, 0.7)};
  const Vec3 half{1.3, 0.6, 0.9};
  const double gap = 0.15;
  for (const Cell& cell : cells) {
    std::set<Image> seen;
    for_own_images(cell, half, gap, [&](const Image& image) {
      CHECK(seen.insert(image).second);
      CHECK(seen.count({-image[0], -image[1], -image[2]}) == 0);
      return true;
    });
    for (int x = -9; x <= 9; ++x) {
      for (int y = -9; y <= 9; ++y) {
        for (int z = -9; z <= 9; ++z) {
          const Image image{x, y, z};
          const Vec3 shift = image_shift(cell, image);
          bool near = image != Image{0, 0, 0};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            near = near && (cell.periodic[axis] ? std::abs(shift[axis]) <= 2 * half[axis] + gap
                                                : image[axis] == 0);
          }
          const bool found = seen.count(image) + seen.count({-x, -y, -z}) > 0;
          CHECK(found == near);
        }
      }
    }
  }
}

TEST_CASE("visits of own images end with the first that says so") {
  int visits = 0;
  CHECK_FALSE(for_own_images(Cell{}, {3, 3, 3}, 0.0, [&](const Image&) { return ++visits < 5; }));
  CHECK(visits == 5);
  CHECK(for_own_images(Cell{}, {0.4, 0.4, 0.4}, 0.0, [](const Image&) { return false; }));
}

TEST_CASE("bodies with too many own images are refused by their boxes") {
  CHECK_FALSE(why_too_many_own_images(Cell{}, {250, 0.1, 0.1}).has_value());
  CHECK(why_too_many_own_images(Cell{}, {251, 0.1, 0.1}).has_value());
  CHECK(why_too_many_own_images(Cell{}, {60, 60, 60}).has_value());
  CHECK_FALSE(why_too_many_own_images({3, {1, 1, 1}, {false, true, true}}, {251, 0.1, 0.1}));
}

TEST_CASE("the images whose box meets the cell are those of a direct test of many") {
  const Cell cell{3, {1, 0.5, 2}, {true, false, true}};
  const Inclusion inclusion{{0.9, 0.2, 0.1}, Ellipsoid{{1.2, 0.1, 0.3}, {}}, 0};
  std::set<Image> expected;
  for (int x = -9; x <= 9; ++x) {
    for (int z = -9; z <= 9; ++z) {
      const Vec3 c = inclusion.center + image_shift(cell, {x, 0, z});
      const bool meets = c.x + 1.2 >= 0 && c.x - 1.2 <= 1 && c.z + 0.3 >= 0 && c.z - 0.3 <= 2;
      if (meets) expected.insert({x, 0, z});
    }
  }
  const auto found = images_in_cell(cell, inclusion);
  CHECK(std::set<Image>(found.begin(), found.end()) == expected);
  CHECK(found.size() == expected.size());
}

}  // namespace
}  // namespace packstone
