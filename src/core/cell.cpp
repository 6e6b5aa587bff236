#include "packstone/core/cell.hpp"

#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"

namespace packstone {

void check_cell(const Cell& cell) {
  if (cell.dimension != 2 && cell.dimension != 3) {
    throw InvalidArgument("cell.dimension = " + std::to_string(cell.dimension) +
                          ", allowed are 2 and 3");
  }
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    const double length = cell.size[axis];
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw InvalidArgument("cell.size[" + std::to_string(axis) + "] = " + number_text(length, 17) +
                            ", allowed are finite lengths > 0");
    }
  }
  if (cell.dimension == 2 && (cell.size.z != 0.0 || cell.periodic[2])) {
    throw InvalidArgument("a 2D cell has size.z = 0 and no period along z");
  }
}

}  // namespace packstone
