#pragma once

/// @file
/// What must hold for a reader and any bytes whatsoever: used by fuzz targets and their replay.

#include <string>
#include <string_view>

namespace packstone::test {

/// Reads `text` as a JSON packing: refused with FileError, or accepted and then written and read
/// again without a change. Anything else is a defect and is thrown as std::logic_error.
/// @return Whether it was accepted.
bool json_reader_holds(std::string_view text);

/// The same for the bytes of an HDF5 file.
bool hdf5_reader_holds(std::string_view bytes);

/// The same for the bytes of a checkpoint.
bool checkpoint_reader_holds(std::string_view bytes);

}  // namespace packstone::test
