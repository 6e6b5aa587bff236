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

/// Whether the ending is one that read_packing() and write_packing() know, `.json` or `.h5`: to be
/// asked before long work, not after it.
[[nodiscard]] bool is_packing_file_name(const std::filesystem::path& path);

/// Reads `.json` or `.h5`.
///
/// Errors: throws FileError for a file that cannot be read, another ending, or content that is not
///         a packing; the message names file, inclusion and field, and line and column of a syntax
///         error.
/// Cost:   an ellipsoid some 5 us from JSON, 0.2 us from HDF5 (docs/packing_file.md).
[[nodiscard]] Packing read_packing(const std::filesystem::path& path);

/// Writes `.json` or `.h5`.
///
/// Errors: throws FileError when the file cannot be written or has another ending, InvalidArgument
///         when a file could not give the packing back exactly: it is not well formed, two groups
///         share a name, text is not UTF-8 or holds a zero byte, a number of certificate or
///         provenance is not finite (infinite smallest_gap and smallest_gap_error are kept), the
///         recipe is not a JSON object. An existing file is then left as it was.
void write_packing(const std::filesystem::path& path, const Packing& packing);

/// The JSON text of a packing, one inclusion a line. Throws InvalidArgument as write_packing().
[[nodiscard]] std::string packing_to_json(const Packing& packing);

/// Reads the JSON text of a packing; `origin` stands for the file in messages. Throws FileError.
[[nodiscard]] Packing packing_from_json(std::string_view text, const std::string& origin);

/// Writes `content` to `path` whole or not at all: to a temporary file in the same folder, flushed
/// to the disk, then renamed. A link is followed, permissions of an existing file are kept, a pipe
/// or terminal is written to directly. Throws FileError with path and reason.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Throws FileError when write_atomically() could not even begin, to be asked before long work:
/// makes the temporary file and removes it. A pipe or terminal is not opened, as that would count
/// with who listens; only permission is asked for.
void check_writable(const std::filesystem::path& path);

}  // namespace packstone
