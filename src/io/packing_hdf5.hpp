#pragma once

/// @file
/// The HDF5 side of the packing file; docs/packing_file.md has the layout.

#include <filesystem>

#include "io/hdf5_file.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Throws FileError. A file of the early format, whose metadata have no checksums, is read in a
/// process of its own: on some damaged ones the library crashes, or never ends.
[[nodiscard]] Packing read_packing_hdf5(const std::filesystem::path& path);

/// The same in this process, whatever the format.
[[nodiscard]] Packing read_packing_hdf5_here(const std::filesystem::path& path);

/// Throws FileError, or InvalidArgument as write_packing().
void write_packing_hdf5(const std::filesystem::path& path, const Packing& packing);

/// The members of a packing below the root of a file, unchecked: other files hold a packing among
/// other things. Throw InvalidArgument.
void write_packing_members(hid_t root, const Packing& packing);
[[nodiscard]] Packing read_packing_members(Hdf5Fields& fields);

}  // namespace packstone
