#include "scenes.hpp"

#include <bit>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "packstone/core/overloaded.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::scenes {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      state_ = (state_ ^ (word & 0xff)) * 0x100000001b3ULL;
      word >>= 8;
    }
  }
  void add(std::initializer_list<double> values) {
    for (double value : values) add(std::bit_cast<std::uint64_t>(value));
  }
  [[nodiscard]] std::uint64_t state() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

void add_body(Hash& hash, const Body& body) {
  hash.add(static_cast<std::uint64_t>(body.index()));
  const auto rod = [&](const auto& b) {
    hash.add({b.radius, b.half_length, b.axis.x, b.axis.y, b.axis.z});
  };
  std::visit(
      Overloaded{[&](const Sphere& b) { hash.add({b.radius}); },
                 [&](const Ellipsoid& b) {
                   const auto& q = b.orientation;
                   hash.add({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z, q.w, q.x, q.y, q.z});
                 },
                 [&](const Cylinder& b) { rod(b); }, [&](const Spherocylinder& b) { rod(b); },
                 [&](const Disk& b) { hash.add({b.radius}); },
                 [&](const Ellipse& b) {
                   hash.add({b.semi_axes.x, b.semi_axes.y, b.angle});
                 }},
      body);
}

bool clears_own_images_in_unit_cube(const Cylinder& body) {
  if (2.0 * circum_radius(body) < 1.0) return true;
  for (int k = 0; k < 27; ++k) {
    const Vec3 shift{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
    if (k != 13 && overlap(body, body, shift) != Verdict::separated) return false;
  }
  return true;
}

}  // namespace

std::uint64_t state_hash(const Packing& packing) {
  Hash hash;
  for (const Inclusion& inclusion : packing.inclusions) {
    hash.add({inclusion.center.x, inclusion.center.y, inclusion.center.z});
    add_body(hash, inclusion.body);
  }
  return hash.state();
}

std::vector<OrderedBody> cylinders_and_spheres(int count_each, double sphere_fraction,
                                               double cylinder_fraction, double aspect,
                                               std::uint64_t seed) {
  constexpr double pi = std::numbers::pi;
  std::vector<OrderedBody> bodies;
  const double r = std::cbrt(cylinder_fraction / (2.0 * pi * aspect * count_each));
  for (int k = 0; k < count_each; ++k) {
    RandomStream random(seed, StreamId::orientations, 0, static_cast<std::uint64_t>(k));
    Cylinder cylinder{r, aspect * r, random_direction(random)};
    while (!clears_own_images_in_unit_cube(cylinder)) cylinder.axis = random_direction(random);
    bodies.push_back({cylinder, 0});
  }
  const double radius = std::cbrt(3.0 * sphere_fraction / (4.0 * pi * count_each));
  for (int k = 0; k < count_each; ++k) bodies.push_back({Sphere{radius}, 1});
  return bodies;
}

std::vector<OrderedBody> equal_ellipsoids(std::int64_t count, double fraction, double aspect,
                                          std::uint64_t seed) {
  const double b =
      std::cbrt(3.0 * fraction / (4.0 * std::numbers::pi * aspect * static_cast<double>(count)));
  std::vector<OrderedBody> bodies;
  bodies.reserve(static_cast<std::size_t>(count));
  for (std::int64_t k = 0; k < count; ++k) {
    RandomStream random(seed, StreamId::orientations, 0, static_cast<std::uint64_t>(k));
    bodies.push_back({Ellipsoid{{aspect * b, b, b}, random_rotation(random)}, 0});
  }
  return bodies;
}

}  // namespace packstone::scenes
