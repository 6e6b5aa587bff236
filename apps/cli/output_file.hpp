#pragma once

/// @file
/// Refuses an output file that cannot be written before work starts, not after it.

#include <filesystem>
#include <string>
#include <vector>

namespace packstone::cli {

/// Throws InvalidArgument when the ending of `path` is none of `endings` (".json", ...), FileError
/// when its folder does not exist, no file can be made there, or it is itself a folder. `option`:
/// the one that names the file, for the message.
void check_output_file(const std::filesystem::path& path, const std::vector<std::string>& endings,
                       const std::string& option = "-o");

/// As above, for a file of any ending.
void check_output_path(const std::filesystem::path& path);

}  // namespace packstone::cli
