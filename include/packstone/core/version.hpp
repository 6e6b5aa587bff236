#pragma once

/// @file
/// The version of this library.

#include <string_view>

namespace packstone {

/// "major.minor.patch". Stored with every packing that pack() makes.
[[nodiscard]] std::string_view version() noexcept;

}  // namespace packstone
