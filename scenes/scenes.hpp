#pragma once

/// @file
/// Named, seeded inputs shared by tests, benchmarks and examples.

#include <cstdint>

#include "packstone/structure/packing.hpp"

namespace packstone::scenes {

/// FNV-1a over the bits of all centers, sizes and orientations: two packings hash alike only if
/// they are the same to the last bit.
[[nodiscard]] std::uint64_t state_hash(const Packing& packing);

}  // namespace packstone::scenes
