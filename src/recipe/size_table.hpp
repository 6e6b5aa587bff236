#pragma once

/// @file
/// A measured distribution as a text table.

#include <filesystem>

#include "packstone/structure/distribution.hpp"

namespace packstone::recipe {

/// Reads lines "value, weight" (or "value" alone: weight 1); comma, semicolon, tab or blanks
/// separate. Empty lines, lines that begin with #, and a first line of words are passed over.
/// Throws FileError naming file and line.
[[nodiscard]] TableLaw read_size_table(const std::filesystem::path& path);

}  // namespace packstone::recipe
