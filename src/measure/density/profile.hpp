#pragma once

/// @file
/// Fractions of slabs.

#include <optional>
#include <vector>

#include "packstone/measure/density.hpp"

namespace packstone::density {

/// Ends of slabs of at most `width` from the first to the last of `marks`, which are ascending;
/// all marks are among them but those within 1e-9 of the whole from another. From `empty_above` on
/// there is one slab between two marks.
[[nodiscard]] std::vector<double> slab_edges(const std::vector<double>& marks, double width,
                                             double empty_above);

/// The profile along `axis` in slabs between these edges; over the window too, where there is one.
[[nodiscard]] DensityProfile profile_along(const Packing& packing, std::size_t axis,
                                           std::vector<double> edges,
                                           const std::optional<Window>& window, int threads);

}  // namespace packstone::density
