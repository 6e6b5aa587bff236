#include "packstone/structure/moving_packing.hpp"

#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

void check_vectors(const char* field, const std::vector<Vec3>& vectors, std::size_t inclusions) {
  if (vectors.size() != inclusions) {
    throw InvalidArgument(std::string(field) + ": has " + std::to_string(vectors.size()) +
                          " vectors, allowed is one for each of the " + std::to_string(inclusions) +
                          " inclusions");
  }
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::isfinite(vectors[i][axis])) continue;
      throw InvalidArgument("inclusion " + std::to_string(i) + ": " + field + "[" +
                            std::to_string(axis) + "] = " + number_text(vectors[i][axis]) +
                            ", allowed are finite numbers");
    }
  }
}

}  // namespace

Packing at_present_size(const MovingPacking& moving) {
  Packing packing = moving.packing;
  packing.certificate.reset();
  for (Inclusion& inclusion : packing.inclusions) {
    inclusion.body = scaled(inclusion.body, moving.size_factor);
  }
  return packing;
}

void check_moving(const MovingPacking& moving) {
  check_well_formed(moving.packing);
  if (!(moving.size_factor > 0.0) || !std::isfinite(moving.size_factor)) {
    throw InvalidArgument("size_factor = " + number_text(moving.size_factor, 17) +
                          ", allowed are finite numbers > 0");
  }
  const std::size_t inclusions = moving.packing.inclusions.size();
  check_vectors("velocity", moving.velocity, inclusions);
  check_vectors("angular_velocity", moving.angular_velocity, inclusions);
}

}  // namespace packstone
