#pragma once

/// @file
/// Whole files of HDF5: what they call themselves, written whole or not at all, and read with
/// complaints that name the file.

#include <filesystem>
#include <functional>
#include <new>
#include <utility>

#include "io/hdf5_file.hpp"
#include "io/storable.hpp"
#include "packstone/core/error.hpp"

namespace packstone {

/// Writes what stands below the root of a new file.
using WriteMembers = std::function<void(hid_t root)>;

/// Writes to `path` as it stands, inside a session of the caller. Metadata carry checksums, so that
/// a damaged file is noticed. Throws InvalidArgument.
void write_hdf5_here(const std::filesystem::path& path, const FileFormat& format,
                     const WriteMembers& write);

/// Writes to `path` whole or not at all. Throws FileError.
void write_hdf5(const std::filesystem::path& path, const FileFormat& format,
                const WriteMembers& write);

/// Opens a file, inside a session of the caller. Throws InvalidArgument when it calls itself
/// something else.
[[nodiscard]] Hdf5Handle open_hdf5(const std::filesystem::path& path, const FileFormat& format);

/// What `read(Hdf5Fields&)` makes of the members of a file, inside a session of the caller; members
/// that it did not ask for are refused. Throws InvalidArgument.
template <class Read>
auto read_hdf5_here(const std::filesystem::path& path, const FileFormat& format, Read read) {
  const std::uint64_t bytes = std::filesystem::file_size(path);
  const Hdf5Handle file = open_hdf5(path, format);
  Hdf5Fields fields(file, "", bytes);
  auto content = read(fields);
  fields.finish();
  return content;
}

/// Whether the metadata of a file carry checksums: they came with format 2 of the superblock.
[[nodiscard]] bool has_checksums(const std::filesystem::path& path);

/// What `read` returns; its complaints become FileError and name the file.
template <class Read>
auto naming_file(const std::filesystem::path& path, Read read) {
  try {
    return read();
  } catch (const InvalidArgument& problem) {
    throw FileError(path.string() + ": " + problem.what());
  } catch (const std::filesystem::filesystem_error& problem) {
    throw FileError(path.string() + ": cannot be read: " + problem.code().message());
  } catch (const std::bad_alloc&) {
    throw FileError(path.string() + ": holds more than fits into memory");
  }
}

}  // namespace packstone
