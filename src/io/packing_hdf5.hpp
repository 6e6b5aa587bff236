#pragma once

/// @file
/// The HDF5 side of the packing file; docs/packing_file.md has the layout.

#include <filesystem>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// Throws FileError.
[[nodiscard]] Packing read_packing_hdf5(const std::filesystem::path& path);

/// Throws FileError, or InvalidArgument as write_packing().
void write_packing_hdf5(const std::filesystem::path& path, const Packing& packing);

}  // namespace packstone
