#pragma once

/// @file
/// All forces on all bodies: pairs over all images, own images, walls.

#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone::time_driven {

/// What acts on the bodies, at unit stiffness.
struct Loads {
  std::vector<Vec3> force;   ///< [L]
  std::vector<Vec3> torque;  ///< About the center [L^2].
  double energy = 0.0;       ///< Potential energy: the sum of the squared forces [L^2].
};

/// Every pair is looked at, as the paper does it.
class Interactions {
 public:
  Interactions(const Packing& packing, bool literal);

  /// The loads on the bodies where they are now; the bodies are those of the constructor.
  void evaluate(const std::vector<Inclusion>& inclusions, Loads& loads) const;

 private:
  void add_pair(const std::vector<Inclusion>& inclusions, std::size_t i, std::size_t j,
                Loads& loads) const;
  void add_own_images(const std::vector<Inclusion>& inclusions, std::size_t i, Loads& loads) const;
  void add_walls(const Inclusion& inclusion, std::size_t i, Loads& loads) const;
  void add_forces(const std::vector<Inclusion>& inclusions, std::size_t i, std::size_t j,
                  const Vec3& r, Loads& loads) const;

  Cell cell_;
  bool literal_;
  std::vector<double> reach_;
};

}  // namespace packstone::time_driven
