#pragma once

/// @file
/// Numbers and words as they stand in tables.

#include <string>

namespace packstone {

/// The shortest decimal that reads back the same.
[[nodiscard]] std::string shortest(double value);

/// RFC 4180: quotes around what holds a separator, a quote or the end of a line; quotes doubled.
[[nodiscard]] std::string csv_text(const std::string& text);

}  // namespace packstone
