#pragma once

/// @file
/// Checkpoints: inclusions in motion, from which long work goes on where it stopped.
///
/// HDF5 with the members of a packing file and a group `motion` beside them; docs/packing_file.md
/// has the layout. Round trips are exact. Files are written whole or not at all.

#include <filesystem>

#include "packstone/structure/moving_packing.hpp"

namespace packstone {

/// Whether the ending is `.h5`, the one of checkpoints: to be asked before long work.
[[nodiscard]] bool is_checkpoint_file_name(const std::filesystem::path& path);

/// Writes a checkpoint. The recipe that the work follows goes along as
/// moving.packing.provenance->recipe_json.
///
/// Errors: throws FileError when the file cannot be written or has another ending, InvalidArgument
///         when it could not give the state back exactly: what write_packing() and check_moving()
///         refuse, and numbers whose names are not UTF-8 or hold a zero byte. An existing file is
///         then left as it was.
/// Cost:   10^6 ellipsoids 0.4 s of processor time and 133 MB; reading them 0.3 s.
void write_checkpoint(const std::filesystem::path& path, const MovingPacking& moving);

/// Reads a checkpoint.
///
/// Errors: throws FileError for a file that cannot be read, another ending, or content that is not
///         a checkpoint; the message names file, inclusion and field.
[[nodiscard]] MovingPacking read_checkpoint(const std::filesystem::path& path);

}  // namespace packstone
