#pragma once

/// @file
/// From a recipe to a certified packing.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "packstone/core/mat.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// What was ordered of one group, and what stands.
struct GroupOutcome {
  std::string name;
  std::optional<std::int64_t> ordered_count;  ///< Absent: as many as fit.
  std::int64_t count = 0;
  std::optional<double> ordered_fraction;  ///< Absent: as much as fits [-].
  double fraction = 0.0;                   ///< [-].
  /// true: orientations were redrawn with the trials, which favors those that fit.
  bool redrawn = false;
  /// Sample mean of u u^T over the symmetry axes u as they were drawn, and over those that stand
  /// [-]. Absent for spheres and disks; the ordered one also where the count is open.
  std::optional<SymMat3> ordered_tensor;
  std::optional<SymMat3> tensor;
  /// Order of `tensor`, and that of as many independent random axes. Absent where `tensor` is.
  std::optional<OrientationOrder> order;
  std::optional<RandomOrder> random_order;
};

/// What pack() made, beside what was ordered.
struct PackOutcome {
  Packing packing;              ///< With certificate and provenance.
  bool target_reached = false;  ///< Everything ordered stands, and the certificate is clean.
  std::string method;           ///< "rsa", ...
  std::string method_reason;    ///< Why this method, for people.
  std::string stop;             ///< Why it stopped: "target_reached", "saturated", ...
  std::vector<GroupOutcome> groups;
  /// Sentences: what two of count, fraction and size gave for the third, and what of the order is
  /// met only roughly.
  std::vector<std::string> derived;
  double seconds = 0.0;       ///< Processor time of the method [s].
  std::int64_t trials = 0;    ///< Positions tried.
  std::int64_t restarts = 0;  ///< Fresh starts.
};

/// Makes the packing that `recipe` orders and checks it, independently of how it was made.
///
/// A cancelled run and one that is out of time end with the best valid packing. The time limit of
/// the recipe and the deadline of `run` both hold. A certificate that did not pass makes
/// target_reached false and stop "check_failed": such a packing is a defect of this library and
/// must not be used.
///
/// Errors:  throws InvalidArgument, before any work, when the recipe is not well formed or cannot
///          be met: an inclusion larger than the cell allows, bodies that with their gaps need
///          more room than the cell has, equal spheres or disks above the densest packing there
///          is (T. C. Hales, Ann. Math. 162 (2005) 1065-1185; L. Fejes Toth, Math. Z. 46 (1940)
///          83-85).
[[nodiscard]] PackOutcome pack(const Recipe& recipe, RunContext run = {});

}  // namespace packstone
