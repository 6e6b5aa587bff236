#pragma once

/// @file
/// Hints to the memory. They change how fast things are, never what they are.

#include <cstddef>

namespace packstone {

/// The line of a cache [bytes], on the platforms known so far or nearly so.
constexpr std::size_t kCacheLine = 64;

/// Asks for `bytes` bytes from `begin` to be fetched into the caches.
inline void prefetch(const void* begin, std::size_t bytes) noexcept {
  const auto* line = static_cast<const char*>(begin);
  for (std::size_t k = 0; k < bytes; k += kCacheLine) __builtin_prefetch(line + k);
  // GCC 12 takes a function that only prefetches for one without effect, and drops the call.
  asm volatile("" : : "r"(line));
}

/// Asks for large pages where memory of this size, allocated but not yet written to, is read at
/// random places: finding the page then costs about as much as reading it. Small blocks are left
/// as they are, and so is everything on systems that have no such request.
void prefer_large_pages(const void* begin, std::size_t bytes) noexcept;

}  // namespace packstone
