#pragma once

/// @file
/// What a packing file can hold: the one definition that all readers and writers share.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// What a file calls itself.
struct FileFormat {
  std::string_view word;
  std::string_view what;  ///< For messages: "packing file".
  int version = 1;
};

inline constexpr FileFormat kPackingFormat{"packstone-packing", "packing file", 1};
inline constexpr FileFormat kCheckpointFormat{"packstone-checkpoint", "checkpoint", 1};

/// Throw InvalidArgument when a file calls itself something else, or is of another version.
void check_format(std::string_view format, const FileFormat& expected);
void check_version(std::int64_t version, const FileFormat& expected);

/// Throws InvalidArgument naming `field` when `text` is not UTF-8 or holds a zero byte.
void check_text(const std::string& field, const std::string& text);

/// The cell of a file; InvalidArgument unless there are 2 or 3 sizes and as many flags.
[[nodiscard]] Cell stored_cell(const std::vector<double>& size, const std::vector<bool>& periodic);

/// Throws InvalidArgument, naming the field, when a file could not give `packing` back exactly: not
/// well formed, groups without a name of their own, text that is not UTF-8 or holds a zero byte, a
/// certificate or provenance with a number out of range, a recipe that is not a JSON object.
void check_storable(const Packing& packing);

}  // namespace packstone
