#pragma once

/// @file
/// What a packing file can hold: the one definition that all readers and writers share.

#include <cstdint>
#include <string_view>
#include <vector>

#include "packstone/structure/packing.hpp"

namespace packstone {

inline constexpr std::string_view kPackingFormat = "packstone-packing";
inline constexpr int kPackingVersion = 1;

/// Throw InvalidArgument when a file calls itself something else, or is of another version.
void check_format(std::string_view format);
void check_version(std::int64_t version);

/// The cell of a file; InvalidArgument unless there are 2 or 3 sizes and as many flags.
[[nodiscard]] Cell stored_cell(const std::vector<double>& size, const std::vector<bool>& periodic);

/// Throws InvalidArgument, naming the field, when a file could not give `packing` back exactly: not
/// well formed, groups without a name of their own, text that is not UTF-8 or holds a zero byte, a
/// certificate or provenance with a number out of range, a recipe that is not a JSON object.
void check_storable(const Packing& packing);

}  // namespace packstone
