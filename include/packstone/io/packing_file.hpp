#pragma once

/// @file
/// Packing files: JSON for people, HDF5 for large packings, chosen by the file's ending.
///
/// Round trips are exact. Files are written whole or not at all: to a temporary file beside the
/// target, then renamed. Readers are strict: what is malformed, non-finite, non-positive,
/// unnormalized beyond rounding or of an unknown version is refused.

#include <filesystem>
#include <string>
#include <string_view>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// Reads `.json` or `.h5`. Throws FileError with a message that names file, inclusion and field.
[[nodiscard]] Packing read_packing(const std::filesystem::path& path);

/// Writes `.json` or `.h5`. Throws FileError; an existing file is then left as it was.
void write_packing(const std::filesystem::path& path, const Packing& packing);

/// The JSON text of a packing.
[[nodiscard]] std::string packing_to_json(const Packing& packing);

/// Reads the JSON text of a packing; `origin` stands for the file in messages.
[[nodiscard]] Packing packing_from_json(std::string_view text, const std::string& origin);

/// Writes `content` to `path` whole or not at all. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace packstone
