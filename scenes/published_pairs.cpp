#include "published_pairs.hpp"

#include <cstddef>

namespace packstone::scenes {
namespace {

Cylinder rod(const Vec3& along) { return {1.0, 3.0, normalized(along)}; }

}  // namespace

const std::array<PublishedPair, 15>& published_pairs() {
  static const Cylinder upright = rod({0, 0, 1}), across = rod({1, 0, 0});
  static const Sphere ball{1.0};
  static const std::array<PublishedPair, 15> pairs{{
      {15, ball, Sphere{0.5}, {0.6, 0.8, 0}},
      {16, upright, ball, {1.5, 0, 0}},
      {17, upright, ball, {1.5, 0, 2}},
      {18, upright, ball, {0, 0, 2.5}},
      {19, upright, ball, {0.5, 0, 3.4}},
      {20, upright, ball, {1.5, 0, 3.4}},
      {21, upright, across, {0, 1.4, 0}},
      {22, upright, across, {0, 1.4, 2}},
      {23, upright, across, {2, 1.4, 2}},
      {24, upright, rod({1, 0, 0.4}), {4.0, 0, 1.0}},
      {25, upright, upright, {0.8, 0, 2}},
      {26, upright, rod({-0.38, -0.49, -0.78}), {2.52, 0.46, 2.0}},
      {27, upright, rod({0.36, -0.63, -0.69}), {1.97, -0.43, 2.57}},
      {28, upright, rod({1, 0, 1}), {3.0, 0, 4.6}},
      {29, upright, rod({1, 0, 0.3}), {2.0, 0, 0.6}},
  }};
  return pairs;
}

const PublishedPair& published_pair(int figure) {
  return published_pairs().at(static_cast<std::size_t>(figure - 15));
}

}  // namespace packstone::scenes
