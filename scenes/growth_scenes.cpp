#include "growth_scenes.hpp"

#include <cmath>
#include <numbers>

#include "packstone/core/random.hpp"
#include "packstone/geometry/measures.hpp"
#include "scenes.hpp"

namespace packstone::scenes {
namespace {

constexpr double kPi = std::numbers::pi;

RandomStream stream(std::uint64_t seed, StreamId id, std::int64_t body) {
  return {seed, id, 0, static_cast<std::uint64_t>(body)};
}

std::vector<OrderedBody> equal_bodies(std::int64_t count, const Body& body) {
  return std::vector<OrderedBody>(static_cast<std::size_t>(count), OrderedBody{body, 0});
}

}  // namespace

EllipsoidScene alike(std::string_view name, int count, double fraction, double r_1, double r_2) {
  return {name, count, fraction, {r_1, r_1}, {r_2, r_2}};
}

const std::vector<EllipsoidScene>& ghossein_table_2() {
  static const std::vector<EllipsoidScene> rows = {
      alike("prolate-2", 30, 0.60, 2, 2),     alike("prolate-5", 45, 0.55, 5, 5),
      alike("prolate-10", 90, 0.30, 10, 10),  alike("prolate-20", 175, 0.20, 20, 20),
      alike("prolate-30", 175, 0.10, 30, 30), alike("prolate-40", 310, 0.10, 40, 40),
      alike("oblate-2", 30, 0.60, 2, 1),      alike("oblate-5", 45, 0.55, 5, 1),
      alike("oblate-10", 60, 0.30, 10, 1),    alike("oblate-20", 75, 0.20, 20, 1),
      alike("oblate-30", 90, 0.10, 30, 1),    alike("oblate-40", 100, 0.10, 40, 1),
  };
  return rows;
}

const std::vector<EllipsoidScene>& ghossein_figures() {
  static const std::vector<EllipsoidScene> figures = {
      alike("fig-2a", 100, 0.40, 3, 3),     alike("fig-2b", 300, 0.10, 40, 40),
      alike("fig-3a", 100, 0.40, 3, 1),     alike("fig-3b", 50, 0.15, 20, 1),
      alike("fig-4a", 100, 0.30, 2, 5),     alike("fig-4b", 1000, 0.20, 4, 0.5),
      {"fig-5a", 50, 0.30, {1, 5}, {1, 5}}, {"fig-5b", 125, 0.20, {0.1, 2}, {0.1, 2}},
  };
  return figures;
}

std::vector<OrderedBody> ellipsoids(const EllipsoidScene& scene, std::uint64_t seed) {
  std::vector<OrderedBody> bodies;
  double total = 0.0;
  for (std::int64_t k = 0; k < scene.count; ++k) {
    RandomStream aspects = stream(seed, StreamId::aspects, k);
    RandomStream turns = stream(seed, StreamId::orientations, k);
    const double r_1 = aspects.uniform(scene.r_1[0], scene.r_1[1]);
    const double r_2 = aspects.uniform(scene.r_2[0], scene.r_2[1]);
    bodies.push_back({Ellipsoid{{1.0, 1.0 / r_1, 1.0 / r_2}, random_rotation(turns)}, 0});
    total += volume(bodies.back().body);
  }
  const double a = std::cbrt(scene.fraction / total);
  for (OrderedBody& ordered : bodies) ordered.body = scaled(ordered.body, a);
  return bodies;
}

std::vector<OrderedBody> equal_spheres(std::int64_t count, double fraction) {
  return equal_bodies(count,
                      Sphere{std::cbrt(3.0 * fraction / (4.0 * kPi * static_cast<double>(count)))});
}

std::vector<OrderedBody> equal_cylinders(std::int64_t count, double fraction, double aspect,
                                         std::uint64_t seed) {
  const double r = std::cbrt(fraction / (2.0 * kPi * aspect * static_cast<double>(count)));
  auto bodies = equal_bodies(count, Cylinder{r, aspect * r, {0, 0, 1}});
  for (std::int64_t k = 0; k < count; ++k) {
    RandomStream turns = stream(seed, StreamId::orientations, k);
    std::get<Cylinder>(bodies[static_cast<std::size_t>(k)].body).axis = random_direction(turns);
  }
  return bodies;
}

std::vector<OrderedBody> equal_volume_mixture(int count_each, double fraction, double aspect,
                                              std::uint64_t seed) {
  return cylinders_and_spheres(count_each, 0.5 * fraction, 0.5 * fraction, aspect, seed);
}

std::vector<OrderedBody> equal_disks(std::int64_t count, double fraction) {
  return equal_bodies(count, Disk{std::sqrt(fraction / (kPi * static_cast<double>(count)))});
}

std::vector<OrderedBody> equal_ellipses(std::int64_t count, double fraction, double aspect,
                                        std::uint64_t seed) {
  const double b = std::sqrt(fraction / (kPi * aspect * static_cast<double>(count)));
  auto bodies = equal_bodies(count, Ellipse{{aspect * b, b}, 0.0});
  for (std::int64_t k = 0; k < count; ++k) {
    RandomStream turns = stream(seed, StreamId::orientations, k);
    std::get<Ellipse>(bodies[static_cast<std::size_t>(k)].body).angle = kPi * turns.uniform();
  }
  return bodies;
}

}  // namespace packstone::scenes
