#include "packstone/structure/packing.hpp"

#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

void check_center(const Cell& cell, const Vec3& center) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = center[axis];
    const double length = cell.size[axis];
    // A wall's coordinate itself is inside; a period's far end is the near end of the next.
    const bool inside = cell.periodic[axis] ? x >= 0.0 && x < length : x >= 0.0 && x <= length;
    if (std::isfinite(x) && inside) continue;
    throw InvalidArgument("center[" + std::to_string(axis) + "] = " + number_text(x, 17) +
                          " lies outside the cell, allowed is 0 to " + number_text(length, 17));
  }
}

void check_inclusion(const Packing& packing, const Inclusion& inclusion) {
  check_body(inclusion.body);
  if (dimension(kind(inclusion.body)) != packing.cell.dimension) {
    throw InvalidArgument("shape " + std::string(name(kind(inclusion.body))) +
                          " does not belong in a " + std::to_string(packing.cell.dimension) +
                          "D cell");
  }
  check_center(packing.cell, inclusion.center);
  if (inclusion.group < 0 || inclusion.group >= static_cast<int>(packing.groups.size())) {
    throw InvalidArgument("group " + std::to_string(inclusion.group) + " does not exist");
  }
}

}  // namespace

double fraction(const Packing& packing) noexcept {
  double sum = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) sum += volume(inclusion.body);
  return sum / volume(packing.cell);
}

void check_well_formed(const Packing& packing) {
  check_cell(packing.cell);
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    try {
      check_inclusion(packing, packing.inclusions[i]);
    } catch (const InvalidArgument& problem) {
      throw InvalidArgument("inclusion " + std::to_string(i) + ": " + problem.what());
    }
  }
}

}  // namespace packstone
