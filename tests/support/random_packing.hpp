#pragma once

/// @file
/// Random packings of all shapes, well formed but not free of overlap: what files must carry.

#include <cstdint>
#include <optional>

#include "packstone/structure/packing.hpp"

namespace packstone::test {

/// `count` inclusions in three groups (the second stays empty), with a certificate and provenance.
/// `shapes`: only this kind when given. Numbers are random to the last bit.
[[nodiscard]] Packing random_packing(int dimension, int count, std::uint64_t seed,
                                     std::optional<ShapeKind> shape = std::nullopt);

/// Equal to the last bit, in every field.
[[nodiscard]] bool same_bits(const Packing& a, const Packing& b);

}  // namespace packstone::test
