#include "generate/published_time_driven/interactions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "packstone/generate/published_time_driven.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/structure/images.hpp"

namespace packstone::time_driven {
namespace {

struct Range {
  int lo = 0;
  int hi = 0;
};

// The periods by which a point at `offset` may be shifted to come within `reach` of 0.
Range periods(double offset, double reach, double size, bool periodic) {
  if (!periodic) return {};
  return {static_cast<int>(std::ceil((-reach - offset) / size)),
          static_cast<int>(std::floor((reach - offset) / size))};
}

// The points of a body that reach deepest into a wall whose inward normal is n: one of a sphere,
// one of each end of a cylinder, so that a cylinder along the wall is not turned by it.
struct Deepest {
  std::array<Vec3, 2> points{};
  std::size_t count = 1;
};

Deepest deepest(const Body& body, const Vec3& n) {
  if (const auto* sphere = std::get_if<Sphere>(&body)) return {{-sphere->radius * n}, 1};
  const auto& cylinder = std::get<Cylinder>(body);
  const Vec3 across = n - dot(n, cylinder.axis) * cylinder.axis;
  const double length = norm(across);
  const Vec3 rim = length > 0.0 ? -(cylinder.radius / length) * across : Vec3{};
  const Vec3 l = cylinder.half_length * cylinder.axis;
  return {{l + rim, rim - l}, 2};
}

}  // namespace

Interactions::Interactions(const Packing& packing, bool literal)
    : cell_(packing.cell), literal_(literal) {
  for (const Inclusion& inclusion : packing.inclusions) {
    reach_.push_back(circum_radius(inclusion.body));
  }
}

void Interactions::evaluate(const std::vector<Inclusion>& inclusions, Loads& loads) const {
  loads.force.assign(inclusions.size(), {});
  loads.torque.assign(inclusions.size(), {});
  loads.energy = 0.0;
  for (std::size_t i = 0; i < inclusions.size(); ++i) {
    add_own_images(inclusions, i, loads);
    add_walls(inclusions[i], i, loads);
    for (std::size_t j = i + 1; j < inclusions.size(); ++j) add_pair(inclusions, i, j, loads);
  }
}

void Interactions::add_pair(const std::vector<Inclusion>& inclusions, std::size_t i, std::size_t j,
                            Loads& loads) const {
  const Vec3 r = inclusions[j].center - inclusions[i].center;
  const double reach = reach_[i] + reach_[j];
  std::array<Range, 3> range;
  for (std::size_t a = 0; a < 3; ++a) {
    range[a] = periods(r[a], reach, cell_.size[a], cell_.periodic[a]);
    if (range[a].lo > range[a].hi) return;
  }
  for (int x = range[0].lo; x <= range[0].hi; ++x) {
    for (int y = range[1].lo; y <= range[1].hi; ++y) {
      for (int z = range[2].lo; z <= range[2].hi; ++z) {
        const Vec3 to_image = r + image_shift(cell_, {x, y, z});
        if (norm_sq(to_image) < reach * reach) add_forces(inclusions, i, j, to_image, loads);
      }
    }
  }
}

// What a body and its own image do to each other leaves it where it is, but may turn it.
void Interactions::add_own_images(const std::vector<Inclusion>& inclusions, std::size_t i,
                                  Loads& loads) const {
  const Vec3 half_extents{reach_[i], reach_[i], reach_[i]};
  for_own_images(cell_, half_extents, 0.0, [&](const std::array<int, 3>& image) {
    add_forces(inclusions, i, i, image_shift(cell_, image), loads);
    return true;
  });
}

void Interactions::add_forces(const std::vector<Inclusion>& inclusions, std::size_t i,
                              std::size_t j, const Vec3& r, Loads& loads) const {
  const PublishedForces forces =
      published_forces(inclusions[i].body, inclusions[j].body, r, literal_);
  for (const PublishedForce& force : forces) {
    loads.force[i] += force.on_a;
    loads.torque[i] += cross(force.point, force.on_a);
    loads.force[j] -= force.on_a;
    loads.torque[j] -= cross(force.point - r, force.on_a);
    loads.energy += norm_sq(force.on_a);
  }
}

void Interactions::add_walls(const Inclusion& inclusion, std::size_t i, Loads& loads) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell_.periodic[axis]) continue;
    for (const double sign : {1.0, -1.0}) {
      Vec3 n;
      n[axis] = sign;
      const double distance =
          sign > 0.0 ? inclusion.center[axis] : cell_.size[axis] - inclusion.center[axis];
      const Deepest at = deepest(inclusion.body, n);
      for (std::size_t k = 0; k < at.count; ++k) {
        const double depth = -dot(at.points[k], n) - distance;
        if (depth <= 0.0) continue;
        loads.force[i] += depth * n;
        loads.torque[i] += cross(at.points[k], depth * n);
        loads.energy += depth * depth;
      }
    }
  }
}

}  // namespace packstone::time_driven
