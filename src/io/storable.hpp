#pragma once

/// @file
/// What a packing file can hold: the one definition that all readers and writers share.

#include <string_view>

#include "packstone/structure/packing.hpp"

namespace packstone {

inline constexpr std::string_view kPackingFormat = "packstone-packing";
inline constexpr int kPackingVersion = 1;

/// Throws InvalidArgument, naming the field, when a file could not give `packing` back exactly: not
/// well formed, groups without a name of their own, text that is not UTF-8 or holds a zero byte, a
/// certificate or provenance with a number out of range, a recipe that is not a JSON object.
void check_storable(const Packing& packing);

}  // namespace packstone
