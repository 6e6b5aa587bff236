#pragma once

/// @file
/// Numbers as they stand in messages.

#include <cstdio>
#include <string>

namespace packstone {

/// `value` with up to `digits` significant digits.
inline std::string number_text(double value, int digits = 6) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

}  // namespace packstone
