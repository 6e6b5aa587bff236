#pragma once

/// @file
/// Packing: a cell and the inclusions in it. Says nothing about the method that made it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/structure/certificate.hpp"

namespace packstone {

/// One body in the cell. Its periodic images are implied.
struct Inclusion {
  Vec3 center;    ///< Inside the cell [L]; z = 0 in 2D.
  Body body;      ///< Shape and orientation.
  int group = 0;  ///< Index into Packing::groups.

  friend bool operator==(const Inclusion&, const Inclusion&) = default;
};

/// Where a packing came from; free text, kept through every round trip.
struct Provenance {
  std::string method;      ///< "rsa", ...
  std::string stop;        ///< Why the method stopped: "target_reached", "saturated", ...
  std::string version;     ///< Version of the program that made it.
  std::uint64_t seed = 0;  ///< Key of the run.
  double seconds = 0.0;    ///< Processor time of the method [s].
  std::string
      recipe_json;  ///< The recipe as a JSON object with all overrides applied; may be empty.

  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// A cell and its inclusions.
struct Packing {
  Cell cell;
  std::vector<std::string> groups;    ///< Names of the groups, in the order of the recipe.
  std::vector<Inclusion> inclusions;  ///< In the order of the file.
  std::optional<Certificate> certificate;
  std::optional<Provenance> provenance;
};

/// Sum of the exact volumes of the inclusions over the volume of the cell [-].
[[nodiscard]] double fraction(const Packing& packing) noexcept;

/// Throws InvalidArgument, naming the inclusion and the field, when the packing is not well formed:
/// a bad cell, a body that check_body() refuses or that is not of the dimension of the cell, a
/// center that is not finite or lies outside the cell, a group that does not exist.
void check_well_formed(const Packing& packing);

}  // namespace packstone
