#pragma once

/// @file
/// The version of the program and of what it is linked with.

#include <string>

namespace packstone::cli {

/// Version, license, and the libraries with their versions and licenses, for `--version`.
[[nodiscard]] std::string version_text();

}  // namespace packstone::cli
