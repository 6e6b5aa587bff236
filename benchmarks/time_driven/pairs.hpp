#pragma once

#include <filesystem>

namespace packstone::benchmarks {

/// What becomes of the pairs of figures 15 to 29: by the published method, as printed and
/// repaired, and by relax(). One line each, and the gap at every step. Packings for pictures go to
/// `folder` unless it is empty.
void show_pairs(const std::filesystem::path& folder);

}  // namespace packstone::benchmarks
