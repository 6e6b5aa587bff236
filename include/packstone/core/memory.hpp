#pragma once

/// @file
/// How much memory there is.

namespace packstone {

/// Bytes of physical memory of the machine; infinite where the system does not tell. A limit set
/// for a container is not known here.
[[nodiscard]] double physical_memory() noexcept;

}  // namespace packstone
